// Boundary conditions by component, corners, evaluation at any point, distance from the origin.

#include "fem_support.h"

namespace {
using namespace fem_test;

const Material steel(210e9, .3, PlaneModel::plane_strain);

// Every combination of kinds on three edges must return the same linear field.
TEST(FemConditions, mixed_by_component) {
  const auto exact = linear_field(steel);
  for (int combination = 0; combination < 64; ++combination) {
    PlaneProblem problem{jittered({0, 0}, {1, .7}, 5, 4), {steel}, {{0, condition(exact, fixed, fixed)}}};
    for (int id = 1; id < 4; ++id) {
      const int bits = combination >> (2 * (id - 1));
      problem.boundary.emplace(id,
                               condition(exact, (bits & 1) != 0 ? fixed : loaded, (bits & 2) != 0 ? fixed : loaded));
    }
    const auto solution = solve(problem, {2, LinearSolver::cholesky});
    EXPECT_LT(errors(solution, exact, {0, 0}, {1, .7}, 21).displacement, 1e-12) << combination;
    EXPECT_EQ(solution.contradicted_values(), 0U);
  }
}

// Rollers: u1 = 0 on the left, u2 = 0 at the bottom, a pull on the right.
TEST(FemConditions, rollers_and_default_conditions) {
  const double pull = 1e6;
  const double nu = .3;
  const Material material(210e9, nu, PlaneModel::plane_stress);
  const auto zero = batch([](Point) { return Vector{0, 0}; });
  const Exact exact = {[=](Point x) -> Vector {
                         return {pull / 210e9 * x[0], -nu * pull / 210e9 * x[1]};
                       },
                       [=](Point) {
                         return Stress{pull, 0, 0};
                       }};
  const PlaneProblem problem{mesh::rectangle({0, 0}, {2, 1}, 5, 4),
                             {material},
                             {{0, {{fixed, loaded}, zero, {}}},
                              {1, {{loaded, loaded}, {}, traction_of(exact.stress)}},
                              {2, {{loaded, fixed}, zero, {}}},
                              {3, {}}}};
  const auto error = errors(solve(problem), exact, {0, 0}, {2, 1});
  EXPECT_LT(error.displacement, 1e-12);
  EXPECT_LT(error.stress, 1e-12);
}

TEST(FemConditions, nothing_prescribed_but_zero_gives_exactly_zero) {
  const auto zero = batch([](Point) { return Vector{0, 0}; });
  const PlaneProblem problem{
      mesh::rectangle({0, 0}, {2, 1}, 5, 4), {steel}, {{0, {{fixed, fixed}, zero, {}}}, {1, {}}, {2, {}}, {3, {}}}};
  const auto solution = solve(problem);
  const Point x = {1.9, .4};
  Vector u = {1, 1};
  solution.displacement({&x, 1}, {&u, 1});
  EXPECT_EQ(u, (Vector{0, 0}));
  EXPECT_EQ(solution.relative_residual(), 0);
  EXPECT_EQ(solution.backward_error(), 0);
}

TEST(FemConditions, lowest_id_wins_at_a_contradicted_corner) {
  PlaneProblem problem{mesh::rectangle({0, 0}, {1, 1}, 4, 4), {steel}, {}};
  for (int id = 0; id < 4; ++id)
    problem.boundary.emplace(id, BoundaryCondition{});
  problem.boundary[0] = {{fixed, fixed}, batch([](Point) { return Vector{1, 2}; }), {}};
  problem.boundary[3] = {{fixed, loaded}, batch([](Point) { return Vector{5, 0}; }), {}};
  const auto solution = solve(problem);
  EXPECT_EQ(solution.contradicted_values(), 1U);
  const Point corner = {0, 1};
  Vector u{};
  solution.displacement({&corner, 1}, {&u, 1});
  EXPECT_NEAR(u[0], 1, 1e-12);
  EXPECT_NEAR(u[1], 2, 1e-12);
}

// Traction normals on every edge: hydrostatic pressure balances itself.
TEST(FemConditions, pressure_along_outward_normals) {
  const double pressure = 3e6;
  const auto press = [=](std::span<const Point>, std::span<const Vector> normals, std::span<Vector> values) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      values[k] = {-pressure * normals[k][0], -pressure * normals[k][1]};
  };
  // A skewed quadrilateral, so that no normal is along an axis.
  auto mesh = jittered({0, 0}, {1, 1}, 5, 5);
  for (auto &x : mesh.vertices)
    x = {x[0] + .3 * x[1], x[1] - .2 * x[0] + .1 * x[0] * x[1]};
  const double strain = -pressure / (2 * (steel.lambda() + steel.mu()));
  const Exact exact = {[=](Point x) -> Vector {
                         return {strain * x[0], strain * x[1]};
                       },
                       [=](Point) {
                         return Stress{-pressure, -pressure, 0};
                       }};
  PlaneProblem problem{mesh, {steel}, {{0, condition(exact, fixed, fixed)}}};
  for (int id = 1; id < 4; ++id)
    problem.boundary.emplace(id, BoundaryCondition{{loaded, loaded}, {}, press});
  for (const int degree : {1, 2, 3, 4})
    EXPECT_LT(errors(solve(problem, {degree, LinearSolver::cholesky}), exact, {.35, .1}, {1, .7}).stress, 1e-11);
}

