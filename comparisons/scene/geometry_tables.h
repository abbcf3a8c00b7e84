#pragma once

#include "comparisons/scene/document.h"
#include "comparisons/scene/parameters.h"
#include "comparisons/scene/table_reader.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace comparisons::scene {

/// One table of a scene with its place.
struct PlacedTable {
  Parameters keys;
  /// "boundary[1]"
  std::string key;
  Location location;
};

/// The tables of a geometry of one's own, as read: names are not yet held against the mesh.
struct GeometryTables {
  PlacedTable geometry;
  std::vector<PlacedTable> materials;
  std::vector<PlacedTable> boundaries;
  PlacedTable reference;
  std::vector<PlacedTable> quantities;
  /// [effects.body_force]; absent if the scene does not call for it.
  std::optional<PlacedTable> body_force;
  /// [effects.thermal_expansion]; absent if the scene does not call for it.
  std::optional<PlacedTable> thermal_expansion;
};

/// Keys of [geometry], [[material]], [[boundary]], [reference], [[quantity]], [effects.body_force] and
/// [effects.thermal_expansion].
std::vector<Declaration> geometry_declarations();
std::vector<Declaration> region_material_declarations();
std::vector<Declaration> boundary_declarations();
std::vector<Declaration> reference_declarations();
std::vector<Declaration> quantity_declarations();
std::vector<Declaration> body_force_declarations();
std::vector<Declaration> thermal_expansion_declarations();

/// Reads the tables of a scene with [geometry]. Also checks what keys of one table say against each other: a traction
/// beside a pressure or a displacement of the same component, a component that a quantity needs.
/// @return nothing if there is an error in one of these tables
std::optional<GeometryTables> read_geometry_tables(const Node &root, std::span<const KeyHome> homes,
                                                   Diagnostics &diagnostics);

/// The two texts of a value of Type::expressions.
std::array<std::string, 2> split_expressions(const std::string &text);

} // namespace comparisons::scene
