// Invalid input ends in an exception that names the item.

#include "fem_support.h"

#include <limits>

namespace {
using namespace fem_test;

const Material steel(210e9, .3, PlaneModel::plane_strain);

PlaneProblem valid_problem() { return left_fixed(mesh::rectangle({0, 0}, {1, 1}, 4, 4), steel, linear_field(steel)); }

/// The message with which `solve` refuses the changed problem.
template <typename Change>
std::string refusal(const Change &change) {
  auto problem = valid_problem();
  change(problem);
  return message_of<InvalidInput>([&] { solve(problem); });
}

TEST(FemRefusals, material) {
  const auto make = [](double e, double nu, PlaneModel model) {
    return message_of<InvalidInput>([=] { Material(e, nu, model); });
  };
  EXPECT_CONTAINS(make(0, .3, PlaneModel::plane_stress), "Young's modulus is 0");
  EXPECT_CONTAINS(make(-1, .3, PlaneModel::plane_stress), "-1");
  EXPECT_CONTAINS(make(NAN, .3, PlaneModel::plane_stress), "nan");
  EXPECT_CONTAINS(make(1, .5, PlaneModel::plane_strain), "Poisson's ratio is 0.5, expected -1 < nu < 0.5");
  EXPECT_CONTAINS(make(1, -1, PlaneModel::plane_strain), "Poisson");
  EXPECT_CONTAINS(make(1, .51, PlaneModel::plane_stress), "<= 0.5 in plane stress");
  EXPECT_CONTAINS(make(1, NAN, PlaneModel::plane_stress), "Poisson");
  EXPECT_EQ(make(1, .5, PlaneModel::plane_stress), "");
}

TEST(FemRefusals, degree) {
  for (const int degree : {-1, 0, 5})
    EXPECT_CONTAINS(message_of<InvalidInput>([&] {
                      solve(valid_problem(), {degree, LinearSolver::cholesky});
                    }),
                    "element degree " + std::to_string(degree));
}

TEST(FemRefusals, mesh_vertices) {
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.vertices[6] = p.mesh.vertices[5]; }), "vertices 5 and 6 coincide");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.vertices.push_back({3, 3}); }), "vertex 16 belongs to no cell");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.vertices[7][1] = NAN; }), "vertex 7");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh = {}; }), "no cells");
}

TEST(FemRefusals, mesh_cells) {
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells[3].vertices[2] = 99; }), "cell 3 refers to vertex 99");
  EXPECT_CONTAINS(refusal([](auto &p) { std::swap(p.mesh.cells[4].vertices[1], p.mesh.cells[4].vertices[3]); }),
                  "cell 4 is inverted");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells[4].vertices[1] = p.mesh.cells[4].vertices[0]; }),
                  "cell 4 is inverted, degenerate");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.vertices[5] = {.9, .9}; }), "cell ");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells.push_back(p.mesh.cells[0]); }), "cells 0 and 9");
  auto vertices = mesh::rectangle({0, 0}, {1, 1}, 4, 4).vertices;
  vertices[10] = {.1, .1};
  EXPECT_CONTAINS(message_of<InvalidInput>([&] { mesh::rectangle(vertices, 4, 4); }), "is inverted");
}

TEST(FemRefusals, mesh_boundary) {
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary.erase(p.mesh.boundary.begin()); }),
                  "between vertices 0 and 4 (cell 0) has no boundary id");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary.push_back(p.mesh.boundary[2]); }),
                  "boundary edge 12 (vertices 4 and 8, id 0) is listed twice");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary.push_back({{5, 6}, 1}); }), "lies inside");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary.push_back({{0, 6}, 1}); }), "not a side of any cell");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary.push_back({{0, 77}, 1}); }), "does not exist");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.boundary[0].id = -2; }), "negative id");
}