// Cells may start at any of their vertices: edges of neighbours then run in opposite directions.
TEST(FemConditions, cells_rotated_at_random) {
  const Cantilever plate;
  const auto exact = plate.exact();
  auto problem = left_fixed(jittered({0, 0}, {1, .2}, 11, 4), plate.material, exact);
  for (std::size_t c = 0; c < problem.mesh.cells.size(); ++c)
    std::rotate(problem.mesh.cells[c].vertices.begin(),
                problem.mesh.cells[c].vertices.begin() + static_cast<std::ptrdiff_t>((7 * c + c / 3) % 4),
                problem.mesh.cells[c].vertices.end());
  for (const int degree : {3, 4})
    EXPECT_LT(errors(solve(problem, {degree, LinearSolver::cholesky}), exact, {0, 0}, {1, .2}).displacement, 1e-12);
}

TEST(FemOffset, a_million_metres_from_the_origin) {
  const Cantilever plate;
  const Point offset = {1e6, -1e6};
  const auto exact = plate.exact(offset);
  const auto problem = left_fixed(jittered(offset, {offset[0] + 1, offset[1] + .2}, 11, 4), plate.material, exact);
  const auto error =
      errors(solve(problem, {3, LinearSolver::cholesky}), exact, offset, {offset[0] + 1, offset[1] + .2});
  // The coordinates themselves are rounded to 1e-10 m, 2e-9 of a cell.
  EXPECT_LT(error.displacement, 1e-7);
  EXPECT_LT(error.stress, 1e-6);
}

TEST(FemEvaluation, points_outside_take_the_nearest_cell_and_are_counted) {
  const Cantilever plate;
  const auto exact = plate.exact();
  const auto solution =
      solve(left_fixed(jittered({0, 0}, {1, .2}, 11, 4), plate.material, exact), {3, LinearSolver::cholesky});
  const std::vector<Point> points = {{.5, .1},    {-.01, .1}, {1.01, .19}, {.37, -.005},
                                     {.37, .203}, {1, .2},    {0, 0},      {1 + 1e-13, .1}};
  std::vector<Vector> u(points.size());
  solution.displacement(points, u);
  EXPECT_EQ(solution.points_outside(), 4U);
  // The cubic continues exactly.
  for (std::size_t k = 0; k < points.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      EXPECT_NEAR(u[k][d], exact.displacement(points[k])[d], 1e-11 * 1e-2) << k;

  // Far away: finite, bounded by a quarter of a cell, and quick.
  const std::vector<Point> far = {{100, 100}, {-1e9, .1}, {.5, 1e300}};
  std::vector<Vector> v(far.size());
  solution.displacement(far, v);
  EXPECT_EQ(solution.points_outside(), 3U);
  for (const auto &value : v)
    EXPECT_LT(std::hypot(value[0], value[1]), .1);

  solution.displacement({}, {});
  EXPECT_EQ(solution.points_outside(), 0U);
}

// Stress jumps between Q1 cells; on the border the cell of lowest index decides.
TEST(FemEvaluation, border_belongs_to_the_cell_of_lowest_index) {
  const Cantilever plate;
  const auto solution = solve(left_fixed(mesh::rectangle({0, 0}, {1, .2}, 11, 3), plate.material, plate.exact()),
                              {1, LinearSolver::cholesky});
  const double x = .3; // between cells 2 and 3 of the lower row
  const std::vector<Point> points = {{x, .03}, {std::nextafter(x, 0.), .03}, {x - 1e-7, .03}, {x + 1e-7, .03}};
  std::vector<Stress> stress(points.size());
  solution.stress(points, stress);
  const double jump = std::abs(stress[3][0] - stress[2][0]);
  EXPECT_GT(jump, 0);
  EXPECT_LT(std::abs(stress[0][0] - stress[2][0]), 1e-3 * jump);
  EXPECT_LT(std::abs(stress[1][0] - stress[2][0]), 1e-3 * jump);
}

TEST(FemEvaluation, every_point_of_a_distorted_mesh_is_found) {
  const auto exact = linear_field(steel);
  const auto solution =
      solve(left_fixed(jittered({0, 0}, {1, 1}, 30, 30, .3), steel, exact), {1, LinearSolver::cholesky});
  std::vector<Point> points;
  for (int j = 0; j <= 200; ++j)
    for (int i = 0; i <= 200; ++i)
      points.push_back({i / 200., j / 200.});
  std::vector<Vector> u(points.size());
  solution.displacement(points, u);
  EXPECT_EQ(solution.points_outside(), 0U);
  for (std::size_t k = 0; k < points.size(); ++k)
    ASSERT_NEAR(u[k][0], exact.displacement(points[k])[0], 1e-13);
}
} // namespace
