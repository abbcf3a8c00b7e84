// Finite elements by several threads: the same matrices, loads and solutions to the last bit, errors of the first cell
// at fault, and a setting that is checked.

#include "fem_reference/elasticity/plane_dynamics.h"
#include "fem_reference/source/elasticity/boundary_conditions.h"
#include "fem_reference/source/elasticity/mass.h"
#include "fem_reference/source/elasticity/stiffness.h"
#include "fem_reference/threads.h"
#include "fem_support.h"
#include "unit/parallel/other_threads.h"

#include <algorithm>
#include <random>
#include <thread>

namespace {
using namespace fem_test;

/// Sets the number for one scope.
class Threads {
public:
  explicit Threads(int n) { set_threads(n); }
  ~Threads() { set_threads(1); }
};

const std::vector<Material> materials{Material(210e9, .3, PlaneModel::plane_stress),
                                      Material(70e9, .4, PlaneModel::plane_stress)};
const std::vector<double> densities{7800, 2700};

/// Two regions; every third cell is two triangles if asked for.
PlaneMesh two_regions(unsigned vertices_x, unsigned vertices_y, bool triangles) {
  auto mesh = jittered({0, 0}, {1.3, 1}, vertices_x, vertices_y);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    mesh.cells[c].region = c % 5 < 2 ? 1 : 0;
  if (!triangles)
    return mesh;
  std::vector<mesh::Cell> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto &cell = mesh.cells[c];
    const auto &v = cell.vertices;
    if (c % 3 == 0) {
      cells.push_back({{v[0], v[1], v[2]}, 3, cell.region});
      cells.push_back({{v[0], v[2], v[3]}, 3, cell.region});
    } else
      cells.push_back(cell);
  }
  mesh.cells = cells;
  return mesh;
}

/// Held on the left, pulled on the right, under a body force and warm.
PlaneProblem loaded_plate(PlaneMesh mesh) {
  const Exact field{[](Point x) {
                      return Vector{1e-3 * x[1], 0};
                    },
                    [](Point x) {
                      return Stress{1e6 * x[1], 2e6, -1e6};
                    },
                    [](Point x) {
                      return Vector{1e6 * std::sin(3 * x[0]), -2e6 * x[1] * x[0]};
                    }};
  auto problem = left_fixed(std::move(mesh), materials[0], field);
  problem.materials = materials;
  problem.thermal_strain = [](std::span<const Point> points, std::span<double> values) {
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = 1e-5 * points[k][0];
  };
  return problem;
}

Discretisation space_on(const PlaneMesh &mesh, int degree) {
  double seconds_mesh = 0;
  double seconds_numbering = 0;
  return discretise(mesh, degree, seconds_mesh, seconds_numbering);
}

/// What assembly computes, one array after the other.
std::vector<std::vector<double>> assembled(const PlaneProblem &problem, int degree) {
  const auto space = space_on(problem.mesh, degree);
  linear_algebra::BlockMatrix stiffness(space.n_nodes(), space.cell_start, space.cell_nodes);
  auto mass = stiffness;
  assemble_stiffness(space, problem.materials, stiffness);
  assemble_mass(space, densities, mass);
  const auto forces = loads(problem, space);
  return {stiffness.values,
          mass.values,
          lumped_mass(space, densities),
          forces.nodal,
          {forces.body_force[0], forces.body_force[1], forces.magnitude}};
}

/// Displacement and stress at points, the second part by region and cell.
std::vector<double> solution_values(const PlaneProblem &problem, const Options &options) {
  const auto solution = solve(problem, options);
  std::vector<Point> points;
  for (int j = 0; j < 37; ++j)
    for (int i = 0; i < 37; ++i)
      points.push_back({1.3 * (i + .5) / 37, (j + .5) / 37});
  std::vector<Vector> u(points.size());
  std::vector<Stress> s(points.size());
  solution.displacement(points, u);
  solution.recovered_stress(points, s);
  std::vector<double> values{solution.strain_energy(), solution.backward_error()};
  for (std::size_t k = 0; k < points.size(); ++k) {
    values.insert(values.end(), u[k].begin(), u[k].end());
    values.insert(values.end(), s[k].begin(), s[k].end());
  }
  return values;
}

/// Compares bits: the order of every sum does not depend on the number of threads. One comes again at last.
template <typename Compute>
void expect_same_for_any_number(const Compute &compute) {
  const auto alone = compute();
  for (const int n : {2, 3, 8, 1}) {
    const Threads threads(n);
    EXPECT_EQ(compute(), alone) << n << " threads";
  }
}

class FemThreadsDegree : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Q, FemThreadsDegree, testing::Values(1, 2, 3, 4), testing::PrintToStringParamName());

TEST_P(FemThreadsDegree, assembly_is_the_same_to_the_last_bit) {
  for (const bool triangles : {false, true})
    expect_same_for_any_number([&] { return assembled(loaded_plate(two_regions(24, 17, triangles)), GetParam()); });
}

