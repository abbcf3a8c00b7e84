// Curved geometry and regions: rings (Lame), the plate with a hole (Kirsch), orders p + 1, patch tests, balance.

#include "fem_exact.h"

namespace {
using namespace fem_test;

const Material steel(210e9, .3, PlaneModel::plane_strain);

// Forces balance to rounding, whatever the discretisation error: the direct solver with one correction leaves some
// 1e-14 of the nodal forces, of which there are up to 1e4.
constexpr double balanced = 1e-10;

/// Shape of the cells (3: triangles) and degree.
struct Element {
  unsigned n_vertices;
  int degree;
};

std::string name_of(const testing::TestParamInfo<Element> &info) {
  return (info.param.n_vertices == 3 ? "P" : "Q") + std::to_string(info.param.degree);
}

class FemCurved : public testing::TestWithParam<Element> {
protected:
  PlaneSolution solved(const PlaneProblem &problem) const {
    auto copy = problem;
    if (GetParam().n_vertices == 3)
      copy.mesh = mesh::split_into_triangles(copy.mesh);
    return solve(copy, {GetParam().degree, LinearSolver::cholesky});
  }
};
INSTANTIATE_TEST_SUITE_P(Elements, FemCurved,
                         testing::Values(Element{4, 1}, Element{4, 2}, Element{4, 3}, Element{4, 4}, Element{3, 1},
                                         Element{3, 2}, Element{3, 3}, Element{3, 4}),
                         name_of);

constexpr double quarter = .5 * std::numbers::pi;

PlaneMesh ring(std::vector<mesh::RingLayer> layers, unsigned n_around) {
  return mesh::ring_sector(1, layers, n_around, quarter);
}

/// Orders in L2 of the displacement between three levels. They come from below or above as the cells become small
/// against the radius; .15 below p + 1 is what is left of that on these levels.
void expect_full_order(const std::function<Norms(unsigned)> &error, int degree) {
  double previous = error(8).displacement;
  for (const unsigned n : {16U, 32U}) {
    const double current = error(n).displacement;
    const double order = std::log2(previous / current);
    testing::Test::RecordProperty("order_" + std::to_string(n), std::to_string(order));
    EXPECT_GT(order, degree + 1 - .15) << n << " cells, error " << current;
    EXPECT_LT(order, degree + 1.5) << n << " cells, error " << current;
    previous = current;
  }
}

TEST_P(FemCurved, full_order_on_a_ring) {
  const auto exact = lame(pressed_ring(steel, 1, 2, 5e6));
  const auto sampling = sample_ring(1, 2, quarter);
  expect_full_order(
      [&](unsigned n) {
        const auto solution = solved(ring_problem(ring({{2, n / 2}}, n), {steel}, exact));
        EXPECT_LT(imbalance(solution), balanced);
        return norms(solution, exact, sampling);
      },
      GetParam().degree);
}

TEST_P(FemCurved, full_order_on_a_ring_of_two_materials) {
  const Material soft(15e9, .4, PlaneModel::plane_strain);
  const auto exact = lame(pressed_double_ring(soft, steel, 1, 1.4, 2, 5e6));
  const auto sampling = sample_ring(1, 2, quarter);
  double raw = 0;
  double recovered = 0;
  expect_full_order(
      [&](unsigned n) {
        const auto solution = solved(ring_problem(ring({{1.4, n / 4}, {2, n / 4}}, n), {soft, steel}, exact));
        EXPECT_LT(imbalance(solution), balanced);
        const auto found = norms(solution, exact, sampling);
        raw = found.stress;
        recovered = found.recovered;
        return found;
      },
      GetParam().degree);
  // The hoop stress jumps by a factor of eight at the interface: averaging across it would leave an error of
  // order h^1/2, far above the raw one.
  EXPECT_LT(recovered, 2 * raw);
}

/// Arcs replaced by parabolas through their middle, as a second-order mesh file has them.
PlaneMesh with_parabolas(PlaneMesh mesh) {
  const auto bend = [&](std::array<unsigned, 2> ends, Point centre) {
    const auto &a = mesh.vertices[ends[0]];
    const auto &b = mesh.vertices[ends[1]];
    const Point middle = {.5 * (a[0] + b[0]) - centre[0], .5 * (a[1] + b[1]) - centre[1]};
    const double stretch = std::hypot(a[0] - centre[0], a[1] - centre[1]) / std::hypot(middle[0], middle[1]);
    mesh.curved_edges.push_back({ends, {centre[0] + stretch * middle[0], centre[1] + stretch * middle[1]}});
  };
  for (auto &edge : mesh.boundary)
    if (edge.arc_centre) {
      bend(edge.vertices, *edge.arc_centre);
      edge.arc_centre.reset();
    }
  for (const auto &arc : mesh.interior_arcs)
    bend(arc.vertices, arc.centre);
  mesh.interior_arcs.clear();
  return mesh;
}

class FemSecondOrder : public FemCurved {};
INSTANTIATE_TEST_SUITE_P(Elements, FemSecondOrder, testing::Values(Element{4, 2}, Element{3, 2}), name_of);

TEST_P(FemSecondOrder, full_order_on_a_ring_of_parabolas) {
  const Material soft(15e9, .4, PlaneModel::plane_strain);
  const auto exact = lame(pressed_double_ring(soft, steel, 1, 1.4, 2, 5e6));
  const auto sampling = sample_ring(1, 2, quarter);
  expect_full_order(
      [&](unsigned n) {
        const auto mesh = with_parabolas(ring({{1.4, n / 4}, {2, n / 4}}, n));
        return norms(solved(ring_problem(mesh, {soft, steel}, exact)), exact, sampling);
      },
      2);
}

/// Every third cell cut in two.
PlaneMesh mixed(const PlaneMesh &mesh) {
  PlaneMesh result = mesh;
  result.cells.clear();
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const auto &v = mesh.cells[c].vertices;
    if (c % 3 != 0) {
      result.cells.push_back(mesh.cells[c]);
      continue;
    }
    result.cells.push_back({{v[0], v[1], v[2]}, 3, mesh.cells[c].region});
    result.cells.push_back({{v[0], v[2], v[3]}, 3, mesh.cells[c].region});
  }
  return result;
}

