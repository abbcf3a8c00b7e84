#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace comparisons::program {

/// Folder that holds the benchmarks' scenes: beside an installed program, else the source tree.
/// @throws std::runtime_error if neither is there
std::filesystem::path benchmarks_directory();

/// Folder that holds the shipped clouds of particles and meshes, found in the same way.
/// @throws std::runtime_error if neither is there
std::filesystem::path meshes_directory();

/// Scenes of one benchmark, scene.toml first, the others by name.
std::vector<std::filesystem::path> shipped_scenes(const std::string &benchmark);

/// The benchmark's published.toml; may not exist.
std::filesystem::path published_file(const std::string &benchmark);

/// The scenes of all shipped examples of a geometry of one's own, comparisons/examples/*/*.toml.
std::vector<std::filesystem::path> example_scenes();

} // namespace comparisons::program