/// Cells in any order: nodes of most are in several bands.
TEST_P(FemThreadsDegree, the_order_of_the_cells_does_not_matter_for_that) {
  auto mesh = two_regions(16, 11, true);
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), std::mt19937(7));
  expect_same_for_any_number([&] { return assembled(loaded_plate(mesh), GetParam()); });
}

TEST_P(FemThreadsDegree, cholesky_gives_the_same) {
  const auto problem = loaded_plate(two_regions(24, 17, true));
  expect_same_for_any_number([&] { return solution_values(problem, {.degree = GetParam()}); });
}

/// So fine that the finest level is worked on by several threads.
TEST_P(FemThreadsDegree, multigrid_gives_the_same) {
  const auto p = static_cast<unsigned>(GetParam());
  const auto problem = loaded_plate(mesh::refine(two_regions(48 / p + 1, 36 / p + 1, false)));
  ASSERT_GT(space_on(problem.mesh, GetParam()).n_nodes(), 6000U);
  expect_same_for_any_number(
      [&] { return solution_values(problem, {.degree = GetParam(), .solver = LinearSolver::multigrid}); });
}

TEST(FemThreads, taylor_hood_elements_give_the_same) {
  const auto problem = loaded_plate(two_regions(24, 17, true));
  expect_same_for_any_number([&] { return solution_values(problem, {.degree = 2, .mixed = true}); });
}

TEST(FemThreads, frequencies_are_the_same) {
  auto problem = loaded_plate(two_regions(24, 17, false));
  problem.boundary[0].displacement = batch([](Point) { return Vector{}; });
  expect_same_for_any_number([&] {
    return natural_frequencies(problem, {.degree = 2, .mass = Mass::consistent, .densities = densities}, 4).squares;
  });
}

/// More than one thread does assemble: the body force is asked from several.
TEST(FemThreads, several_take_part) {
  if (std::thread::hardware_concurrency() < 2)
    GTEST_SKIP() << "one core";
  auto problem = loaded_plate(two_regions(40, 40, false));
  const auto force = problem.body_force;
  OtherThreads others;
  problem.body_force = [&](std::span<const Point> points, std::span<Vector> values) {
    others.take_part();
    force(points, values);
  };
  solve(problem);
  EXPECT_EQ(others.n(), 0);
  const Threads threads(2);
  others.await();
  solve(problem);
  EXPECT_GT(others.n(), 0);
}

/// A call's message with one thread, and as often as chance may have it with four.
template <typename Error, typename Call>
void expect_one_message(const Call &call, const char *part) {
  const std::string alone = message_of<Error>(call);
  EXPECT_CONTAINS(alone, part);
  const Threads threads(4);
  for (int k = 0; k < 20; ++k)
    EXPECT_EQ(message_of<Error>(call), alone);
}

/// Triangles are integrated before quadrilaterals: the first of them at fault is named, whichever thread meets it.
TEST(FemThreads, the_first_inverted_cell_is_named) {
  auto space = space_on(two_regions(24, 17, true), 2);
  const auto turn = [&](std::size_t c) { // its node in the middle, of a triangle in a side
    auto &x = space.positions[space.nodes_of(c)[space.n_vertices[c] == 4 ? 4 : 1]];
    x = {x[0] + 1, x[1] + 1};
  };
  const auto assemble = [&] {
    linear_algebra::BlockMatrix matrix(space.n_nodes(), space.cell_start, space.cell_nodes);
    assemble_stiffness(space, materials, matrix);
  };
  for (std::size_t c = 102; c < space.n_cells; c += 60)
    if (space.n_vertices[c] == 4)
      turn(c);
  expect_one_message<InvalidInput>(assemble, "Jacobian of cell 102");
  for (std::size_t c = 200; c < space.n_cells; c += 40)
    if (space.n_vertices[c] == 3)
      turn(c);
  expect_one_message<InvalidInput>(assemble, "Jacobian of cell");
}

TEST(FemThreads, the_first_fault_of_a_body_force_is_reported) {
  auto problem = loaded_plate(two_regions(40, 40, true));
  const auto call = [&] { solve(problem); };
  problem.body_force = [](std::span<const Point> points, std::span<Vector>) {
    throw std::runtime_error("first point " + std::to_string(points[0][0]) + " " + std::to_string(points[0][1]));
  };
  expect_one_message<std::runtime_error>(call, "first point");
  problem.body_force = batch([](Point x) { return Vector{x[1] > .3 ? NAN : 0, 0}; });
  expect_one_message<InvalidInput>(call, "the body force at");
}

TEST(FemThreads, none_is_refused) {
  EXPECT_THROW(set_threads(0), InvalidInput);
  EXPECT_EQ(threads(), 1);
}
} // namespace
