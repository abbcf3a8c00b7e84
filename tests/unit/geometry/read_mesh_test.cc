// Reading mesh files: what is in them, and what is said of files that are none.

#include "sanitized.h"
#include "unit/geometry/meshes.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <cmath>
#include <cstdlib>
#include <thread>

namespace {

using namespace geometry_tests;
using geometry::ReadOptions;

/// Writes the square again in another version of the format, by Gmsh itself.
std::string saved_as(const Folder &folder, const std::string &name, double version, bool binary, int order) {
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::open(folder.write("source.msh", square_2()).string());
  if (order == 2)
    gmsh::model::mesh::setOrder(2);
  gmsh::option::setNumber("Mesh.MshFileVersion", version);
  gmsh::option::setNumber("Mesh.Binary", binary ? 1 : 0);
  const auto path = folder.path() / name;
  gmsh::write(path.string());
  gmsh::finalize();
  return path.string();
}

TEST(ReadMesh, every_version_gives_the_same_domain) {
  const Folder folder;
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true})
      for (const int order : {1, 2}) {
        SCOPED_TRACE(fmt::format("version {} {} order {}", version, binary ? "binary" : "text", order));
        const auto g = good_geometry(saved_as(folder, "square.msh", version, binary, order));
        EXPECT_EQ(g.mesh.cells.size(), 4u);
        EXPECT_EQ(g.mesh.vertices.size(), 9u); // nodes in the middle of edges are no vertices
        EXPECT_EQ(g.mesh.boundary.size(), 8u);
        EXPECT_TRUE(g.mesh.curved_edges.empty());
        EXPECT_EQ(g.second_order, order == 2);
        EXPECT_NEAR(g.area, 1, 1e-15);
        EXPECT_EQ(g.boundary_names, (std::vector<std::string>{"left", "right", "bottom", "top"}));
        ASSERT_EQ(g.boundaries.size(), 1u);
        EXPECT_EQ(g.boundaries[0].size(), 4u); // two edges a side, joined
      }
}

TEST(ReadMesh, drawings_are_meshed) {
  const Folder folder;
  const auto path = folder.write("plate.geo", plate_with_hole());
  const auto coarse = good_geometry(path);
  const auto fine = good_geometry(path, {.size = 0.06});
  EXPECT_GT(fine.mesh.cells.size(), 5 * coarse.mesh.cells.size());
  EXPECT_NEAR(fine.mean_spacing(), 0.06, 0.02);
  for (const auto &cell : coarse.mesh.cells)
    EXPECT_EQ(cell.n_vertices, 3u);
  const auto quadrilaterals = good_geometry(path, {.quadrilaterals = true});
  for (const auto &cell : quadrilaterals.mesh.cells)
    EXPECT_EQ(cell.n_vertices, 4u);
}

