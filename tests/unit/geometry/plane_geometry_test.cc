// From a mesh file to a plane domain: boundaries, curves, regions, and meshes that are refused.

#include "unit/geometry/meshes.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace {

using namespace geometry_tests;

double area_of(const std::vector<problems::BoundaryPiece> &pieces) {
  // Green's theorem; an arc adds the segment between it and its chord.
  double area = 0;
  for (const auto &piece : pieces) {
    area += 0.5 * (piece.begin[0] * piece.end[1] - piece.begin[1] * piece.end[0]);
    if (!piece.arc)
      continue;
    const auto &c = piece.arc->centre;
    const double a[] = {piece.begin[0] - c[0], piece.begin[1] - c[1]};
    const double b[] = {piece.end[0] - c[0], piece.end[1] - c[1]};
    double sweep = std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]);
    if (piece.arc->counter_clockwise && sweep < 0)
      sweep += 2 * std::numbers::pi;
    if (!piece.arc->counter_clockwise && sweep > 0)
      sweep -= 2 * std::numbers::pi;
    area += 0.5 * (a[0] * a[0] + a[1] * a[1]) * (sweep - std::sin(sweep));
  }
  return area;
}

TEST(PlaneGeometry, a_round_hole_stays_round) {
  const Folder folder;
  const auto g = good_geometry(folder.write("plate.geo", plate_with_hole()));
  ASSERT_EQ(g.boundaries.size(), 1u);
  // Four sides and two halves of the circle, clockwise as seen from the plate.
  ASSERT_EQ(g.boundaries[0].size(), 6u);
  int arcs = 0;
  for (const auto &piece : g.boundaries[0])
    if (piece.arc) {
      ++arcs;
      EXPECT_EQ(piece.name, "hole");
      EXPECT_FALSE(piece.arc->counter_clockwise);
      EXPECT_NEAR(piece.arc->centre[0], 0.5, 1e-9);
      EXPECT_NEAR(piece.arc->centre[1], 0.5, 1e-9);
    }
  EXPECT_EQ(arcs, 2);
  EXPECT_NEAR(area_of(g.boundaries[0]), 1 - std::numbers::pi / 16, 1e-9);
  // The finite elements' edges are arcs too; no edge inside the plate is curved by more than Gmsh makes it.
  std::size_t round = 0;
  for (const auto &edge : g.mesh.boundary)
    round += edge.arc_centre ? 1 : 0;
  EXPECT_GE(round, 4u);
}

TEST(PlaneGeometry, a_round_hole_in_straight_pieces_is_told) {
  const Folder folder;
  const auto path = folder.write("plate.geo", plate_with_hole());
  const auto text = findings(path, {.order = 1});
  EXPECT_NE(text.find("warning: boundary \"hole\" is approximated by 8 straight pieces"), std::string::npos) << text;
  EXPECT_NE(text.find("45 degrees"), std::string::npos) << text;
  EXPECT_EQ(findings(path), "");
  EXPECT_EQ(findings(folder.write("square.msh", square_2())), "");
}

/// An ellipse of Gmsh: no circle, so the pieces are arcs through three nodes and the cells' sides parabolas.
TEST(PlaneGeometry, an_ellipse_is_close_and_not_joined) {
  const Folder folder;
  const std::string geo =
      "Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {0, 1, 0};\n"
      "Line(1) = {1, 2}; Ellipse(2) = {2, 1, 2, 3}; Line(3) = {3, 1};\n"
      "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n"
      "Physical Curve(\"ellipse\") = {2}; Physical Curve(\"axes\") = {1, 3}; Physical Surface(\"s\") = {1};\n";
  const auto path = folder.write("ellipse.geo", geo);
  double before = 0;
  for (const double size : {0.2, 0.1}) {
    const auto g = good_geometry(path, {.size = size});
    EXPECT_GT(g.mesh.curved_edges.size(), 8u);
    for (const auto &edge : g.mesh.boundary)
      EXPECT_FALSE(edge.arc_centre);
    const double error = std::abs(area_of(g.boundaries[0]) - std::numbers::pi / 2);
    EXPECT_LT(error, 1e-4);
    // Arcs through three points of a curve: the area's error falls like the fourth power of their length.
    if (before > 0) {
      EXPECT_LT(error, before / 10);
    }
    before = error;
  }
}

std::string two_regions() {
  const std::string text = square_2();
  return replaced(replaced(replaced(replaced(text, "$PhysicalNames\n5", "$PhysicalNames\n6"), "2 5 \"plate\"\n",
                                    "2 5 \"lower\"\n2 6 \"upper\"\n"),
                           "11 3 2 5 1", "11 3 2 6 2"),
                  "12 3 2 5 1", "12 3 2 6 2");
}

TEST(PlaneGeometry, two_regions_share_an_interface) {
  const Folder folder;
  const auto g =
      good_geometry(folder.write("two.msh", two_regions()), {}, {.regions = {"upper", "lower"}, .boundaries = {}});
  ASSERT_EQ(g.boundaries.size(), 2u);
  for (std::size_t r = 0; r < 2; ++r) {
    // Left, right, one of bottom and top, and the interface; each of two edges joined where they lie in one side.
    ASSERT_EQ(g.boundaries[r].size(), 4u);
    EXPECT_NEAR(area_of(g.boundaries[r]), 0.5, 1e-15);
    int interfaces = 0;
    for (const auto &piece : g.boundaries[r])
      if (piece.id == problems::interface_id) {
        ++interfaces;
        EXPECT_DOUBLE_EQ(piece.begin[1], 0.5);
        EXPECT_DOUBLE_EQ(piece.end[0] - piece.begin[0], r == 0 ? 1 : -1); // the region to the left
      }
    EXPECT_EQ(interfaces, 1);
  }
  EXPECT_EQ(g.mesh.cells[0].region, 1);
  EXPECT_EQ(g.mesh.cells[3].region, 0);
}

