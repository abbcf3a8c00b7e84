#include "comparisons/program/data_files.h"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace comparisons::program {

namespace fs = std::filesystem;

namespace {

/// Both places where data may be, the one of this program first.
std::array<fs::path, 2> places_of(const fs::path &folder) {
  std::array<fs::path, 2> places{fs::path(PETROV_SOURCE_DIR) / "comparisons" / folder,
                                 fs::path(PETROV_INSTALL_DATA_DIR) / folder};
  // A program that runs from its build folder uses the scenes it was built from.
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const bool installed = !error && program.string().starts_with(
                                       fs::path(PETROV_INSTALL_DATA_DIR).parent_path().parent_path().string() + "/");
  if (installed)
    std::swap(places[0], places[1]);
  return places;
}

} // namespace

fs::path benchmarks_directory() {
  const auto places = places_of("benchmarks");
  std::error_code error;
  for (const fs::path &place : places)
    if (fs::is_directory(place, error))
      return place;
  throw std::runtime_error("the shipped scenes are neither in " + places[0].string() + " nor in " + places[1].string());
}

fs::path page_directory() {
  std::error_code error;
  for (const fs::path &place : places_of(fs::path("reports") / "page"))
    if (fs::is_directory(place, error))
      return place;
  return {};
}

std::vector<fs::path> shipped_scenes(const std::string &benchmark) {
  std::vector<fs::path> scenes;
  for (const auto &entry : fs::directory_iterator(benchmarks_directory() / benchmark))
    if (entry.path().extension() == ".toml" && entry.path().filename() != "published.toml")
      scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end(), [](const fs::path &a, const fs::path &b) {
    const bool main_a = a.filename() == "scene.toml";
    const bool main_b = b.filename() == "scene.toml";
    return main_a != main_b ? main_a : a < b;
  });
  return scenes;
}

fs::path published_file(const std::string &benchmark) { return benchmarks_directory() / benchmark / "published.toml"; }

} // namespace comparisons::program
