#pragma once

#include "comparisons/scene/diagnostics.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::geometry {

/// A physical group of Gmsh: "clamp" (dimension 1), "steel" (dimension 2).
struct PhysicalGroup {
  int dimension = 0;
  int tag = 0;
  /// Its number as text if it has no name.
  std::string name;
};

/// A curve, surface or volume of Gmsh with the groups that it belongs to.
struct Entity {
  int dimension = 0;
  int tag = 0;
  /// Indices into MeshFile::groups.
  std::vector<int> groups;
};

/// One element of a mesh file, of dimension 1 to 3.
struct Element {
  /// Gmsh's number of the element's type: 1 and 8 lines, 2 and 9 triangles, 3, 10 and 16 quadrilaterals.
  int type = 0;
  std::uint64_t tag = 0;
  /// Index into MeshFile::entities.
  int entity = 0;
  /// Where its nodes begin in MeshFile::element_nodes; corners come first.
  std::uint64_t first_node = 0;
  int n_nodes = 0;
};

/// What a mesh file holds, as Gmsh read it. Nothing of it has been checked.
struct MeshFile {
  std::filesystem::path path;
  std::vector<std::uint64_t> node_tags;
  /// m
  std::vector<std::array<double, 3>> nodes;
  std::vector<PhysicalGroup> groups;
  std::vector<Entity> entities;
  std::vector<Element> elements;
  /// Indices into `nodes`.
  std::vector<std::uint32_t> element_nodes;
  /// Warnings of Gmsh.
  std::vector<std::string> messages;
};

/// How a file is read.
struct ReadOptions {
  /// .geo only: size of the cells, m; if absent, what the file says.
  std::optional<double> size = {};
  /// .geo only: 1 straight cells, 2 cells with a node in the middle of every edge.
  int order = 2;
  /// .geo only: quadrilaterals in place of triangles.
  bool quadrilaterals = false;
  /// Limits of the child process that Gmsh's library reads in.
  double max_seconds = 120;
  std::int64_t max_memory = std::int64_t{4} << 30;
  /// What reads the file in the child process and returns the packed mesh; empty: Gmsh's library. For tests.
  std::function<std::string(const std::filesystem::path &, const ReadOptions &)> reader = {};
};

/// Reads a mesh (.msh 2.2 or 4.1, text or binary) or a drawing (.geo) that Gmsh then meshes.
///
/// The file is looked through first (check_structure); then Gmsh's library reads it in a child process, so
/// that a crash, a hang or an exhausted memory there ends with a finding that names the file.
/// @return nothing if there is an error among the findings
std::optional<MeshFile> read_mesh(const std::filesystem::path &path, const ReadOptions &options,
                                  scene::Diagnostics &diagnostics);

/// Looks through a file without Gmsh: that it exists and is not empty, that it is a mesh or a drawing, of a
/// version that is taken, with complete sections, and no count larger than the file can hold. Findings carry the
/// line where there are lines.
void check_structure(const std::filesystem::path &path, scene::Diagnostics &diagnostics);
/// The same for bytes in memory; the path says whether they are a mesh or a drawing, and stands in the findings.
void check_structure(std::string_view bytes, const std::filesystem::path &path, scene::Diagnostics &diagnostics);

/// Nodes of an element by Gmsh's number of its type; 0 if unknown.
int nodes_of_type(int type);
/// Dimension 0 to 3 of the same; -1 if unknown.
int dimension_of_type(int type);
/// "triangle of 10 nodes", "tetrahedron"; "element of type 93" if unknown.
std::string name_of_type(int type);

/// Reads the file with Gmsh's library in this process and packs the mesh for `unpack`.
/// @throws std::runtime_error with what Gmsh says
std::string read_with_gmsh(const std::filesystem::path &path, const ReadOptions &options);

/// A mesh as bytes, and back; only for the same program on the same machine.
std::string pack(const MeshFile &mesh);
MeshFile unpack(const std::string &bytes);

} // namespace comparisons::geometry
