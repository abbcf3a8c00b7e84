#include "comparisons/program/data_files.h"

#include <algorithm>
#include <stdexcept>

namespace comparisons::program {

namespace fs = std::filesystem;

namespace {

fs::path directory(const std::string &what, const fs::path &in_installation, const fs::path &in_source_tree) {
  const fs::path candidates[] = {fs::path(PETROV_INSTALL_DATA_DIR) / in_installation,
                                 fs::path(PETROV_SOURCE_DIR) / in_source_tree};
  // A program that runs from its build folder uses the scenes it was built from.
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  const bool installed = !error && program.string().starts_with(
                                       fs::path(PETROV_INSTALL_DATA_DIR).parent_path().parent_path().string() + "/");
  for (const int i : {installed ? 0 : 1, installed ? 1 : 0})
    if (fs::is_directory(candidates[i], error))
      return candidates[i];
  throw std::runtime_error("the shipped " + what + " are neither in " + candidates[0].string() + " nor in " +
                           candidates[1].string());
}

} // namespace

fs::path benchmarks_directory() { return directory("scenes", "benchmarks", fs::path("comparisons") / "benchmarks"); }

fs::path meshes_directory() { return directory("clouds and meshes", "meshes", "meshes"); }

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

std::vector<fs::path> example_scenes() {
  std::vector<fs::path> scenes;
  for (const auto &folder : fs::directory_iterator(benchmarks_directory().parent_path() / "examples"))
    if (folder.is_directory())
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".toml")
          scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

fs::path published_file(const std::string &benchmark) { return benchmarks_directory() / benchmark / "published.toml"; }

} // namespace comparisons::program
