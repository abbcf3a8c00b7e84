#include "targets.h"

#include "comparisons/problems/cloud_file.h"

#include <cmath>

namespace fuzzing {

namespace {

using comparisons::problems::CloudFile;

void check(const CloudFile &cloud) {
  const std::size_t n = cloud.positions.size();
  require(n > 0, "a cloud has particles");
  for (const auto &x : cloud.positions)
    require(std::isfinite(x[0]) && std::isfinite(x[1]), "positions are finite");
  require(cloud.spacing.empty() || cloud.spacing.size() == n, "h of every particle or of none");
  require(cloud.volumes.empty() || cloud.volumes.size() == n, "a volume of every particle or of none");
  require(cloud.regions.empty() || cloud.regions.size() == n, "a region of every particle or of none");
  for (const double h : cloud.spacing)
    require(h > 0 && std::isfinite(h), "h > 0");
  for (const double volume : cloud.volumes)
    require(volume > 0 && std::isfinite(volume), "volume > 0");
  for (const int region : cloud.regions)
    require(region >= 0, "regions count from 0");
}

template <typename Read>
void read(const Read &parse, std::string_view bytes) try {
  check(parse(bytes, "cloud"));
} catch (const comparisons::problems::CloudFileError &error) {
  require(std::string_view(error.what()).starts_with("cloud:"), "a refusal names the file");
}

} // namespace

void cloud_csv(std::string_view bytes) { read(comparisons::problems::parse_cloud_csv, bytes); }

void cloud_vtk(std::string_view bytes) { read(comparisons::problems::parse_cloud_vtk, bytes); }

} // namespace fuzzing
