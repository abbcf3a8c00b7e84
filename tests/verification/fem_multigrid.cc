// Geometric multigrid: its operators against the assembled matrix, the coarse meshes it finds, its iterations and
// its solutions against Cholesky's.

#include "fem_reference/source/elasticity/boundary_conditions.h"
#include "fem_reference/source/elasticity/stiffness.h"
#include "fem_reference/source/multigrid/multigrid.h"
#include "fem_reference/source/multigrid/quadrilateral_coarsening.h"
#include "fem_reference/source/multigrid/stiffness_operator.h"
#include "fem_support.h"

#include <algorithm>
#include <numbers>

namespace {
using namespace fem_test;
using multigrid::coarsen_mesh;

const Material steel(210e9, .3, PlaneModel::plane_stress);

Discretisation space_on(const PlaneMesh &mesh, int degree) {
  double seconds_mesh = 0;
  double seconds_numbering = 0;
  return discretise(mesh, degree, seconds_mesh, seconds_numbering);
}

/// A quarter of a ring by `n_r` x `n_phi` cells with arcs, ids 0 ... 3 (phi = 0, inside, phi = pi / 2, outside).
PlaneMesh quarter_ring(unsigned n_r, unsigned n_phi) {
  PlaneMesh result;
  for (unsigned j = 0; j <= n_phi; ++j)
    for (unsigned i = 0; i <= n_r; ++i) {
      const double r = 1 + double(i) / n_r;
      const double phi = .5 * std::numbers::pi * j / n_phi;
      result.vertices.push_back({r * std::cos(phi), r * std::sin(phi)});
    }
  const auto at = [&](unsigned i, unsigned j) { return j * (n_r + 1) + i; };
  for (unsigned j = 0; j < n_phi; ++j)
    for (unsigned i = 0; i < n_r; ++i)
      result.cells.push_back({{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)}});
  for (unsigned i = 0; i < n_r; ++i) {
    result.boundary.push_back({{at(i, 0), at(i + 1, 0)}, 0});
    result.boundary.push_back({{at(i, n_phi), at(i + 1, n_phi)}, 2});
  }
  for (unsigned j = 0; j < n_phi; ++j) {
    result.boundary.push_back({{at(0, j), at(0, j + 1)}, 1, Point{0, 0}});
    result.boundary.push_back({{at(n_r, j), at(n_r, j + 1)}, 3, Point{0, 0}});
  }
  return result;
}

/// The vertex in the middle of five cells, and around it: no grid.
PlaneMesh star() {
  PlaneMesh result;
  result.vertices.push_back({0, 0});
  for (unsigned k = 0; k < 10; ++k) {
    const double angle = std::numbers::pi * k / 5;
    const double r = k % 2 == 0 ? 1 : 1.4;
    result.vertices.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  for (unsigned k = 0; k < 5; ++k)
    result.cells.push_back({{0, 1 + 2 * k, 2 + 2 * k, 1 + (2 * k + 2) % 10}});
  for (unsigned k = 0; k < 10; ++k)
    result.boundary.push_back({{1 + k, 1 + (k + 1) % 10}, k < 2 ? 0 : 1});
  return result;
}

class MultigridDegree : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Q, MultigridDegree, testing::Values(1, 2, 3, 4), testing::PrintToStringParamName());

/// Curved and distorted cells, two materials, some unknowns prescribed.
TEST_P(MultigridDegree, operators_are_the_assembled_matrix) {
  auto mesh = quarter_ring(3, 5); // 15 cells: the last batch of lanes is not full
  for (std::size_t c = 0; c < 7; ++c)
    mesh.cells[c].region = 1;
  const std::vector<Material> materials{steel, Material(70e9, .4, PlaneModel::plane_stress)};
  const auto space = space_on(mesh, GetParam());
  const std::size_t n = 2 * space.n_nodes();

  linear_algebra::BlockMatrix matrix(space.n_nodes(), space.cell_start, space.cell_nodes);
  assemble_stiffness(space, materials, matrix);
  std::vector<char> prescribed(n, 0);
  for (std::size_t i = 0; i < n; i += 7)
    prescribed[i] = 1;
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = prescribed[i] != 0 ? 0 : std::sin(3. * double(i)) * 1e-3;
  std::vector<double> expected(n);
  multiply(matrix, x, expected, {});
  for (std::size_t i = 0; i < n; i += 7)
    expected[i] = 0;
  const double largest = std::abs(*std::max_element(expected.begin(), expected.end(),
                                                    [](double a, double b) { return std::abs(a) < std::abs(b); }));
  const double scale = 80e9;

  const auto exact = multigrid::make_stiffness_operator<double>(space, materials, prescribed, scale);
  std::vector<double> y(n);
  exact->apply(x, y);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(scale * y[i], expected[i], 1e-13 * largest) << i;
  const auto diagonal = exact->diagonal();
  for (unsigned node = 0; node < space.n_nodes(); ++node)
    for (unsigned d = 0; d < 2; ++d) {
      const unsigned i = 2 * node + d;
      const auto blocks = static_cast<unsigned>(matrix.block_start[node + 1] - matrix.block_start[node]);
      const double entry = matrix.values[matrix.first_entry(node) + d * 2 * blocks];
      EXPECT_NEAR(scale * diagonal[i], prescribed[i] != 0 ? scale : entry, 1e-13 * entry) << i;
    }

  const auto single = multigrid::make_stiffness_operator<float>(space, materials, prescribed, scale);
  const std::vector<float> single_x(x.begin(), x.end());
  std::vector<float> single_y(n);
  single->apply(single_x, single_y);
  for (std::size_t i = 0; i < n; ++i)
    EXPECT_NEAR(scale * double(single_y[i]), expected[i], 1e-5 * largest) << i;
}