TEST(PlaneGeometry, a_surface_drawn_clockwise_is_turned_around) {
  const Folder folder;
  std::string text = square_2();
  for (const auto &[from, to] : {std::pair{"1 1 2 5 4", "1 4 5 2 1"},
                                 {"1 2 3 6 5", "1 5 6 3 2"},
                                 {"1 4 5 8 7", "1 7 8 5 4"},
                                 {"1 5 6 9 8", "1 8 9 6 5"}})
    text = replaced(text, from, to);
  const auto g = good_geometry(folder.write("clockwise.msh", text));
  EXPECT_NEAR(g.area, 1, 1e-15);
  EXPECT_NEAR(area_of(g.boundaries[0]), 1, 1e-15);
}

TEST(PlaneGeometry, bad_meshes_are_refused_by_index_and_place) {
  const Folder folder;
  const std::string good = square_2();
  int n = 0;
  const auto expect = [&](const std::string &text, const std::string &word, const geometry::WantedGroups &wanted = {}) {
    const auto path = folder.write(fmt::format("mesh{}.msh", n++), text);
    const auto found = findings(path, {}, wanted);
    EXPECT_NE(found.find(path.string() + ": error: "), std::string::npos) << word << " in\n" << found;
    EXPECT_NE(found.find(word), std::string::npos) << "'" << word << "' is not in\n" << found;
  };
  expect(replaced(good, "1 5 6 9 8", "1 8 9 6 5"),
         "inverted cells (clockwise among counter-clockwise ones): cell 12 at (0.75, 0.75)");
  expect(replaced(good, "9 1 1 0", "9 .6 .6 0"), "cells that are not convex: cell 12 at");
  expect(replaced(good, "12 3 2 5 1 5 6 9 8", "12 2 2 5 1 4 5 6"),
         "degenerate cells without area: cell 12 at (0.5, 0.5)");
  const std::string ten = replaced(replaced(good, "$Nodes\n9", "$Nodes\n10"), "9 1 1 0\n", "9 1 1 0\n10 .5 .5 0\n");
  expect(replaced(ten, "1 5 6 9 8", "1 10 6 9 8"), "duplicate nodes: nodes 5 and 10 at (0.5, 0.5)");
  expect(replaced(good, "5 .5 .5 0", "5 .5 .5 .1"), "a 3D mesh: z runs from 0 to 0.1 m");
  expect(replaced(good, "12 3 2 5 1 5 6 9 8", "12 4 2 5 1 5 6 9 8"), "a 3D mesh: element 12 is a tetrahedron");
  expect(replaced(good, "12 3 2 5 1 5 6 9 8", "12 21 2 5 1 5 6 9 8 1 2 3 4 7 5"),
         "element 12 is a triangle of 10 nodes");
  expect(replaced(good, "12 3 2 5 1 5 6 9 8", "12 3 2 5 1 1 2 5 4"),
         "cells overlap: cell 9 at (0.25, 0.25) and cell 12");
  const auto names = good.find("$PhysicalNames");
  std::string ungrouped = good.substr(0, names) + good.substr(good.find("$Nodes"));
  for (const auto &[from, to] : {std::pair{" 2 1 1 ", " 2 0 1 "},
                                 {" 2 2 2 ", " 2 0 2 "},
                                 {" 2 3 3 ", " 2 0 3 "},
                                 {" 2 4 4 ", " 2 0 4 "},
                                 {" 2 5 1 ", " 2 0 1 "}})
    while (ungrouped.find(from) != std::string::npos)
      ungrouped = replaced(ungrouped, from, to);
  expect(ungrouped, "the mesh has no physical groups");
  const std::string lines = good.substr(0, good.find("$Elements")) + "$Elements\n1\n1 1 2 1 1 1 4\n$EndElements\n";
  expect(lines, "the mesh has no cells");
  expect(two_regions(), "2 cells of the region 'lower' have no material", {.regions = {"steel"}, .boundaries = {}});
  // The lower right cell is left out of the list: the upper one and the lower left one meet in a point.
  std::string bow = replaced(replaced(good, "$Elements\n12", "$Elements\n10"), "10 3 2 5 1 2 3 6 5\n", "");
  bow = replaced(bow, "11 3 2 5 1 4 5 8 7\n", "");
  expect(bow, "the domain touches itself in the single point (0.5, 0.5)");
}

/// Groups that have no condition may overlap or lie anywhere; those that have one may not.
TEST(PlaneGeometry, groups_with_conditions_are_for_the_boundary) {
  const Folder folder;
  const std::string two = two_regions();
  // The line from 4 to 5 between the regions belongs to the group "top".
  const auto inside = folder.write("inside.msh", replaced(two, "8 1 2 4 4 8 9", "8 1 2 4 4 4 5"));
  const geometry::WantedGroups regions{.regions = {"lower", "upper"}, .boundaries = {}};
  EXPECT_EQ(findings(inside, {}, regions).find("error"), std::string::npos);
  EXPECT_NE(findings(inside, {}, {.regions = {"lower", "upper"}, .boundaries = {"top"}})
                .find("error: a group with a condition lies inside the domain: 'top' at (0.25, 0.5)"),
            std::string::npos);
  EXPECT_NE(findings(inside).find("warning: 1 boundary edges (0.5 m) belong to no physical group"), std::string::npos)
      << findings(inside);
}

} // namespace
