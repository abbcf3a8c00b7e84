// Points added to a cloud and to a mesh: how many, where, and that the mesh remains one.

#include "comparisons/problems/insertion.h"
#include "comparisons/problems/rectangle_grid.h"

#include "fem_reference/mesh/plane_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace comparisons::problems;

constexpr int n = 11; // on a side of the unit square

PlaneStatement unit_square() {
  PlaneStatement statement;
  statement.regions = {{{}, {1, .3}, rectangle_boundary({0, 0}, {1, 1})}};
  return statement;
}

std::vector<Point2> grid() {
  std::vector<Point2> points;
  for (int a = 0; a < n; ++a)
    for (int b = 0; b < n; ++b)
      points.push_back({a / (n - 1.), b / (n - 1.)});
  return points;
}

Mesh mesh_of_squares() {
  Mesh mesh;
  mesh.vertices = grid();
  const auto at = [](unsigned a, unsigned b) { return a * n + b; };
  for (unsigned a = 0; a + 1 < n; ++a) {
    for (unsigned b = 0; b + 1 < n; ++b)
      mesh.cells.push_back({{at(a, b), at(a + 1, b), at(a + 1, b + 1), at(a, b + 1)}});
    mesh.boundary.push_back({{at(a, 0), at(a + 1, 0)}, 0});
    mesh.boundary.push_back({{at(a + 1, n - 1), at(a, n - 1)}, 1});
    mesh.boundary.push_back({{at(0, a + 1), at(0, a)}, 2});
    mesh.boundary.push_back({{at(n - 1, a), at(n - 1, a + 1)}, 3});
  }
  return mesh;
}

double distance(const Point2 &a, const Point2 &b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

} // namespace

TEST(Insertion, AddsParticlesNearThePlaceAndApartFromOthers) {
  const Point2 place{1, .5}; // on the boundary
  const Cloud before{grid(), std::vector<double>(n * n, .1), {}, true};
  const Cloud after = with_points_near(place, 12, before, unit_square());
  ASSERT_EQ(after.positions.size(), before.positions.size() + 12);
  EXPECT_EQ(after.spacing.size(), after.positions.size());
  EXPECT_FALSE(after.regular);
  for (std::size_t i = 0; i < before.positions.size(); ++i)
    EXPECT_EQ(after.positions[i], before.positions[i]);
  for (std::size_t i = before.positions.size(); i < after.positions.size(); ++i) {
    const Point2 &x = after.positions[i];
    EXPECT_LT(distance(x, place), .3); // 12 of them fill a half disc of about .14 with a density of 4 / .01
    EXPECT_GE(std::min({x[0], 1 - x[0], x[1], 1 - x[1]}), .025);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(distance(x, after.positions[j]), .0449) << i << " " << j;
  }
}

TEST(Insertion, OfParticlesEndsWhenNoMoreFit) {
  const Cloud before{grid(), std::vector<double>(n * n, .1), {}, true};
  const auto n_after = with_points_near({.5, .5}, 100000, before, unit_square()).positions.size();
  // Centres of the 100 squares and midpoints of the 180 inner edges.
  EXPECT_EQ(n_after, before.positions.size() + 280);
}

TEST(Insertion, DividesCellsWithoutHangingNodes) {
  const Mesh before = mesh_of_squares();
  const Mesh after = with_points_near({.97, .52}, 12, before);
  EXPECT_EQ(after.vertices.size(), before.vertices.size() + 12);
  EXPECT_EQ(after.cells.size(), before.cells.size() + 12);
  fem_reference::mesh::PlaneMesh mesh;
  mesh.vertices = after.vertices;
  for (const auto &cell : after.cells)
    mesh.cells.push_back({cell.vertices, cell.n_vertices, cell.region});
  for (const auto &edge : after.boundary)
    mesh.boundary.push_back({edge.vertices, edge.id});
  EXPECT_NO_THROW(fem_reference::mesh::check(mesh)); // refuses inverted cells, edges of more than two cells, gaps
  for (std::size_t i = before.vertices.size(); i < after.vertices.size(); ++i)
    EXPECT_LT(distance(after.vertices[i], {.97, .52}), .25);
}