/// refine and coarsen_mesh are inverse to each other, on meshes of any topology: the transfer interpolates linear
/// functions exactly, and every coarse cell has the four children's area.
TEST(QuadrilateralCoarsening, finds_what_was_refined) {
  auto grid = jittered({0, 0}, {1, .7}, 6, 4);
  auto regions = grid;
  for (std::size_t c = 0; c < regions.cells.size(); ++c)
    regions.cells[c].region = c % 3 == 0 ? 1 : 0;
  for (const auto &mesh : {grid, regions, quarter_ring(3, 5), star()}) {
    const auto coarse = space_on(mesh, 1);
    const auto fine = space_on(mesh::refine(mesh), 1);
    const auto found = coarsen_mesh(fine);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->space.n_cells, coarse.n_cells);
    ASSERT_EQ(found->space.n_nodes(), coarse.n_nodes());
    auto expected = coarse.positions;
    auto positions = found->space.positions;
    std::sort(expected.begin(), expected.end());
    std::sort(positions.begin(), positions.end());
    EXPECT_EQ(positions, expected);
    EXPECT_EQ(std::count(found->space.regions.begin(), found->space.regions.end(), 1),
              std::count(coarse.regions.begin(), coarse.regions.end(), 1));

    std::vector<float> values(2 * coarse.n_nodes());
    for (std::size_t i = 0; i < coarse.n_nodes(); ++i)
      for (std::size_t d = 0; d < 2; ++d)
        values[2 * i + d] = static_cast<float>(found->space.positions[i][d]);
    std::vector<float> interpolated(2 * fine.n_nodes());
    found->transfer.prolongate(values, interpolated);
    for (std::size_t i = 0; i < fine.n_nodes(); ++i)
      if (found->transfer.nodes_of(i).size() < 4) {
        double chord = 0; // a new vertex on an arc is off its chord
        for (std::size_t d = 0; d < 2; ++d)
          chord = std::max(chord, std::abs(double(interpolated[2 * i + d]) - fine.positions[i][d]));
        EXPECT_LT(chord, .06) << i;
      }
  }
}

TEST(QuadrilateralCoarsening, refuses_what_is_no_refinement) {
  EXPECT_FALSE(coarsen_mesh(space_on(mesh::rectangle({0, 0}, {1, 1}, 4, 4), 1))); // 3 x 3 cells
  EXPECT_FALSE(coarsen_mesh(space_on(mesh::rectangle({0, 0}, {1, 1}, 5, 4), 1))); // 4 x 3
  EXPECT_FALSE(coarsen_mesh(space_on(star(), 1)));
  EXPECT_TRUE(coarsen_mesh(space_on(mesh::rectangle({0, 0}, {1, 1}, 5, 3), 1)));
  // Coarse cells may not join two regions.
  auto mesh = mesh::rectangle({0, 0}, {1, 1}, 5, 5);
  mesh.cells[0].region = 1;
  EXPECT_FALSE(coarsen_mesh(space_on(mesh, 1)));
}