TEST(FemRefusals, rectangle) {
  EXPECT_CONTAINS(message_of<InvalidInput>([] { mesh::rectangle({0, 0}, {1, 1}, 1, 4); }), "1 x 4");
  EXPECT_CONTAINS(message_of<InvalidInput>([] { mesh::rectangle({0, 0}, {0, 1}, 4, 4); }), "upper corner");
  const std::vector<Point> few(5);
  EXPECT_CONTAINS(message_of<InvalidInput>([&] { mesh::rectangle(few, 4, 4); }), "5 vertex positions");
}

TEST(FemRefusals, conditions) {
  EXPECT_CONTAINS(refusal([](auto &p) { p.boundary.erase(2); }), "boundary id 2 of the mesh");
  EXPECT_CONTAINS(refusal([](auto &p) { p.boundary[7] = {}; }), "boundary id 7, but the mesh has only: 0, 1, 2, 3");
  EXPECT_CONTAINS(refusal([](auto &p) { p.boundary[0].displacement = {}; }), "boundary id 0 prescribes u1");
  EXPECT_CONTAINS(refusal([](auto &p) { p.boundary[0].displacement = batch([](Point) {
                                          return Vector{0, NAN};
                                        }); }),
                  "prescribed displacement u2 at (0, 0) is nan");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.boundary[1].traction = traction_of([](Point) { return Stress{INFINITY, 0, 0}; });
                  }),
                  "boundary id 1: the traction");
  EXPECT_CONTAINS(refusal([](auto &p) { p.body_force = batch([](Point) {
                                          return Vector{NAN, 0};
                                        }); }),
                  "the body force at");
}

TEST(FemRefusals, free_rigid_motions) {
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.boundary[0].kind = {loaded, loaded};
                  }),
                  "3 rigid motions free (translation along x1, translation along x2, rotation)");
  // u2 on a vertical line leaves the translation along x1 and a rotation about a point of that line.
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.boundary[0].kind = {loaded, fixed};
                  }),
                  "2 rigid motions free (translation along x1, rotation)");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.boundary[0].kind = {fixed, loaded};
                  }),
                  "1 rigid motion free (translation along x2)");
}

/// Two unit cells; the second one starts at `shift`, and nothing of it is prescribed.
PlaneProblem two_cells(bool share_a_vertex) {
  auto problem = valid_problem();
  problem.mesh = mesh::rectangle({0, 0}, {1, 1}, 2, 2);
  auto &mesh = problem.mesh;
  if (share_a_vertex)
    mesh.vertices.insert(mesh.vertices.end(), {{2, 1}, {2, 2}, {1, 2}});
  else
    mesh.vertices.insert(mesh.vertices.end(), {{5, 1}, {6, 1}, {6, 2}, {5, 2}});
  mesh.cells.push_back({share_a_vertex ? std::array{3U, 4U, 5U, 6U} : std::array{4U, 5U, 6U, 7U}});
  for (unsigned k = 0; k < 4; ++k)
    mesh.boundary.push_back({{mesh.cells[1].vertices[k], mesh.cells[1].vertices[(k + 1) % 4]}, 1});
  return problem;
}

TEST(FemRefusals, a_loose_part) {
  EXPECT_CONTAINS(message_of<InvalidInput>([] { solve(two_cells(false)); }),
                  "3 rigid motions free (translation along x1, translation along x2, rotation) in the part");
}

TEST(FemRefusals, a_hinge_is_a_mechanism) {
  for (const auto solver : {LinearSolver::cholesky, LinearSolver::umfpack})
    for (const int degree : {1, 2, 3, 4})
      EXPECT_CONTAINS(message_of<SolveFailure>([&] {
                        solve(two_cells(true), {degree, solver});
                      }),
                      "singular or not positive definite");
}

TEST(FemRefusals, evaluation) {
  const auto solution = solve(valid_problem());
  const std::vector<Point> points = {{.5, .5}, {NAN, .5}};
  std::vector<Vector> values(2);
  EXPECT_CONTAINS(message_of<InvalidInput>([&] { solution.displacement(points, values); }), "not finite");
  EXPECT_CONTAINS(message_of<InvalidInput>([&] { solution.displacement(points, {}); }), "2 points but room for 0");
}
} // namespace