/// A ring of triangles and quadrilaterals, vertices moved, round outside, with bent edges inside.
PlaneMesh distorted_ring() {
  auto mesh = ring({{2, 4}}, 6);
  mesh.interior_arcs.clear();
  for (unsigned i = 1; i < 6; ++i)
    for (unsigned j = 1; j < 4; ++j) {
      auto &x = mesh.vertices[5 * i + j];
      x[0] += .04 * std::sin(12.9898 * (5 * i + j));
      x[1] += .04 * std::cos(78.233 * (5 * i + j));
    }
  for (unsigned i = 1; i < 5; ++i) {
    const std::array<unsigned, 2> ends = {5 * i + 2, 5 * (i + 1) + 2};
    const auto &a = mesh.vertices[ends[0]];
    const auto &b = mesh.vertices[ends[1]];
    mesh.curved_edges.push_back(
        {ends, {.5 * (a[0] + b[0]) + .08 * (b[1] - a[1]), .5 * (a[1] + b[1]) - .08 * (b[0] - a[0])}});
  }
  return mixed(mesh);
}

// Isoparametric elements hold x itself, so that linear fields are exact whatever the sides.
TEST(FemPatch, linear_on_mixed_curved_cells) {
  const auto exact = linear_field(steel);
  const auto sampling = sample_ring(1.05, 1.95, quarter, 41);
  for (const int degree : {1, 2, 3, 4}) {
    const auto solution = solve(left_fixed(distorted_ring(), steel, exact), {degree, LinearSolver::cholesky});
    const auto error = norms(solution, exact, sampling);
    EXPECT_LT(error.displacement, 1e-12) << degree;
    EXPECT_LT(error.stress, 1e-11) << degree;
    EXPECT_LT(error.recovered, 1e-11) << degree;
    EXPECT_LT(imbalance(solution), balanced) << degree;
    EXPECT_EQ(solution.n_cells(), 24U + 8U);
  }
}

// u1 = x^2 + 2 x y - y^2, u2 = 3 x^2 - x y + 2 y^2 and the body force that goes with it.
TEST(FemPatch, quadratic_on_mixed_straight_cells) {
  const double lambda = steel.lambda();
  const double mu = steel.mu();
  const Exact exact = {
      [](Point x) -> Vector {
        return {x[0] * x[0] + 2 * x[0] * x[1] - x[1] * x[1], 3 * x[0] * x[0] - x[0] * x[1] + 2 * x[1] * x[1]};
      },
      [](Point x) {
        return hooke(steel, 2 * x[0] + 2 * x[1], -x[0] + 4 * x[1], .5 * (2 * x[0] - 2 * x[1] + 6 * x[0] - x[1]));
      },
      // grad div u = (1, 6), laplace u = (0, 10)
      [=](Point) -> Vector {
        return {-(lambda + mu), -6 * (lambda + mu) - 10 * mu};
      }};
  for (const int degree : {2, 3, 4}) {
    const auto solution =
        solve(left_fixed(mixed(jittered({0, 0}, {1, .7}, 6, 5)), steel, exact), {degree, LinearSolver::cholesky});
    const auto error = errors(solution, exact, {0, 0}, {1, .7});
    EXPECT_LT(error.displacement, 1e-12) << degree;
    EXPECT_LT(error.stress, 1e-11) << degree;
    EXPECT_LT(imbalance(solution), balanced) << degree;
  }
}

