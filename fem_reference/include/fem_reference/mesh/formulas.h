#pragma once

#include "fem_reference/mesh/plane_mesh.h"

#include <span>

/// Meshes of simple domains by formula. All throw InvalidInput for arguments without a mesh.
namespace fem_reference::mesh {
/// Rectangle with a uniform grid of vertices_x x vertices_y vertices (both >= 2), numbered
/// row by row from the lower left corner; cells likewise.
/// Boundary ids: 0 left, 1 right, 2 bottom, 3 top.
PlaneMesh rectangle(Point lower, Point upper, unsigned vertices_x, unsigned vertices_y);

/// The same topology with given vertex positions (vertices_x * vertices_y of them, row by row), for
/// example a grid with moved interior vertices. Refuses inverted cells, by index.
PlaneMesh rectangle(std::span<const Point> vertices, unsigned vertices_x, unsigned vertices_y);

/// The quarter 0 <= x1, x2 <= half_width of a square plate outside of the circle of `radius` around the origin,
/// in two blocks that meet on the diagonal x1 = x2. Vertices lie on straight lines from the hole to the outer
/// sides, n_around + 1 of them a block: evenly by angle on the hole, and on the sides half way between even
/// angles and even lengths, which suits Kirsch's solution best.
/// Along a line from the hole (s = 0) to the side (s = 1), in n_outwards cells, they are at
///   rho(s) = (grading^s - 1) / (grading - 1),
/// so that the outermost cell is about `grading` times as long as the innermost; 1 is uniform. Doubling both
/// counts gives a mesh that holds all vertices of the coarser one. The edges on the hole are arcs.
/// Boundary ids: 0 left (x1 = 0), 1 bottom (x2 = 0), both lines of symmetry, 2 right, 3 top, 4 hole.
PlaneMesh quarter_plate_with_hole(double radius, double half_width, unsigned n_around, unsigned n_outwards,
                                  double grading);

/// One layer of a ring between two radii, in n_cells cells of equal thickness.
struct RingLayer {
  double outer_radius;
  unsigned n_cells;
};

/// Sector 0 <= angle <= `angle` (radians, below 2 pi) of a thick-walled ring around the origin, of one or more layers
/// from the inner radius outwards; the cells of layer k belong to region k. n_around cells along each
/// circle, each less than half a turn. All circles, interfaces included, are arcs.
/// Boundary ids: 0 inner circle, 1 outer circle, 2 the side at angle 0 (x2 = 0), 3 the side at `angle`.
PlaneMesh ring_sector(double inner_radius, std::span<const RingLayer> layers, unsigned n_around, double angle);
} // namespace fem_reference::mesh