TEST(ReadMesh, files_that_are_no_meshes_are_named) {
  const Folder folder;
  const auto expect = [&](const std::string &name, const std::string &text, const std::string &word) {
    const auto path = folder.write(name, text);
    const auto found = findings(path);
    EXPECT_NE(found.find(path.string()), std::string::npos) << found;
    EXPECT_NE(found.find("error: "), std::string::npos) << word;
    EXPECT_NE(found.find(word), std::string::npos) << "'" << word << "' is not in " << found;
  };
  const std::string good = square_2();
  expect("empty.msh", "", "the file is empty");
  expect("blank.msh", "\n \n", "the file is empty");
  expect("text.msh", "Dear Sir or Madam,\n", ":1:1: error: no Gmsh mesh: it begins with 'Dear Sir or Madam,'");
  expect("part.step", "ISO-10303-21;\n", "(.msh) or drawing (.geo), not '.step'");
  expect("old.msh", replaced(good, "2.2 0 8", "1 0 8"), ":2:1: error: mesh format '1'; versions 2.2 and 4.1");
  expect("order.msh", replaced(good, "2.2 0 8", "2.2 1 8"), "another byte order");
  expect("nodes.msh", replaced(good, "$Nodes\n9", "$Nodes\n99999999"),
         ":13:1: error: a count of 99999999 nodes is larger");
  expect("huge.msh", replaced(good, "$Elements\n12", "$Elements\n123456789012345"), "larger than the file can hold");
  expect("more.msh", replaced(good, "$Nodes\n9", "$Nodes\n10"), "$EndNodes after 9 of 10 nodes");
  expect("fewer.msh", replaced(good, "$Nodes\n9", "$Nodes\n8"), "expected $EndNodes, found '9 1 1 0'");
  expect("cut.msh", good.substr(0, good.find("10 3 2 5")), "ends after 9 of 12 elements: it is truncated");
  expect("no_end.msh", good.substr(0, good.find("$EndElements")), "$Elements has no $EndElements");
  expect("no_elements.msh", good.substr(0, good.find("$Elements")), "no section $Elements");
  expect("coordinate.msh", replaced(good, "5 .5 .5 0", "5 .5 abc 0"), "expected a coordinate, found 'abc'");
  expect("not_finite.msh", replaced(good, "5 .5 .5 0", "5 .5 nan 0"), "expected a coordinate, found 'nan'");
  expect("short.msh", replaced(good, "12 3 2 5 1 5 6 9 8", "12 3 2 5 1 5 6 9"), "a quadrilateral has 4 nodes");
  expect("unknown.msh", replaced(good, "12 3 2 5 1 5 6 9 8", "12 3 2 5 1 5 6 9 88"), "Gmsh cannot read the file");
  expect("newline.geo", "Point(1) = {0, 0, 0};", "add a newline");
  expect("call.geo", "Point(1) = {0, 0, 0};\nSystemCall \"date\";\n", ":2:1: error: SystemCall");
  expect("syntax.geo", "Point(1) = {0, 0;\n", "Gmsh cannot read the file");
  const auto missing = findings(folder.path() / "missing.msh");
  EXPECT_NE(missing.find("there is no such file"), std::string::npos) << missing;
  fs::create_directory(folder.path() / "folder.msh");
  EXPECT_NE(findings(folder.path() / "folder.msh").find("is a folder"), std::string::npos);
}

/// Every cut of a good file is an error that names the file, whatever is missing, and none takes long.
TEST(ReadMesh, every_truncation_is_an_error) {
  const Folder folder;
  for (const double version : {2.2, 4.1})
    for (const bool binary : {false, true}) {
      const auto file = saved_as(folder, "whole.msh", version, binary, 2);
      std::ifstream stream(file, std::ios::binary);
      const std::string whole{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
      for (std::size_t n = 1; n + 1 < whole.size(); n += 29) {
        scene::Diagnostics diagnostics;
        const auto path = folder.write("cut.msh", whole.substr(0, n));
        geometry::check_structure(path, diagnostics);
        EXPECT_TRUE(diagnostics.has_errors()) << version << (binary ? " binary " : " text ") << n;
      }
    }
}

/// The findings if a function reads the file.
template <typename Reader>
std::string findings_with(const fs::path &path, ReadOptions options, Reader reader) {
  options.reader = [reader](const fs::path &, const ReadOptions &) -> std::string { return reader(); };
  return findings(path, options);
}

TEST(ReadMesh, a_reader_that_crashes_or_hangs_ends_with_an_error) {
  const Folder folder;
  const auto path = folder.write("square.msh", square_2());
  ReadOptions options;
  options.max_seconds = 0.2;
  const auto crashed = findings_with(path, options, []() -> std::string { std::abort(); });
  EXPECT_NE(crashed.find(path.string() + ": error: the mesh reader failed: crashed"), std::string::npos) << crashed;
  const auto hung = findings_with(path, options, []() -> std::string {
    while (true)
      std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  EXPECT_NE(hung.find(path.string() + ": error: the mesh reader did not come to an end"), std::string::npos) << hung;
}

TEST(ReadMesh, a_reader_that_needs_too_much_memory_ends_with_an_error) {
  if (!sanitized::memory_can_be_limited)
    GTEST_SKIP() << sanitized::no_limit_of_memory;
  const Folder folder;
  const auto path = folder.write("square.msh", square_2());
  ReadOptions options;
  options.max_seconds = 30;
  options.max_memory = 64 << 20;
  const auto greedy = findings_with(path, options, [] { return std::string(std::size_t{1} << 30, 'x'); });
  EXPECT_NE(greedy.find("the mesh reader needs more than 64 MiB"), std::string::npos) << greedy;
}

} // namespace
