// Meshes by formula, refinement, and what the validation refuses on triangles, curves and regions.

#include "fem_exact.h"

namespace {
using namespace fem_test;

const Material steel(210e9, .3, PlaneModel::plane_strain);
constexpr double quarter = .5 * std::numbers::pi;

double radius_of(Point x) { return std::hypot(x[0], x[1]); }

PlaneMesh ring(unsigned n_around, unsigned n_outwards) {
  return mesh::ring_sector(1, std::vector<mesh::RingLayer>{{2, n_outwards}}, n_around, quarter);
}

/// The area inside of the isoparametric geometry: resultant of a unit body force.
double area(const PlaneMesh &mesh, int degree) {
  auto problem = ring_problem(mesh, {steel}, {});
  for (int id = 0; id < 4; ++id)
    problem.boundary[id] = {{fixed, fixed}, batch([](Point) { return Vector{0, 0}; }), {}};
  problem.body_force = batch([](Point) { return Vector{1, 0}; });
  return solve(problem, {degree, LinearSolver::cholesky}).applied_body_force()[0];
}

TEST(FemMesh, plate_with_hole) {
  const auto mesh = mesh::quarter_plate_with_hole(1, 3, 4, 6, 9);
  EXPECT_EQ(mesh.cells.size(), 8U * 6U);
  EXPECT_EQ(mesh.vertices.size(), 9U * 7U);
  EXPECT_NO_THROW(mesh::check(mesh));
  for (const auto &edge : mesh.boundary)
    for (const unsigned v : edge.vertices) {
      const auto &x = mesh.vertices[v];
      const std::array<double, 5> distance = {x[0], x[1], x[0] - 3, x[1] - 3, radius_of(x) - 1};
      EXPECT_NEAR(distance[static_cast<std::size_t>(edge.id)], 0, edge.id < 2 ? 0. : 1e-15) << edge.id;
      EXPECT_EQ(edge.arc_centre.has_value(), edge.id == 4);
    }
  // From the hole along x1 = 0 the last cell over the first is about the grading: 9^(5/6) for six cells.
  const auto height = [&](unsigned j) { return mesh.vertices[9 * j][1]; };
  EXPECT_NEAR((height(6) - height(5)) / (height(1) - height(0)), std::pow(9, 5. / 6), 1e-12);
  // Nested: twice the counts keep every vertex.
  const auto fine = mesh::quarter_plate_with_hole(1, 3, 8, 12, 9);
  for (unsigned j = 0; j <= 6; ++j)
    for (unsigned i = 0; i <= 8; ++i)
      for (std::size_t d = 0; d < 2; ++d)
        EXPECT_NEAR(fine.vertices[2 * j * 17 + 2 * i][d], mesh.vertices[j * 9 + i][d], 1e-14);
}

TEST(FemMesh, ring_sector) {
  const auto mesh = mesh::ring_sector(1, std::vector<mesh::RingLayer>{{1.5, 2}, {3, 1}}, 5, 1.2);
  EXPECT_EQ(mesh.cells.size(), 15U);
  EXPECT_NO_THROW(mesh::check(mesh));
  for (const auto &cell : mesh.cells)
    for (const unsigned v : cell.corners())
      EXPECT_TRUE(cell.region == 0 ? radius_of(mesh.vertices[v]) < 1.51 : radius_of(mesh.vertices[v]) > 1.49);
  EXPECT_EQ(mesh.interior_arcs.size(), 2U * 5U);
}

// Nodes of every degree lie on the arcs: the area of the ring converges with order 2 p.
TEST(FemMesh, arcs_give_the_area_of_the_ring) {
  const double exact = .75 * std::numbers::pi;
  for (const bool triangles : {false, true})
    for (const int degree : {1, 2, 3, 4}) {
      const auto error = [&](unsigned n) {
        const auto mesh = triangles ? mesh::split_into_triangles(ring(n, 1)) : ring(n, 1);
        return std::abs(area(mesh, degree) - exact);
      };
      const double coarse = error(3);
      const double fine = error(6);
      if (fine > 1e-13) {
        EXPECT_GT(std::log2(coarse / fine), std::min(2 * degree, degree + 2) - .3) << degree << ' ' << triangles;
      }
    }
}

TEST(FemRefine, keeps_arcs_regions_and_ids) {
  auto mesh = ring(3, 2);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    mesh.cells[c].region = static_cast<int>(c % 2);
  for (const auto &coarse : {mesh, mesh::split_into_triangles(mesh)}) {
    const auto fine = mesh::refine(mesh::refine(coarse));
    EXPECT_NO_THROW(mesh::check(fine));
    EXPECT_EQ(fine.cells.size(), 16 * coarse.cells.size());
    EXPECT_EQ(fine.boundary.size(), 4 * coarse.boundary.size());
    EXPECT_EQ(fine.interior_arcs.size(), 4 * coarse.interior_arcs.size());
    for (std::size_t c = 0; c < fine.cells.size(); ++c)
      EXPECT_EQ(fine.cells[c].region, coarse.cells[c / 16].region);
    for (const auto &edge : fine.boundary)
      for (const unsigned v : edge.vertices) {
        if (edge.id < 2) {
          EXPECT_NEAR(radius_of(fine.vertices[v]), 1 + edge.id, 1e-14);
        } else {
          EXPECT_NEAR(fine.vertices[v][edge.id == 2 ? 1 : 0], 0, 1e-14);
        }
      }
    for (const auto &arc : fine.interior_arcs)
      for (const unsigned v : arc.vertices)
        EXPECT_NEAR(radius_of(fine.vertices[v]), 1.5, 1e-14);
  }
}

// Each half of a parabola is the same parabola: the domain does not change.
TEST(FemRefine, keeps_parabolas) {
  auto coarse = ring(2, 1);
  for (auto &edge : coarse.boundary)
    if (edge.arc_centre) {
      const auto &a = coarse.vertices[edge.vertices[0]];
      const auto &b = coarse.vertices[edge.vertices[1]];
      coarse.curved_edges.push_back({edge.vertices, {.55 * (a[0] + b[0]), .54 * (a[1] + b[1])}});
      edge.arc_centre.reset();
    }
  for (const auto &mesh : {coarse, mesh::split_into_triangles(coarse)}) {
    const double before = area(mesh, 2);
    EXPECT_NEAR(area(mesh::refine(mesh), 2), before, 1e-14 * before);
    EXPECT_NEAR(area(mesh::refine(mesh::refine(mesh)), 2), before, 1e-14 * before);
  }
}

// A refined coarse mesh is as good a reference as one by formula: full order under refinement.
TEST(FemRefine, full_order_under_refinement) {
  const auto exact = lame(pressed_ring(steel, 1, 2, 5e6));
  const auto sampling = sample_ring(1, 2, quarter, 61);
  for (const bool triangles : {false, true})
    for (const int degree : {1, 2, 3, 4}) {
      auto mesh = ring(4, 2);
      mesh.interior_arcs.clear(); // curved on the boundary alone
      if (triangles)
        mesh = mesh::split_into_triangles(mesh);
      std::vector<double> found;
      for (int level = 0; level < 4; ++level) {
        found.push_back(
            norms(solve(ring_problem(mesh, {steel}, exact), {degree, LinearSolver::cholesky}), exact, sampling)
                .displacement);
        mesh = mesh::refine(mesh);
      }
      for (std::size_t level = 2; level < 4; ++level)
        EXPECT_GT(std::log2(found[level - 1] / found[level]), degree + 1 - .2) << degree << ' ' << triangles;
    }
}

/// The message with which a change to a valid ring of 2 x 2 cells (vertices 3 i + j, radius 1 + j / 2) is refused.
template <typename Change>
std::string refusal(const Change &change, int degree = 2) {
  const auto exact = lame(pressed_ring(steel, 1, 2, 5e6));
  auto problem = ring_problem(ring(2, 2), {steel}, exact);
  change(problem);
  return message_of<InvalidInput>([&] { solve(problem, {degree, LinearSolver::cholesky}); });
}

TEST(FemMeshRefusals, cells) {
  EXPECT_EQ(refusal([](auto &) {}), "");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells[1].n_vertices = 5; }), "cell 1 has 5 vertices");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells[1].region = -1; }), "cell 1 has the region -1");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.cells[3].region = 1; }),
                  "cell 3 is of region 1, but there are materials for 1 region only");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.mesh = mesh::split_into_triangles(p.mesh);
                    std::swap(p.mesh.cells[5].vertices[1], p.mesh.cells[5].vertices[2]);
                  }),
                  "cell 5 is inverted");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.mesh = mesh::split_into_triangles(p.mesh);
                    p.mesh.cells.push_back(p.mesh.cells[0]);
                  }),
                  "cells 0 and 8 lie on the same side");
}

