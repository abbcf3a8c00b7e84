#pragma once

#include "comparisons/geometry/mesh_file.h"
#include "comparisons/problems/plane_problem.h"

#include <string>
#include <vector>

namespace comparisons::geometry {

/// Which groups of a mesh file are wanted.
struct WantedGroups {
  /// Groups of dimension 2 with a material, in the order of the regions; empty: one region of all cells.
  std::vector<std::string> regions;
  /// Groups of dimension 1 with a condition.
  std::vector<std::string> boundaries;
};

/// A plane domain from a mesh: regions, boundaries with names, and the mesh itself.
struct PlaneGeometry {
  /// Names by region; one empty name if there is one region of all cells.
  std::vector<std::string> region_names;
  /// Names by boundary id; what belongs to no group is "free boundary", the last.
  std::vector<std::string> boundary_names;
  /// Boundary pieces by region, in loops: counter-clockwise outside, clockwise around holes.
  std::vector<std::vector<problems::BoundaryPiece>> boundaries;
  problems::Mesh mesh;
  bool second_order = false;
  /// m^2, of the cells with straight sides.
  double area = 0;
  problems::Point2 lower{};
  problems::Point2 upper{};

  /// Diagonal of the bounding box, m.
  double extent() const;
  /// Side of a square cell of the mean area, m.
  double mean_spacing() const;
};

/// The name of the boundary that belongs to no group.
inline constexpr const char *free_boundary = "free boundary";

/// Checks what Gmsh read and makes a plane domain of it.
///
/// Cells are triangles and quadrilaterals of first or second order in a plane of constant z. Cells that are
/// clockwise throughout a surface of the drawing are turned around; a surface with both kinds has inverted cells,
/// which are an error, as are degenerate and not convex cells, duplicate nodes and cells, edges of more than two cells,
/// cells in no or two wanted regions, and boundary edges in two wanted groups. Nodes that no cell has are dropped.
///
/// Second-order edges become circular arcs through their three nodes; where neighbouring edges share the circle,
/// finite elements get the arc too, else the parabola. Straight edges of one group in one line become one piece,
/// arcs of one circle too, up to half a turn. A round boundary in straight edges is a warning.
/// @return nothing if there is an error among the findings
std::optional<PlaneGeometry> make_geometry(const MeshFile &file, const WantedGroups &wanted,
                                           scene::Diagnostics &diagnostics);

/// Names of the groups of a dimension, in the order of the file.
std::vector<std::string> group_names(const MeshFile &file, int dimension);

} // namespace comparisons::geometry
