#include "targets.h"

#include "comparisons/geometry/mesh_operations.h"
#include "comparisons/geometry/plane_geometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

namespace fuzzing {

namespace {

using namespace comparisons;

template <typename T>
std::optional<T> number(const std::string &text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

struct Mesh {
  geometry::MeshFile file;
  geometry::WantedGroups wanted;
};

/// A mesh as Gmsh would hand it over, from lines "region NAME" and "boundary NAME" (wanted groups), "group DIMENSION
/// NAME", "entity DIMENSION GROUP...", "node X Y Z", "element TYPE ENTITY NODE...", all counted from 0. What Gmsh's
/// reader (gmsh_reader.cc) guarantees holds: places that exist, and as many nodes as the type has.
Mesh mesh_from(std::string_view bytes) {
  Mesh mesh;
  auto &file = mesh.file;
  file.path = "square.msh";
  std::istringstream lines{std::string(bytes)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream stream(line);
    std::string kind;
    stream >> kind;
    std::vector<std::string> words;
    for (std::string word; stream >> word;)
      words.push_back(word);
    if (words.empty())
      continue;
    const auto place = [&](std::size_t i, std::size_t n) {
      const auto value = number<std::size_t>(words[i]);
      return value && *value < n ? value : std::nullopt;
    };
    if (kind == "region")
      mesh.wanted.regions.push_back(words[0]);
    else if (kind == "boundary")
      mesh.wanted.boundaries.push_back(words[0]);
    else if (kind == "group" && words.size() == 2 && place(0, 4).value_or(0) > 0)
      file.groups.push_back({static_cast<int>(*place(0, 4)), static_cast<int>(file.groups.size()) + 1, words[1]});
    else if (kind == "entity" && place(0, 4).value_or(0) > 0) {
      geometry::Entity entity{static_cast<int>(*place(0, 4)), static_cast<int>(file.entities.size()) + 1, {}};
      for (std::size_t i = 1; i < words.size(); ++i)
        if (const auto group = place(i, file.groups.size()); group && file.groups[*group].dimension == entity.dimension)
          entity.groups.push_back(static_cast<int>(*group));
      file.entities.push_back(entity);
    } else if (kind == "node" && words.size() == 3) {
      const auto x = number<double>(words[0]), y = number<double>(words[1]), z = number<double>(words[2]);
      if (x && y && z) {
        file.node_tags.push_back(file.nodes.size() + 1);
        file.nodes.push_back({*x, *y, *z});
      }
    } else if (kind == "element" && words.size() > 2) {
      const int type = number<int>(words[0]).value_or(0);
      const auto entity = place(1, file.entities.size());
      const auto n = words.size() - 2;
      if (!entity || geometry::dimension_of_type(type) != file.entities[*entity].dimension ||
          static_cast<std::size_t>(geometry::nodes_of_type(type)) != n)
        continue;
      std::vector<std::uint32_t> nodes;
      for (std::size_t i = 2; i < words.size(); ++i)
        if (const auto node = place(i, file.nodes.size()))
          nodes.push_back(static_cast<std::uint32_t>(*node));
      if (nodes.size() != n)
        continue;
      file.elements.push_back(
          {type, file.elements.size() + 1, static_cast<int>(*entity), file.element_nodes.size(), static_cast<int>(n)});
      file.element_nodes.insert(file.element_nodes.end(), nodes.begin(), nodes.end());
    }
  }
  return mesh;
}

bool finite(const problems::Point2 &x) { return std::isfinite(x[0]) && std::isfinite(x[1]); }

/// What the methods take for granted of a domain.
void check(const geometry::PlaneGeometry &domain, const geometry::WantedGroups &wanted) {
  const auto &mesh = domain.mesh;
  require(!mesh.cells.empty() && domain.area > 0 && std::isfinite(domain.area), "a domain has an area");
  require(domain.extent() > 0 && std::isfinite(domain.extent()), "a domain has an extent");
  require(domain.mean_spacing() > 0 && std::isfinite(domain.mean_spacing()), "cells have a size");
  require(domain.region_names.size() == std::max<std::size_t>(1, wanted.regions.size()), "every region is there");
  require(domain.boundaries.size() == domain.region_names.size(), "every region has a boundary");
  for (const auto &cell : mesh.cells) {
    require(cell.n_vertices == 3 || cell.n_vertices == 4, "triangles and quadrilaterals");
    require(cell.region >= 0 && cell.region < static_cast<int>(domain.region_names.size()), "cells have a region");
    for (unsigned k = 0; k < cell.n_vertices; ++k)
      require(cell.vertices[k] < mesh.vertices.size(), "cells have vertices");
  }
  for (const auto &edge : mesh.boundary)
    require(edge.id >= 0 && edge.id < static_cast<int>(domain.boundary_names.size()), "edges have a boundary's id");
  for (const auto &region : domain.boundaries) {
    std::vector<problems::Point2> begins, ends;
    for (const auto &piece : region) {
      require(finite(piece.begin) && finite(piece.end), "boundaries are finite");
      begins.push_back(piece.begin);
      ends.push_back(piece.end);
    }
    std::ranges::sort(begins);
    std::ranges::sort(ends);
    require(begins == ends, "boundaries are closed");
  }
  // What scenes do with it first.
  const auto fine = geometry::refine(mesh);
  require(fine.cells.size() >= 3 * mesh.cells.size(), "cells are refined in three or four");
  for (const auto &x : fine.vertices)
    require(finite(x), "refined vertices are finite");
  double area = 0;
  for (const double weight : geometry::cell_quadrature(mesh, 2).weights)
    area += weight;
  require(std::isfinite(area), "the quadrature is finite");
  // The sums of a mesh of n cells differ by rounding of the coordinates, whose origin may be far.
  double largest = 0;
  for (const auto &x : mesh.vertices)
    largest = std::max({largest, std::abs(x[0]), std::abs(x[1])});
  if (!domain.second_order)
    require(std::abs(area - domain.area) <= 1e-12 * static_cast<double>(mesh.cells.size()) * largest * largest,
            "the quadrature holds the area");
  geometry::vertex_spacing(mesh);
  require(geometry::components(mesh).second >= 1, "a domain has a piece");
}

} // namespace

void mesh_structure(std::string_view bytes) {
  scene::Diagnostics findings;
  geometry::check_structure(bytes, "square.msh", findings);
  for (const auto &finding : findings.all())
    require(!finding.message.empty() && finding.location.file == "square.msh", "every finding names the file");
}

void mesh_data(std::string_view bytes) {
  const Mesh mesh = mesh_from(bytes);
  scene::Diagnostics findings;
  const auto domain = geometry::make_geometry(mesh.file, mesh.wanted, findings);
  require(domain.has_value() != findings.has_errors(), "a mesh is a domain or has an error");
  if (domain)
    check(*domain, mesh.wanted);
}

} // namespace fuzzing
