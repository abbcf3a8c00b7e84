#include "comparisons/geometry/mesh_file.h"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <unordered_map>

namespace comparisons::geometry {

namespace {

/// Gmsh's warnings and errors, without their prefix.
std::vector<std::string> messages(const char *kind) {
  std::vector<std::string> log;
  gmsh::logger::get(log);
  std::vector<std::string> found;
  const std::string prefix = std::string(kind) + ": ";
  for (const auto &line : log)
    if (line.starts_with(prefix) && std::ranges::find(found, line.substr(prefix.size())) == found.end())
      found.push_back(line.substr(prefix.size()));
  return found;
}

void mesh_drawing(const ReadOptions &options) {
  // 8 (frontal for quadrilaterals) crashes in Gmsh 4.8; 6 is the frontal Delaunay algorithm.
  gmsh::option::setNumber("Mesh.Algorithm", 6);
  if (options.size) {
    gmsh::option::setNumber("Mesh.MeshSizeMin", 0);
    gmsh::option::setNumber("Mesh.MeshSizeMax", *options.size);
    gmsh::option::setNumber("Mesh.MeshSizeFromPoints", 0);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 0);
  }
  if (options.quadrilaterals) {
    gmsh::option::setNumber("Mesh.RecombineAll", 1);
    gmsh::option::setNumber("Mesh.SubdivisionAlgorithm", 1);
  }
  gmsh::model::mesh::generate(2);
  if (options.order == 2)
    gmsh::model::mesh::setOrder(2);
}

void take_groups(MeshFile &mesh) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups);
  std::map<std::pair<int, int>, std::vector<int>> of_entity;
  for (const auto &[dimension, tag] : groups) {
    if (dimension == 0)
      continue;
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    for (const int entity : entities)
      of_entity[{dimension, entity}].push_back(static_cast<int>(mesh.groups.size()));
    mesh.groups.push_back({dimension, tag, name.empty() ? fmt::format("{}", tag) : name});
  }
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  for (const auto &entity : entities)
    if (entity.first > 0)
      mesh.entities.push_back({entity.first, entity.second, of_entity[entity]});
}

void take_nodes(MeshFile &mesh) {
  std::vector<double> coordinates;
  std::vector<double> parameters;
  std::vector<std::size_t> tags;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  for (std::size_t i = 0; i < tags.size(); ++i) {
    mesh.node_tags.push_back(tags[i]);
    mesh.nodes.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
  }
}

void take_elements(MeshFile &mesh) {
  std::unordered_map<std::uint64_t, std::uint32_t> index;
  for (std::size_t i = 0; i < mesh.node_tags.size(); ++i)
    index.emplace(mesh.node_tags[i], static_cast<std::uint32_t>(i));
  for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags;
    std::vector<std::vector<std::size_t>> nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, mesh.entities[e].dimension, mesh.entities[e].tag);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const std::size_t n = tags[t].empty() ? 0 : nodes[t].size() / tags[t].size();
      for (std::size_t i = 0; i < tags[t].size(); ++i) {
        mesh.elements.push_back(
            {types[t], tags[t][i], static_cast<int>(e), mesh.element_nodes.size(), static_cast<int>(n)});
        for (std::size_t k = 0; k < n; ++k) {
          const auto found = index.find(nodes[t][i * n + k]);
          if (found == index.end())
            throw std::runtime_error(
                fmt::format("element {} has the node {}, which is not in the file", tags[t][i], nodes[t][i * n + k]));
          mesh.element_nodes.push_back(found->second);
        }
      }
    }
  }
}

} // namespace

std::string read_with_gmsh(const std::filesystem::path &path, const ReadOptions &options) {
  MeshFile mesh;
  gmsh::initialize(0, nullptr, false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::logger::start();
  std::string reason;
  try {
    gmsh::open(path.string());
    if (path.extension() == ".geo")
      mesh_drawing(options);
    take_groups(mesh);
    take_nodes(mesh);
    take_elements(mesh);
  } catch (const std::exception &error) {
    reason = error.what();
  } catch (const std::string &error) {
    reason = error;
  } catch (...) {
    reason = "an error without a message";
  }
  // What Gmsh says first is nearest to the cause; what is thrown is the last of it.
  if (const auto errors = messages("Error"); !errors.empty())
    reason = fmt::format("{}", fmt::join(errors, "; "));
  if (!reason.empty())
    throw std::runtime_error(reason);
  mesh.messages = messages("Warning");
  return pack(mesh);
}

} // namespace comparisons::geometry
