#include "comparisons/geometry/mesh_file.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::geometry {

namespace {

struct TypeEntry {
  int type;
  int dimension;
  int n_nodes;
  const char *name;
};

/// From the MSH file format, section 9.2 of Gmsh's manual.
constexpr TypeEntry types[] = {
    {1, 1, 2, "line"},
    {2, 2, 3, "triangle"},
    {3, 2, 4, "quadrilateral"},
    {4, 3, 4, "tetrahedron"},
    {5, 3, 8, "hexahedron"},
    {6, 3, 6, "prism"},
    {7, 3, 5, "pyramid"},
    {8, 1, 3, "line of 3 nodes"},
    {9, 2, 6, "triangle of 6 nodes"},
    {10, 2, 9, "quadrilateral of 9 nodes"},
    {11, 3, 10, "tetrahedron of 10 nodes"},
    {12, 3, 27, "hexahedron of 27 nodes"},
    {13, 3, 18, "prism of 18 nodes"},
    {14, 3, 14, "pyramid of 14 nodes"},
    {15, 0, 1, "point"},
    {16, 2, 8, "quadrilateral of 8 nodes"},
    {17, 3, 20, "hexahedron of 20 nodes"},
    {18, 3, 15, "prism of 15 nodes"},
    {19, 3, 13, "pyramid of 13 nodes"},
    {20, 2, 9, "incomplete triangle of 9 nodes"},
    {21, 2, 10, "triangle of 10 nodes"},
    {22, 2, 12, "incomplete triangle of 12 nodes"},
    {23, 2, 15, "triangle of 15 nodes"},
    {24, 2, 15, "incomplete triangle of 15 nodes"},
    {25, 2, 21, "triangle of 21 nodes"},
    {26, 1, 4, "line of 4 nodes"},
    {27, 1, 5, "line of 5 nodes"},
    {28, 1, 6, "line of 6 nodes"},
    {29, 3, 20, "tetrahedron of 20 nodes"},
    {30, 3, 35, "tetrahedron of 35 nodes"},
    {31, 3, 56, "tetrahedron of 56 nodes"},
    {36, 2, 16, "quadrilateral of 16 nodes"},
    {37, 2, 25, "quadrilateral of 25 nodes"},
    {92, 3, 64, "hexahedron of 64 nodes"},
    {93, 3, 125, "hexahedron of 125 nodes"},
};

const TypeEntry *find(int type) {
  const auto *const found = std::ranges::find(types, type, &TypeEntry::type);
  return found == std::end(types) ? nullptr : found;
}

} // namespace

int nodes_of_type(int type) {
  const auto *entry = find(type);
  return entry != nullptr ? entry->n_nodes : 0;
}

int dimension_of_type(int type) {
  const auto *entry = find(type);
  return entry != nullptr ? entry->dimension : -1;
}

std::string name_of_type(int type) {
  const auto *entry = find(type);
  return entry != nullptr ? entry->name : fmt::format("element of type {}", type);
}

} // namespace comparisons::geometry
