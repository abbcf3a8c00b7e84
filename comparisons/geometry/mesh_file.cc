#include "comparisons/geometry/mesh_file.h"

#include "comparisons/study/isolation.h"

#include <fmt/format.h>

#include <stdexcept>

namespace comparisons::geometry {

namespace {

/// First byte of what the child sends: a mesh, or the reason why there is none.
constexpr char good = 'm';
constexpr char bad = 'e';

std::string reason_of(const study::IsolatedOutcome &outcome, const ReadOptions &options) {
  using Kind = study::IsolatedOutcome::Kind;
  switch (outcome.kind) {
  case Kind::out_of_time:
    return fmt::format("the mesh reader did not come to an end within {} s", options.max_seconds);
  case Kind::out_of_memory:
    return fmt::format("the mesh reader needs more than {} MiB", options.max_memory >> 20);
  case Kind::interrupted:
    return "interrupted";
  default:
    return "the mesh reader failed: " + outcome.reason;
  }
}

} // namespace

std::optional<MeshFile> read_mesh(const std::filesystem::path &path, const ReadOptions &options,
                                  scene::Diagnostics &diagnostics) {
  const scene::Location here{.file = path.string()};
  scene::Diagnostics structure;
  check_structure(path, structure);
  for (const auto &finding : structure.all())
    diagnostics.add(finding);
  if (structure.has_errors())
    return std::nullopt;
  const auto outcome = study::run_isolated(
      [&] {
        try {
          return good + (options.reader ? options.reader(path, options) : read_with_gmsh(path, options));
        } catch (const std::bad_alloc &) {
          throw;
        } catch (const std::exception &error) {
          return bad + std::string(error.what());
        }
      },
      {options.max_seconds, options.max_memory}, {});
  if (outcome.kind != study::IsolatedOutcome::Kind::finished) {
    diagnostics.error(here, {}, reason_of(outcome, options), "open it in Gmsh and save it again");
    return std::nullopt;
  }
  if (outcome.payload.front() != good) {
    diagnostics.error(here, {}, "Gmsh cannot read the file: " + outcome.payload.substr(1),
                      "open it in Gmsh and save it again");
    return std::nullopt;
  }
  MeshFile mesh = unpack(outcome.payload.substr(1));
  mesh.path = path;
  for (const auto &message : mesh.messages)
    diagnostics.warning(here, {}, "Gmsh: " + message);
  return mesh;
}

} // namespace comparisons::geometry