// A bar of two materials with one nu / E under tension: linear in each, so exact in all elements.
TEST_P(FemCurved, bar_of_two_materials_is_exact) {
  const double pull = 1e6;
  const Material stiff(200e9, .4, PlaneModel::plane_stress);
  const Material soft(50e9, .1, PlaneModel::plane_stress);
  const double lateral = -.4 / 200e9 * pull;
  const Exact exact = {[=](Point x) -> Vector {
                         return {pull * (std::min(x[0], 1.) / 200e9 + std::max(x[0] - 1, 0.) / 50e9), lateral * x[1]};
                       },
                       [=](Point) {
                         return Stress{pull, 0, 0};
                       }};
  auto mesh = mesh::rectangle({0, 0}, {2, .5}, 7, 4);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    mesh.cells[c].region = c % 6 < 3 ? 0 : 1;
  auto problem = left_fixed(mesh, stiff, exact);
  problem.materials.push_back(soft);
  problem.boundary[0].kind = {fixed, loaded};
  problem.boundary[2].kind = {loaded, fixed};
  const auto solution = solved(problem);
  const auto error = errors(solution, exact, {0, 0}, {2, .5});
  EXPECT_LT(error.displacement, 1e-12);
  EXPECT_LT(error.stress, 1e-11);
  EXPECT_LT(imbalance(solution), balanced);
  // The left holds what the right pulls; the energy is that of both halves in tension.
  EXPECT_NEAR(solution.reactions().at(0)[0], -pull * .5, 1e-10 * pull);
  EXPECT_NEAR(solution.reactions().at(2)[1], 0, 1e-10 * pull);
  EXPECT_NEAR(solution.applied_tractions().at(1)[0], pull * .5, 1e-12 * pull);
  const double energy = .5 * pull * pull * .5 * (1 / 200e9 + 1 / 50e9);
  EXPECT_NEAR(solution.strain_energy(), energy, 1e-10 * energy);
}

// What a body force brings in, the fixed side holds.
TEST_P(FemCurved, reactions_of_a_body_force) {
  auto problem = ring_problem(ring({{2, 2}}, 3), {steel}, {});
  problem.boundary[0] = problem.boundary[1] = problem.boundary[3] = {};
  problem.boundary[2] = {{fixed, fixed}, batch([](Point) { return Vector{0, 0}; }), {}};
  problem.body_force = batch([](Point) { return Vector{2e4, -7e4}; });
  const auto solution = solved(problem);
  EXPECT_LT(imbalance(solution), balanced);
  // Area of the ring; elements of degree 1 have a polygon instead.
  if (GetParam().degree > 1) {
    const double area = .25 * std::numbers::pi * 3;
    EXPECT_NEAR(solution.reactions().at(2)[1], 7e4 * area, 7e4 * area * 1e-3);
  }
  // ... and the work of the loads is twice the strain energy, which is positive.
  EXPECT_GT(solution.strain_energy(), 0);
}

// Hydrostatic pressure on the isoparametric normals of curved edges: a uniform stress.
TEST_P(FemCurved, pressure_on_curved_edges) {
  const double pressure = 3e6;
  const auto press = [=](std::span<const Point>, std::span<const Vector> normals, std::span<Vector> values) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      values[k] = {-pressure * normals[k][0], -pressure * normals[k][1]};
  };
  const double strain = -pressure / (2 * (steel.lambda() + steel.mu()));
  const Exact exact = {[=](Point x) -> Vector {
                         return {strain * x[0], strain * x[1]};
                       },
                       [=](Point) {
                         return Stress{-pressure, -pressure, 0};
                       }};
  auto problem = ring_problem(ring({{2, 2}}, 4), {steel}, exact);
  problem.boundary[0].traction = problem.boundary[1].traction = press;
  const auto solution = solved(problem);
  const auto error = norms(solution, exact, sample_ring(1.1, 1.9, quarter, 41));
  EXPECT_LT(error.displacement, 1e-12);
  EXPECT_LT(error.stress, 1e-11);
  EXPECT_LT(imbalance(solution), balanced);
}

