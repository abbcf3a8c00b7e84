#include "comparisons/problems/cloud_file.h"

#include "comparisons/problems/csv_table.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>

namespace comparisons::problems {

namespace {

const CsvFormat &cloud_format() {
  static const CsvFormat format{.needed = {"x", "y"},
                                .optional = {"h", "volume", "region"},
                                .row = "particle",
                                .table = "a cloud",
                                .check = [](std::string_view column, double value) -> std::optional<std::string> {
                                  if ((column == "h" || column == "volume") && !(value > 0))
                                    return "it must be greater than 0";
                                  if (column == "region" && (value < 0 || value > 1e6 || value != std::floor(value)))
                                    return "it is a whole number from 0 on";
                                  return {};
                                }};
  return format;
}

/// Two particles of an interface share their place, but not their region.
void check_places(const CloudFile &cloud, const CsvTable &table, const std::string &name) {
  constexpr std::size_t most_faults = 20;
  std::string faults;
  std::size_t n_faults = 0;
  std::map<std::pair<Point2, int>, std::size_t> known;
  for (std::size_t i = 0; i < cloud.positions.size() && n_faults < most_faults; ++i) {
    const int region = cloud.regions.empty() ? 0 : cloud.regions[i];
    const auto [first, is_new] = known.try_emplace({cloud.positions[i], region}, i);
    if (is_new)
      continue;
    faults += fmt::format("{}{}:{}:{}: a particle at ({}, {}), where line {} has one already",
                          n_faults == 0 ? "" : "\n", name, table.places[i].first, table.places[i].second,
                          cloud.positions[i][0], cloud.positions[i][1], table.places[first->second].first);
    ++n_faults;
  }
  if (n_faults > 0)
    throw CloudFileError(faults);
}

} // namespace

CloudFile parse_cloud_csv(std::string_view text, const std::string &name) try {
  const auto table = parse_csv(text, name, cloud_format());
  CloudFile cloud;
  const auto x = table.column("x");
  const auto y = table.column("y");
  for (std::size_t i = 0; i < table.n_rows(); ++i)
    cloud.positions.push_back({x[i], y[i]});
  const auto h = table.column("h");
  cloud.spacing.assign(h.begin(), h.end());
  const auto volumes = table.column("volume");
  cloud.volumes.assign(volumes.begin(), volumes.end());
  for (const double region : table.column("region"))
    cloud.regions.push_back(static_cast<int>(region));
  check_places(cloud, table, name);
  return cloud;
} catch (const CsvError &error) {
  throw CloudFileError(error.what());
}

CloudFile read_cloud_csv(const std::filesystem::path &path) try {
  return parse_cloud_csv(csv_text(path), path.string());
} catch (const CsvError &error) {
  throw CloudFileError(error.what());
}

std::string cloud_csv(const Cloud &cloud, std::string_view comment) {
  std::string text = comment.empty() ? "" : fmt::format("# {}\n", comment);
  text += cloud.regions.empty() ? "x,y,h\n" : "x,y,h,region\n";
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    text += fmt::format("{},{},{}", cloud.positions[i][0], cloud.positions[i][1], cloud.spacing[i]);
    text += cloud.regions.empty() ? "\n" : fmt::format(",{}\n", cloud.regions[i]);
  }
  return text;
}

} // namespace comparisons::problems