TEST(FemMeshRefusals, materials) {
  EXPECT_CONTAINS(refusal([](auto &p) { p.materials.clear(); }), "no material");
  EXPECT_CONTAINS(refusal([](auto &p) { p.materials.emplace_back(1e9, .3, PlaneModel::plane_stress); }),
                  "region 1 is in plane stress and that of region 0 in plane strain");
}

TEST(FemMeshRefusals, arcs) {
  const auto centre_of_first = [](Point centre) {
    return refusal([=](auto &p) { p.mesh.boundary[0].arc_centre = centre; });
  };
  EXPECT_CONTAINS(centre_of_first({.1, 0}), "the ends of boundary edge 0 (vertices 0 and 3, id 0) are");
  EXPECT_CONTAINS(centre_of_first({1, 0}), "an arc needs one radius");
  EXPECT_CONTAINS(centre_of_first({NAN, 0}), "the centre of boundary edge 0");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    const auto &a = p.mesh.vertices[0];
                    const auto &b = p.mesh.vertices[3];
                    p.mesh.boundary[0].arc_centre = Point{.5 * (a[0] + b[0]), .5 * (a[1] + b[1])};
                  }),
                  "lie opposite each other");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.mesh.interior_arcs.push_back({{0, 3}, {0, 0}});
                  }),
                  "interior arc 2 (vertices 0 and 3) lies on the boundary");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.mesh.interior_arcs.push_back({{1, 4}, {0, 0}});
                  }),
                  "interior arc 2 (vertices 1 and 4) is curved already");
  EXPECT_CONTAINS(refusal([](auto &p) {
                    p.mesh.interior_arcs.push_back({{0, 4}, {0, 0}});
                  }),
                  "interior arc 2 (vertices 0 and 4) is not a side of any cell");
  EXPECT_CONTAINS(refusal([](auto &p) { p.mesh.interior_arcs.push_back({{0, 40}, {0, 0}}); }), "does not exist");
}

