// Refinement and quadrature of meshes with curved edges.

#include "comparisons/geometry/mesh_operations.h"
#include "unit/geometry/meshes.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace {

using namespace geometry_tests;

double sum(const std::vector<double> &values) { return std::accumulate(values.begin(), values.end(), 0.0); }

TEST(MeshOperations, quadrature_integrates_polynomials_on_straight_cells) {
  const Folder folder;
  const auto g = good_geometry(folder.write("square.msh", square_2()));
  const auto q = geometry::cell_quadrature(g.mesh, 3);
  EXPECT_EQ(q.points.size(), 36u);
  double moment = 0;
  for (std::size_t i = 0; i < q.points.size(); ++i)
    moment += q.weights[i] * std::pow(q.points[i][0], 4) * std::pow(q.points[i][1], 5);
  EXPECT_NEAR(moment, 1.0 / 30, 1e-15);
}

TEST(MeshOperations, a_round_hole_stays_round_when_refined) {
  const Folder folder;
  const auto path = folder.write("plate.geo", plate_with_hole());
  const double exact = 1 - std::numbers::pi / 16;
  for (const bool quadrilaterals : {false, true}) {
    auto mesh = good_geometry(path, {.quadrilaterals = quadrilaterals}).mesh;
    double before = std::abs(sum(geometry::cell_quadrature(mesh, 4).weights) - exact);
    EXPECT_LT(before, 8 * std::pow(std::numbers::pi / 4, 5) / 16 / 960 * 1.1); // at most 8 arcs of 45 degrees
    for (int level = 0; level < 3; ++level) {
      const auto n = mesh.cells.size();
      mesh = geometry::refine(mesh);
      EXPECT_EQ(mesh.cells.size(), 4 * n);
      const double error = std::abs(sum(geometry::cell_quadrature(mesh, 4).weights) - exact);
      // Parabolas in place of arcs: fourth order in their length.
      EXPECT_LT(error, before / 12) << level;
      before = error;
      for (const auto &edge : mesh.boundary)
        if (edge.arc_centre)
          for (const unsigned v : edge.vertices) {
            EXPECT_NEAR(std::hypot(mesh.vertices[v][0] - 0.5, mesh.vertices[v][1] - 0.5), 0.25, 1e-14);
          }
    }
  }
}

TEST(MeshOperations, parts_are_told_apart) {
  const Folder folder;
  auto mesh = good_geometry(folder.write("square.msh", square_2())).mesh;
  EXPECT_EQ(geometry::components(mesh).second, 1);
  mesh.cells = {mesh.cells[0], mesh.cells[3]};
  mesh.cells[1].vertices[0] = static_cast<unsigned>(mesh.vertices.size()); // no longer the shared vertex
  mesh.vertices.push_back({0.6, 0.6});
  EXPECT_EQ(geometry::components(mesh).second, 2);
  EXPECT_EQ(geometry::components(mesh).first, (std::vector<int>{0, 1}));
}

} // namespace