TEST_P(FemCurved, points_of_a_ring_are_found) {
  const auto exact = lame(pressed_ring(steel, 1, 2, 5e6));
  const auto solution = solved(ring_problem(ring({{2, 4}}, 8), {steel}, exact));
  const auto inside = norms(solution, exact, sample_ring(1.01, 1.99, quarter, 150));
  EXPECT_EQ(inside.outside, 0U);
  // Just outside: the nearest cell, counted, its polynomial continued.
  const std::vector<Point> points = {
      {.99 * std::cos(.3), .99 * std::sin(.3)}, {2.01 * std::cos(1.2), 2.01 * std::sin(1.2)}, {1.5, -.01}, {0, 0}};
  std::vector<Vector> u(points.size());
  solution.displacement(points, u);
  EXPECT_EQ(solution.points_outside(), 4U);
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t d = 0; d < 2; ++d)
      EXPECT_NEAR(u[k][d], exact.displacement(points[k])[d],
                  (GetParam().degree == 1 ? .1 : .02) * std::hypot(u[k][0], u[k][1]))
          << k;
}

// A million metres from the origin: arcs, midpoints and evaluation all work relative to the mesh.
TEST_P(FemCurved, far_from_the_origin) {
  const auto exact = lame(pressed_ring(steel, 1, 2, 5e6));
  const Point offset = {1e6, -3e6};
  const auto shift = [=](Point x, double sign) { return Point{x[0] + sign * offset[0], x[1] + sign * offset[1]}; };
  auto mesh = ring({{2, 4}}, 8);
  const auto near = solved(ring_problem(mesh, {steel}, exact));
  for (auto &x : mesh.vertices)
    x = shift(x, 1);
  for (auto &edge : mesh.boundary)
    if (edge.arc_centre)
      edge.arc_centre = shift(*edge.arc_centre, 1);
  for (auto &arc : mesh.interior_arcs)
    arc.centre = shift(arc.centre, 1);
  const Exact shifted = {[=](Point x) { return exact.displacement(shift(x, -1)); },
                         [=](Point x) { return exact.stress(shift(x, -1)); }};
  const auto far = solved(ring_problem(mesh, {steel}, shifted));
  for (const Point x : {Point{1.2, .3}, Point{.4, 1.1}, Point{1, 1.5}}) {
    const Point there = shift(x, 1);
    Vector u{}, v{};
    near.displacement({&x, 1}, {&u, 1});
    far.displacement({&there, 1}, {&v, 1});
    // The coordinates are rounded to 4e-10 m, 1e-8 of a cell, in every vertex and centre.
    for (std::size_t d = 0; d < 2; ++d)
      EXPECT_NEAR(v[d], u[d], 1e-7 * std::hypot(u[0], u[1]));
  }
}

/// A row of the table of figures that the reference must reach (quarter plate, b = 1, L = 3, plane strain).
struct PlateRow {
  int degree;
  unsigned n_outwards;
  std::size_t n_dofs;
  double displacement;
  double concentration;
};

// Figures of an independent isoparametric code; 20 % for another mesh of as many cells.
TEST(FemPlateWithHole, reaches_the_accuracy_of_its_table) {
  const Material material(226.9e9, .33, PlaneModel::plane_strain);
  const auto exact = kirsch(material, 1, 1e9);
  const auto sampling = sample_plate(1, 3);
  for (const auto &row : {PlateRow{1, 64, 8450, 1.7e-4, 5.8e-3}, PlateRow{2, 16, 2178, 3.0e-5, 2.0e-3},
                          PlateRow{2, 64, 33282, 4.5e-7, 1.6e-4}, PlateRow{3, 16, 4802, 1.2e-6, 1.4e-4},
                          PlateRow{3, 64, 74498, 4.8e-9, 2.7e-6}, PlateRow{4, 16, 8450, 5.8e-8, 6.6e-6},
                          PlateRow{4, 32, 33282, 1.9e-9, 5.0e-7}}) {
    const auto mesh = mesh::quarter_plate_with_hole(1, 3, row.n_outwards / 2, row.n_outwards, 20);
    const auto solution = solve(plate_problem(mesh, material, 1, 1e9), {row.degree, LinearSolver::cholesky});
    EXPECT_EQ(solution.n_dofs(), row.n_dofs);
    EXPECT_LT(norms(solution, exact, sampling).displacement, 1.2 * row.displacement) << "Q" << row.degree;
    EXPECT_LT(concentration_errors(solution, 1, 1e9)[0], 1.2 * row.concentration) << "Q" << row.degree;
    EXPECT_LT(imbalance(solution), balanced);
  }
}
} // namespace
