#include "comparisons/program/geometry_description.h"

#include "comparisons/problems/geometry_problem.h"
#include "comparisons/scene/describe.h"
#include "comparisons/scene/geometry_tables.h"
#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace comparisons::program {

namespace {

std::string condition_text(const scene::PlacedTable *table) {
  if (table == nullptr)
    return "free of traction";
  std::string text;
  for (const auto *key : {"u1", "u2", "traction", "pressure"})
    if (table->keys.has(key))
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, table->keys.text(key));
  return text.empty() ? "free of traction" : text;
}

std::string regions_text(const problems::ResolvedGeometry &geometry) {
  std::map<int, std::size_t> cells;
  for (const auto &cell : geometry.shape.mesh.cells)
    ++cells[cell.region];
  std::string text = "Regions\n";
  const auto &regions = geometry.statement.regions;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto &material = regions[r].material;
    text += fmt::format("  {:<20} {:>8} cells  E = {}, nu = {:.6g}, {}\n",
                        regions[r].name.empty() ? "the whole domain" : regions[r].name, cells[static_cast<int>(r)],
                        scene::quantity_text(material.youngs_modulus, scene::dimensions::pressure),
                        material.poisson_ratio, material.plane_strain ? "plane strain" : "plane stress");
  }
  return text;
}

std::string boundaries_text(const scene::Scene &scene, const problems::ResolvedGeometry &geometry) {
  std::map<int, std::pair<std::size_t, double>> edges;
  const auto &mesh = geometry.shape.mesh;
  for (const auto &edge : mesh.boundary) {
    const auto &a = mesh.vertices[edge.vertices[0]];
    const auto &b = mesh.vertices[edge.vertices[1]];
    auto &[n, length] = edges[edge.id];
    ++n;
    length += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  std::string text = "Boundaries\n";
  for (const auto &[id, count] : edges) {
    const auto &name = geometry.shape.boundary_names[static_cast<std::size_t>(id)];
    const scene::PlacedTable *condition = nullptr;
    for (const auto &table : scene.geometry->boundaries)
      if (table.keys.text("group") == name)
        condition = &table;
    text +=
        fmt::format("  {:<20} {:>8} edges  {:.4g} m  {}\n", name, count.first, count.second, condition_text(condition));
  }
  return text;
}

} // namespace

std::string describe_geometry(const scene::Scene &scene) {
  const auto geometry = std::static_pointer_cast<const problems::ResolvedGeometry>(scene.resolved);
  if (geometry == nullptr || scene.geometry == nullptr)
    throw std::logic_error("the scene's geometry was not read");
  const auto &shape = geometry->shape;
  std::string text = fmt::format(
      "Geometry {}: {} cells of {} order, {:.4g} m^2, x from {:.6g} to {:.6g} m, y from {:.6g} to {:.6g} m\n",
      scene.geometry->geometry.keys.text("file"), shape.mesh.cells.size(), shape.second_order ? "second" : "first",
      shape.area, shape.lower[0], shape.upper[0], shape.lower[1], shape.upper[1]);
  text += regions_text(*geometry) + boundaries_text(scene, *geometry);
  text += "Levels\n";
  for (const auto &[name, mesh] : geometry->levels)
    text += fmt::format("  {:<20} {:>8} cells  {} vertices\n", name, mesh.cells.size(), mesh.vertices.size());
  for (const auto &remark : geometry->remarks)
    text += "  Note: " + remark + "\n";
  return text;
}

std::string describe_geometry_keys() {
  std::string text;
  for (const auto &[title, declarations] : {std::pair{"[geometry]", scene::geometry_declarations()},
                                            {"[[material]]", scene::region_material_declarations()},
                                            {"[[boundary]]", scene::boundary_declarations()},
                                            {"[effects.body_force]", scene::body_force_declarations()},
                                            {"[effects.thermal_expansion]", scene::thermal_expansion_declarations()},
                                            {"[reference]", scene::reference_declarations()},
                                            {"[[quantity]]", scene::quantity_declarations()}})
    text += fmt::format("{}\n{}\n", title, scene::describe_declarations(declarations));
  return text;
}

} // namespace comparisons::program