/// The same solution as Cholesky's, on grids, arcs, other topologies, with two materials.
TEST_P(MultigridDegree, solutions_are_those_of_cholesky) {
  const auto exact = linear_field(steel);
  auto layered = mesh::refine(mesh::refine(jittered({0, 0}, {1, .2}, 6, 3)));
  for (auto &cell : layered.cells)
    cell.region = layered.vertices[cell.vertices[0]][1] > .05 ? 1 : 0;
  struct Case {
    const char *name;
    PlaneMesh mesh;
    std::vector<Material> materials;
  };
  const std::vector<Case> cases{
      {"grid", mesh::rectangle({0, 0}, {1, .2}, 41, 9), {steel}},
      {"ring", quarter_ring(16, 24), {steel}},
      {"star", mesh::refine(mesh::refine(mesh::refine(mesh::refine(star())))), {steel}},
      {"no coarser mesh", jittered({0, 0}, {1, .2}, 36, 8), {steel}},
      {"two materials", layered, {steel, Material(7e9, .2, PlaneModel::plane_stress)}},
  };
  for (const auto &[name, mesh, materials] : cases) {
    SCOPED_TRACE(name);
    auto problem = left_fixed(mesh, steel, exact);
    problem.materials = materials;
    // A load that is no polynomial, so that the solution is none either.
    problem.body_force = [](std::span<const Point> points, std::span<Vector> values) {
      for (std::size_t k = 0; k < points.size(); ++k)
        values[k] = {1e9 * std::sin(5 * points[k][0]), -2e9 * std::exp(points[k][1])};
    };
    for (auto it = problem.boundary.begin(); it != problem.boundary.end();)
      it = std::any_of(mesh.boundary.begin(), mesh.boundary.end(), [&](const auto &e) { return e.id == it->first; })
               ? std::next(it)
               : problem.boundary.erase(it);
    const auto direct = solve(problem, {GetParam(), LinearSolver::cholesky});
    const auto iterated = solve(problem, {GetParam(), LinearSolver::multigrid});
    EXPECT_GT(iterated.iterations(), 0);
    EXPECT_LE(iterated.iterations(), 45) << "both corrections together";
    EXPECT_LT(iterated.backward_error(), 1e-11);
    std::vector<Point> points;
    for (const auto &cell : mesh.cells) {
      Point centre{};
      for (const unsigned v : cell.vertices)
        for (std::size_t d = 0; d < 2; ++d)
          centre[d] += .25 * mesh.vertices[v][d];
      points.push_back(centre);
    }
    std::vector<Vector> a(points.size());
    std::vector<Vector> b(points.size());
    direct.displacement(points, a);
    iterated.displacement(points, b);
    double difference = 0;
    double size = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
      for (std::size_t d = 0; d < 2; ++d) {
        difference = std::max(difference, std::abs(a[k][d] - b[k][d]));
        size = std::max(size, std::abs(a[k][d]));
      }
    EXPECT_LT(difference, 1e-10 * size);
    for (const auto &[id, force] : direct.reactions())
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR(iterated.reactions().at(id)[d], force[d], 1e-9 * direct.load_magnitude());
  }
}

/// The work for one digit does not grow with the mesh.
TEST(Multigrid, iterations_do_not_depend_on_the_mesh) {
  const Cantilever plate;
  for (const int degree : {1, 2, 3, 4}) {
    std::vector<int> iterations;
    for (const unsigned n : {16u, 32u, 64u}) {
      const auto space = space_on(mesh::rectangle({0, 0}, {1, 1}, n + 1, n + 1), degree);
      std::vector<char> prescribed(2 * space.n_nodes(), 0);
      for (std::size_t i = 0; i < space.n_nodes(); ++i)
        if (space.positions[i][0] < -.5 + 1e-9)
          prescribed[2 * i] = prescribed[2 * i + 1] = 1;
      const std::vector<Material> materials{steel};
      multigrid::Multigrid solver(space, materials, prescribed);
      EXPECT_GE(solver.n_levels(), degree == 1 && n == 16 ? 1 : 2);
      EXPECT_LE(solver.n_coarsest_unknowns(), 600u);
      std::vector<double> b(prescribed.size());
      for (std::size_t i = 0; i < b.size(); ++i)
        b[i] = std::sin(double(i * i));
      std::vector<double> x(b.size());
      iterations.push_back(solver.solve(b, 1e-10, x).iterations);
    }
    EXPECT_LE(iterations.back(), 30) << degree;
    EXPECT_LE(iterations[2], iterations[1] + 3) << degree;
  }
}

TEST(Multigrid, refuses_triangles_and_names_what_does_not_converge) {
  const auto exact = linear_field(steel);
  const auto triangles = mesh::split_into_triangles(mesh::rectangle({0, 0}, {1, .2}, 11, 3));
  EXPECT_CONTAINS(message_of<InvalidInput>([&] {
                    solve(left_fixed(triangles, steel, exact), {2, LinearSolver::multigrid});
                  }),
                  "triangles; use cholesky");
  // Cells a thousand times longer than wide and nearly incompressible: right, or refused by name.
  const auto slender = mesh::rectangle({0, 0}, {1000, 1}, 65, 65);
  const Material stiff(1e6, .4999, PlaneModel::plane_strain);
  const auto field = linear_field(stiff);
  const auto problem = left_fixed(slender, stiff, field);
  const auto message = message_of<SolveFailure>([&] {
    const auto solution = solve(problem, {2, LinearSolver::multigrid});
    EXPECT_LT(errors(solution, field, {0, 0}, {1000, 1}).displacement, 1e-6);
  });
  if (!message.empty()) {
    EXPECT_CONTAINS(message, "use cholesky");
  }
}
} // namespace
