#pragma once

#include "comparisons/geometry/plane_geometry.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace geometry_tests {

using namespace comparisons;
namespace fs = std::filesystem;

/// A folder for files of one test.
class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "petrov_geometry_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder for the test");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;
  fs::path write(const std::string &name, const std::string &text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  const fs::path &path() const { return path_; }

private:
  fs::path path_;
};

/// The unit square in two by two quadrilaterals, MSH 2.2: groups "left" to "top", region "plate".
inline std::string square_2() {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
         "$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"bottom\"\n1 4 \"top\"\n2 5 "
         "\"plate\"\n$EndPhysicalNames\n"
         "$Nodes\n9\n1 0 0 0\n2 .5 0 0\n3 1 0 0\n4 0 .5 0\n5 .5 .5 0\n6 1 .5 0\n7 0 1 0\n8 .5 1 0\n9 1 1 0\n$EndNodes\n"
         "$Elements\n12\n1 1 2 1 1 1 4\n2 1 2 1 1 4 7\n3 1 2 2 2 3 6\n4 1 2 2 2 6 9\n5 1 2 3 3 1 2\n6 1 2 3 3 2 3\n"
         "7 1 2 4 4 7 8\n8 1 2 4 4 8 9\n9 3 2 5 1 1 2 5 4\n10 3 2 5 1 2 3 6 5\n11 3 2 5 1 4 5 8 7\n12 3 2 5 1 5 6 9 8\n"
         "$EndElements\n";
}

/// A plate with a round hole of radius .25 at its middle; the curves of the hole in one group.
inline std::string plate_with_hole() {
  return "lc = 0.25;\n"
         "Point(1) = {0, 0, 0, lc}; Point(2) = {1, 0, 0, lc}; Point(3) = {1, 1, 0, lc}; Point(4) = {0, 1, 0, lc};\n"
         "Point(5) = {.5, .5, 0, lc}; Point(6) = {.75, .5, 0, lc}; Point(7) = {.5, .75, 0, lc};\n"
         "Point(8) = {.25, .5, 0, lc}; Point(9) = {.5, .25, 0, lc};\n"
         "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
         "Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 8}; Circle(7) = {8, 5, 9}; Circle(8) = {9, 5, 6};\n"
         "Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8};\n"
         "Plane Surface(1) = {1, 2};\n"
         "Physical Curve(\"bottom\") = {1}; Physical Curve(\"right\") = {2}; Physical Curve(\"top\") = {3};\n"
         "Physical Curve(\"left\") = {4}; Physical Curve(\"hole\") = {5, 6, 7, 8};\n"
         "Physical Surface(\"plate\") = {1};\n";
}

/// All findings of a path or text; "" if there are none.
inline std::string findings(const fs::path &path, const geometry::ReadOptions &options = {},
                            const geometry::WantedGroups &wanted = {}) {
  scene::Diagnostics diagnostics;
  if (const auto file = geometry::read_mesh(path, options, diagnostics))
    geometry::make_geometry(*file, wanted, diagnostics);
  return to_text(diagnostics);
}

inline geometry::PlaneGeometry good_geometry(const fs::path &path, const geometry::ReadOptions &options = {},
                                             const geometry::WantedGroups &wanted = {}) {
  scene::Diagnostics diagnostics;
  const auto file = geometry::read_mesh(path, options, diagnostics);
  if (!file)
    throw std::runtime_error(to_text(diagnostics));
  auto geometry = geometry::make_geometry(*file, wanted, diagnostics);
  if (!geometry)
    throw std::runtime_error(to_text(diagnostics));
  return std::move(*geometry);
}

/// The text with its first `from` replaced.
inline std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const auto place = text.find(from);
  if (place == std::string::npos)
    throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(place, from.size(), to);
}

} // namespace geometry_tests
