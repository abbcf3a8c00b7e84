#pragma once

#include "comparisons/problems/plane_problem.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace comparisons::problems {

/// A file of particles that cannot be used; the message has one line "file:line:column: ..." for every fault, at most
/// twenty.
class CloudFileError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Particles of a file, before anything is known of their domain.
struct CloudFile {
  std::vector<Point2> positions;
  /// Nominal distance of neighbours, m; empty if the file has none.
  std::vector<double> spacing;
  /// m^2; empty if the file has none.
  std::vector<double> volumes;
  /// Counted from 0; empty if the file has none.
  std::vector<int> regions;
};

/// Reads a cloud from CSV: a line of names, then one line a particle. Columns, in any order: x, y (m; needed), h (m,
/// the distance of neighbours), volume (m^2), region (0, 1 ...). Lines that are empty or begin with # are passed over.
///
/// @throws CloudFileError for an unknown, missing or repeated column, a line with too few or too many entries, a text
///   that is no number, a number that is not finite, h or volume not above zero, a region that is no whole number from
///   0 on, two particles of a region at the same place, or no particles
CloudFile read_cloud_csv(const std::filesystem::path &path);

/// The same from a text; `name` stands for the file in messages.
CloudFile parse_cloud_csv(std::string_view text, const std::string &name);

/// Reads the points of a VTK file: the legacy format with ASCII data, or XML (PolyData, UnstructuredGrid) with one
/// piece and data as text. Arrays of the points named h, volume and region are taken; cells and other arrays are passed
/// over.
///
/// @throws CloudFileError with the first fault: another format, binary data, a count that the file cannot hold, an end
///   too early, a text that is no number, z other than 0, or a value that the CSV reader would refuse too
CloudFile read_cloud_vtk(const std::filesystem::path &path);
CloudFile parse_cloud_vtk(std::string_view text, const std::string &name);

/// A cloud as such a text, columns x, y, h (and region, if there are several), every number to its last bit.
std::string cloud_csv(const Cloud &cloud, std::string_view comment);

} // namespace comparisons::problems