TEST(FemMeshRefusals, curved_edges) {
  const auto add = [](std::array<unsigned, 2> ends, Point midpoint, int degree = 2) {
    return refusal([=](auto &p) { p.mesh.curved_edges.push_back({ends, midpoint}); }, degree);
  };
  EXPECT_CONTAINS(add({0, 3}, {.9, .4}), "curved edge 0 (vertices 0 and 3) is curved already");
  EXPECT_CONTAINS(add({0, 8}, {.9, .4}), "curved edge 0 (vertices 0 and 8) is not a side of any cell");
  EXPECT_CONTAINS(add({0, 1}, {INFINITY, .4}), "the midpoint of curved edge 0");
  // An edge inside, from radius 1 to 1.5 at 45 degrees, bent over its neighbour.
  EXPECT_CONTAINS(add({3, 4}, {1.3, .2}), "the Jacobian of cell ");
  EXPECT_CONTAINS(add({3, 4}, {1.3, .2}), "is not positive everywhere; a curved side folds it");
  EXPECT_EQ(add({3, 4}, {1.3, .2}, 1), ""); // elements of degree 1 do not see it
  EXPECT_EQ(add({3, 4}, {.9, .86}), "");
}

TEST(FemMeshRefusals, loose_parts_of_triangles) {
  EXPECT_CONTAINS(refusal([](auto &p) {
                    auto &mesh = p.mesh;
                    mesh.vertices.insert(mesh.vertices.end(), {{5, 0}, {6, 0}, {5, 1}});
                    mesh.cells.push_back({{9, 10, 11}, 3});
                    for (unsigned k = 0; k < 3; ++k)
                      mesh.boundary.push_back({{9 + k, 9 + (k + 1) % 3}, 1});
                  }),
                  "3 rigid motions free (translation along x1, translation along x2, rotation) in the part");
}

TEST(FemMeshRefusals, formulas) {
  const auto plate = [](double radius, double width, unsigned around, unsigned outwards, double grading) {
    return message_of<InvalidInput>([=] { mesh::quarter_plate_with_hole(radius, width, around, outwards, grading); });
  };
  EXPECT_CONTAINS(plate(3, 2, 4, 4, 1), "0 < radius < half width");
  EXPECT_CONTAINS(plate(1, 2, 0, 4, 1), "0 x 4 cells");
  EXPECT_CONTAINS(plate(1, 2, 4, 4, -1), "the grading is -1");
  const auto sector = [](double inner, std::vector<mesh::RingLayer> layers, unsigned around, double angle) {
    return message_of<InvalidInput>([=] { mesh::ring_sector(inner, layers, around, angle); });
  };
  EXPECT_CONTAINS(sector(1, {{2, 1}}, 1, 4), "less than half a turn");
  EXPECT_CONTAINS(sector(1, {{2, 1}}, 9, 7), "between 0 and 2 pi");
  EXPECT_CONTAINS(sector(1, {}, 4, 1), "no layers");
  EXPECT_CONTAINS(sector(1, {{2, 1}, {1.5, 1}}, 4, 1), "layer 1 goes from radius 2 to 1.5");
  EXPECT_CONTAINS(sector(0, {{2, 1}}, 4, 1), "growing positive radii");
}
} // namespace
