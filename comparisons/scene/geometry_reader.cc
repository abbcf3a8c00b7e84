#include "comparisons/scene/geometry_tables.h"
#include "comparisons/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace comparisons::scene {

namespace {

/// Reads the tables of a geometry; findings decide whether they may be used.
class GeometryReader {
public:
  GeometryReader(const Node &root, std::span<const KeyHome> homes, Diagnostics &diagnostics)
      : root_(root), homes_(homes), diagnostics_(diagnostics) {}

  std::optional<GeometryTables> read() {
    const auto errors_before = n_errors();
    GeometryTables tables;
    if (auto geometry = read_one("geometry", geometry_declarations()))
      tables.geometry = std::move(*geometry);
    tables.materials = read_list("material", region_material_declarations());
    tables.boundaries = read_list("boundary", boundary_declarations());
    tables.quantities = read_list("quantity", quantity_declarations());
    if (auto reference = read_one("reference", reference_declarations()))
      tables.reference = std::move(*reference);
    tables.body_force =
        read_effect("body_force", body_force_declarations(), "its force", "force = [\"0 N/m^3\", \"-77 kN/m^3\"]");
    tables.thermal_expansion = read_effect("thermal_expansion", thermal_expansion_declarations(), "its temperature",
                                           "expansion = 1.2e-5 and temperature = \"100*x\"");
    require("material", "region, E, nu and model");
    require("boundary", "group and a displacement, a traction or a pressure");
    if (n_errors() == errors_before) {
      check_materials(tables);
      check_boundaries(tables);
      check_reference(tables);
      check_quantities(tables);
    }
    return n_errors() == errors_before ? std::optional(std::move(tables)) : std::nullopt;
  }

private:
  std::size_t n_errors() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(diagnostics_.all(), [](const auto &d) { return d.severity == Severity::error; }));
  }

  void require(const char *name, const char *keys) {
    if (root_.find(name) == nullptr)
      diagnostics_.error(root_.find("geometry")->key_location, name,
                         fmt::format("a geometry of one's own needs a {}", name),
                         fmt::format("add [[{}]] with {}", name, keys));
  }

  std::optional<PlacedTable> read_table_at(const Node *node, const std::string &key, const std::string &title,
                                           const std::vector<Declaration> &declarations, const Location &location) {
    const auto table = read_table(
        node, {.declarations = declarations, .name = key, .title = title, .lists_allowed = false, .other_keys = {}},
        homes_, location, diagnostics_);
    if (!table.complete || !table.valid)
      return std::nullopt;
    return PlacedTable{std::move(table.combinations().front().parameters), key, location};
  }

  std::optional<PlacedTable> read_one(const char *name, const std::vector<Declaration> &declarations) {
    const Entry *entry = root_.find(name);
    return read_table_at(entry != nullptr ? &entry->value : nullptr, name, fmt::format("[{}]", name), declarations,
                         entry != nullptr ? entry->value.location : Location{});
  }

  /// A list of tables; a single one stands for a list of one.
  std::vector<PlacedTable> read_list(const char *name, const std::vector<Declaration> &declarations) {
    std::vector<PlacedTable> tables;
    const Entry *entry = root_.find(name);
    if (entry == nullptr)
      return tables;
    const auto read = [&](const Node &node, const std::string &key) {
      if (auto table = read_table_at(&node, key, fmt::format("[[{}]]", name), declarations, node.location))
        tables.push_back(std::move(*table));
    };
    if (!entry->value.is(Node::Kind::array))
      read(entry->value, name);
    else
      for (std::size_t i = 0; i < entry->value.items.size(); ++i)
        read(entry->value.items[i], fmt::format("{}[{}]", name, i));
    return tables;
  }

  /// The table of an effect that needs one.
  std::optional<PlacedTable> read_effect(const char *name, const std::vector<Declaration> &declarations,
                                         const char *what, const char *example) {
    const Entry *effects = root_.find("effects");
    const Entry *entry = effects != nullptr ? effects->value.find(name) : nullptr;
    if (entry == nullptr || (entry->value.is(Node::Kind::boolean) && !entry->value.boolean))
      return {};
    const std::string key = fmt::format("effects.{}", name);
    if (!entry->value.is(Node::Kind::table)) {
      diagnostics_.error(entry->value.location, key,
                         fmt::format("with a geometry of one's own the effect needs {}", what),
                         fmt::format("write [{}] and {}", key, example));
      return {};
    }
    return read_table_at(&entry->value, key, fmt::format("[{}]", key), declarations, entry->value.location);
  }

  /// A finding about a key of a table, at the key if the scene gives it.
  void fail(const PlacedTable &table, const char *key, std::string message, std::string suggestion = {}) {
    const auto place = table.keys.location(key);
    diagnostics_.error(place.file.empty() ? table.location : place, table.key + "." + key, std::move(message),
                       std::move(suggestion));
  }

  void check_materials(const GeometryTables &tables) {
    std::set<std::string> regions;
    for (const auto &material : tables.materials) {
      if (material.keys.has("region")) {
        const auto &region = material.keys.text("region");
        if (!regions.insert(region).second)
          fail(material, "region", fmt::format("the region {} has two materials", in_quotes(region)), "remove one");
      } else if (tables.materials.size() > 1)
        fail(material, "region", "of several materials each needs its region", "write region = \"...\"");
      if (material.keys.text("model") != tables.materials.front().keys.text("model"))
        fail(material, "model", "all regions of a plane domain are of one plane model");
      if (material.keys.text("model") == "plane strain" && material.keys.real("nu") >= 0.5)
        fail(material, "nu",
             "0.5 is incompressible: in plane strain no listed method can take it; allowed are values in (-1, 0.5)",
             "use nu = 0.4999, or model = \"plane stress\"");
    }
  }

  void check_boundaries(const GeometryTables &tables) {
    std::set<std::string> groups;
    for (const auto &boundary : tables.boundaries) {
      const auto &keys = boundary.keys;
      if (!groups.insert(keys.text("group")).second)
        fail(boundary, "group", fmt::format("the group {} has two conditions", in_quotes(keys.text("group"))),
             "join them in one [[boundary]]");
      const bool loaded = keys.has("traction") || keys.has("pressure");
      if (keys.has("traction") && keys.has("pressure"))
        fail(boundary, "pressure", "both a traction and a pressure are given", "keep one of them");
      if (!loaded && !keys.has("u1") && !keys.has("u2"))
        diagnostics_.warning(
            boundary.location, boundary.key,
            fmt::format("the boundary {} has no condition and is free of traction", in_quotes(keys.text("group"))),
            "give u1, u2, traction or pressure");
      if (loaded && keys.has("u1") && keys.has("u2"))
        fail(boundary, keys.has("traction") ? "traction" : "pressure",
             "both displacements are given, so that no component is left for a load", "remove u1 or u2, or the load");
    }
  }

  void check_reference(const GeometryTables &tables) {
    const auto &keys = tables.reference.keys;
    static const char *const fields[] = {"u1", "u2", "s11", "s22", "s12"};
    std::vector<std::string> missing;
    for (const auto *field : fields)
      if (!keys.has(field))
        missing.emplace_back(field);
    const std::string solution = keys.has("solution") ? keys.text("solution")
                                 : missing.size() < 5 ? "expressions"
                                 : keys.has("file")   ? "file"
                                                      : "";
    if (solution == "expressions" && !missing.empty())
      diagnostics_.error(
          tables.reference.location, "reference",
          fmt::format("an exact solution by expressions needs all five fields; missing: {}", fmt::join(missing, ", ")));
    const auto needs = [&](const char *key) {
      if (!keys.has(key))
        diagnostics_.error(tables.reference.location, std::string("reference.") + key,
                           fmt::format("the solution '{}' needs {}", solution, key));
    };
    if (solution == "elliptic hole") {
      needs("semi_axis_1");
      needs("semi_axis_2");
    }
    if (solution == "elliptic hole" || solution == "re-entrant corner")
      needs("stress");
    if (solution == "file")
      needs("file");
    else if (keys.has("file"))
      diagnostics_.error(keys.location("file"), "reference.file",
                         fmt::format("a file is given, but the solution is '{}'", solution),
                         "solution = \"file\", or remove the file");
    if (solution.empty() || solution == "finer fem" || solution == "file")
      for (const auto &boundary : tables.boundaries)
        for (const auto *key : {"u1", "u2", "traction"})
          if (boundary.keys.has(key) && boundary.keys.text(key) == "reference")
            fail(boundary, key,
                 solution == "file"
                     ? "the reference is known at points only, which cannot give conditions"
                     : "the reference is a finite-element solution, which cannot give its own conditions",
                 "give [reference] expressions or a named solution");
  }

  void check_quantities(const GeometryTables &tables) {
    std::set<std::string> names;
    for (const auto &quantity : tables.quantities) {
      const auto &keys = quantity.keys;
      const auto &kind = keys.text("kind");
      if (keys.text("name").empty() || !names.insert(keys.text("name")).second)
        fail(quantity, "name", "each quantity has a name of its own");
      const auto needs = [&](const char *key) {
        if (!keys.has(key))
          fail(quantity, key, fmt::format("a quantity of kind '{}' needs '{}'", kind, key));
      };
      const auto component = [&](std::vector<std::string> allowed) {
        needs("component");
        if (keys.has("component") && std::ranges::find(allowed, keys.text("component")) == allowed.end())
          fail(quantity, "component",
               fmt::format("{} has no component {}; allowed: {}", kind, in_quotes(keys.text("component")),
                           fmt::join(allowed, ", ")));
      };
      if (kind == "displacement" || kind == "stress")
        needs("point");
      if (kind == "displacement")
        component({"1", "2", "magnitude"});
      if (kind == "stress")
        component({"11", "22", "12", "von_mises"});
      if (kind == "reaction") {
        component({"1", "2"});
        needs("group");
      }
      if (kind == "line") {
        needs("from");
        needs("to");
      }
      if (keys.real("scale") == 0)
        fail(quantity, "scale", "0 cannot divide");
    }
  }

  const Node &root_;
  std::span<const KeyHome> homes_;
  Diagnostics &diagnostics_;
};

} // namespace

std::optional<GeometryTables> read_geometry_tables(const Node &root, std::span<const KeyHome> homes,
                                                   Diagnostics &diagnostics) {
  return GeometryReader(root, homes, diagnostics).read();
}

std::array<std::string, 2> split_expressions(const std::string &text) {
  const auto place = text.find("; ");
  if (place == std::string::npos)
    return {text, text};
  return {text.substr(0, place), text.substr(place + 2)};
}

bool SceneReader::has_geometry() const { return table("geometry") != nullptr; }

void SceneReader::read_geometry() {
  if (auto tables = read_geometry_tables(root_, homes_, diagnostics_))
    scene_.geometry = std::make_shared<const GeometryTables>(std::move(*tables));
  // The first material stands for all in the checks of methods; findings about it were told above.
  const Node *materials = table("material");
  if (materials != nullptr && materials->is(Node::Kind::array))
    materials = materials->items.empty() ? nullptr : &materials->items.front();
  Diagnostics told;
  material_ = read_table(materials,
                         {.declarations = benchmark_->material,
                          .name = "material",
                          .title = "[[material]]",
                          .lists_allowed = false,
                          .other_keys = {}},
                         homes_, here(), told);
}

} // namespace comparisons::scene
