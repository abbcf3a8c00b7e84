#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace comparisons::reports {

/// Points in the plane with cells between them, as a file for ParaView holds them.
struct FieldGrid {
  std::vector<std::array<double, 2>> points;
  /// Vertices of a point (1), triangle (3) or quadrilateral (4) each; indices of points.
  std::vector<std::vector<std::size_t>> cells;
  std::vector<int> regions; ///< of the points; empty: all in the first
};

/// Values at the points of a grid, the components of a point together.
struct PointField {
  std::string name;
  std::vector<std::string> components; ///< "11", "22", "12"; empty for a single number
  std::vector<double> values;

  std::size_t n_components() const { return components.empty() ? 1 : components.size(); }
};

/// VTK's unstructured grid as XML text (.vtu), numbers in full digits. A field of two components named 1, 2 becomes a
/// vector of three with a zero, as VTK wants vectors.
/// @throws std::invalid_argument if a field does not fit the points
std::string vtu_text(const FieldGrid &grid, const std::vector<PointField> &fields);

/// The same as a table: x1, x2 and every component as "stress_11", comma-separated with a header.
std::string field_table(const FieldGrid &grid, const std::vector<PointField> &fields);

/// One file of a ParaView collection.
struct CollectionEntry {
  double time = 0; ///< of a series, or the number of the level
  std::size_t part = 0;
  std::string name;
  std::string file; ///< relative to the collection
};

/// ParaView's collection (.pvd).
std::string pvd_text(const std::vector<CollectionEntry> &entries);

} // namespace comparisons::reports
