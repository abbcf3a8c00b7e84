#include "comparisons/scene/scene_reader.h"

#include "comparisons/scene/geometry_tables.h"
#include "comparisons/scene/overrides.h"
#include "comparisons/scene/reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>

namespace comparisons::scene {

namespace {

constexpr std::int64_t schema_version = 1;

std::vector<std::string> names_of(const auto &descriptions) {
  std::vector<std::string> names;
  for (const auto &description : descriptions)
    names.push_back(description.name);
  return names;
}

/// The declarations but the named one, which is read apart.
std::vector<Declaration> without(std::vector<Declaration> declarations, std::string_view name) {
  std::erase_if(declarations, [&](const Declaration &d) { return d.name == name; });
  return declarations;
}

/// The only combination of a table without lists.
Parameters single(const ResolvedTable &table) { return std::move(table.combinations().front().parameters); }

} // namespace

SceneReader::SceneReader(const Node &root, std::string file, const Vocabulary &vocabulary, Diagnostics &diagnostics)
    : root_(root), file_(std::move(file)), vocabulary_(vocabulary), diagnostics_(diagnostics) {}

std::optional<Scene> SceneReader::read() {
  read_benchmark(); // first: it decides what the other tables may hold
  homes_ = key_homes();
  read_top();
  read_problem_and_material();
  read_effects();
  read_time();
  for (const auto &[name, location] : effects_)
    scene_.effects.push_back(name);
  std::ranges::sort(scene_.effects);
  read_study();
  read_output();
  read_methods();
  require_levels();
  match_effects();
  expand();
  cross_check();
  if (scene_.geometry != nullptr && benchmark_->resolve) {
    scene_.file = file_;
    benchmark_->resolve(scene_, diagnostics_);
  }
  if (diagnostics_.has_errors())
    return std::nullopt;
  scene_.file = file_;
  const std::filesystem::path path(file_);
  scene_.name = path.stem().string();
  // Every geometry of one's own is of the same 'benchmark': its folder tells them apart.
  if (const auto folder = path.parent_path().filename().string(); has_geometry() && !folder.empty() && folder != ".")
    scene_.name = scene_.name == "scene" ? folder : folder + "/" + scene_.name;
  scene_.benchmark = benchmark_->name;
  scene_.material = single(material_);
  scene_.time = single(time_);
  scene_.study = single(study_);
  scene_.output = single(output_);
  return std::move(scene_);
}

const Node *SceneReader::table(std::string_view name) const {
  const Entry *entry = root_.find(name);
  return entry != nullptr ? &entry->value : nullptr;
}

LevelForm SceneReader::level_form() const {
  if (benchmark_ == nullptr)
    return {};
  return {.counts_per_level = benchmark_->counts_per_level,
          .benchmark = benchmark_->name,
          .meshes = benchmark_->own_geometry};
}

std::vector<KeyHome> SceneReader::key_homes() const {
  std::vector<KeyHome> homes;
  for (const auto *key : {"schema", "title", "benchmark"})
    homes.push_back({key, "the top of the file, before the first table"});
  const auto add = [&](const std::vector<Declaration> &declarations, const std::string &home) {
    for (const auto &declaration : declarations)
      homes.push_back({declaration.name, home});
  };
  if (benchmark_ != nullptr) {
    add(benchmark_->problem, "[problem]");
    add(benchmark_->material, benchmark_->own_geometry ? "[[material]]" : "[material]");
    add(benchmark_->time, "[time]");
  }
  if (has_geometry()) {
    add(geometry_declarations(), "[geometry]");
    add(boundary_declarations(), "[[boundary]]");
    add(reference_declarations(), "[reference]");
    add(quantity_declarations(), "[[quantity]]");
  }
  add(study_declarations(), "[study]");
  add(output_declarations(), "[output]");
  std::map<std::string, std::string> methods; // the methods that have a key
  for (const auto &method : vocabulary_.methods)
    for (const auto &declaration : method.parameters) {
      std::string &names = methods[declaration.name];
      names += (names.empty() ? "" : ", ") + method.name;
    }
  for (const auto &[key, names] : methods)
    homes.push_back({key, "[[method]] with name = " + names});
  for (const auto &key : common_method_keys())
    homes.push_back({key, "[[method]]"});
  for (const auto &effect : vocabulary_.effects) {
    homes.push_back({effect.name, "[effects]"});
    add(effect.parameters, fmt::format("[effects.{}]", effect.name));
  }
  return homes;
}

void SceneReader::read_top() {
  std::vector<std::string> tables{"problem", "material", "effects", "time", "method", "study", "output"};
  const std::vector<std::string> of_geometry{"geometry", "boundary", "reference", "quantity"};
  const std::vector<std::string> &reserved = of_geometry;
  if (has_geometry())
    tables.insert(tables.end(), of_geometry.begin(), of_geometry.end());
  std::vector<std::string> known{"schema", "title", "benchmark"};
  known.insert(known.end(), tables.begin(), tables.end());
  const auto has = [](const auto &names, const auto &name) { return std::ranges::find(names, name) != names.end(); };
  for (const Entry &entry : root_.entries) {
    if (has(reserved, entry.key) || has(known, entry.key))
      continue;
    const bool is_table =
        entry.value.is(Node::Kind::table) || (entry.value.is(Node::Kind::array) && !entry.value.items.empty() &&
                                              entry.value.items.front().is(Node::Kind::table));
    if (is_table)
      diagnostics_.error(entry.key_location, {},
                         fmt::format("unknown table {}; allowed: {}", in_quotes(entry.key), fmt::join(tables, ", ")),
                         did_you_mean(entry.key, tables));
    else
      unknown_key(entry, {}, "the top of the file", known, homes_, diagnostics_);
  }
  read_reserved_tables();
  read_schema();
  read_title();
}

/// Tables that only a geometry of one's own has deserve a better answer than 'unknown' in other scenes.
void SceneReader::read_reserved_tables() {
  const auto own = std::ranges::find(vocabulary_.benchmarks, true, &BenchmarkDescription::own_geometry);
  for (const Entry &entry : root_.entries) {
    const bool materials = entry.key == "material" && entry.value.is(Node::Kind::array);
    if (has_geometry() && own != vocabulary_.benchmarks.end())
      continue;
    if (materials)
      diagnostics_.error(entry.key_location, entry.key, "several materials belong to a geometry of one's own",
                         "write [material] and its keys below, or add [geometry] with file = \"...\"");
    else if (entry.key == "geometry" || entry.key == "boundary" || entry.key == "reference" || entry.key == "quantity")
      diagnostics_.error(entry.key_location, entry.key,
                         fmt::format("the table '{}' belongs to a geometry of one's own", entry.key),
                         "add [geometry] with file = \"...\", or remove this table");
  }
}

void SceneReader::read_schema() {
  const Node *node = table("schema");
  if (node == nullptr)
    diagnostics_.error(here(), "schema", "the required key 'schema' is missing", "write schema = 1");
  else if (!node->is(Node::Kind::integer))
    diagnostics_.error(node->location, "schema", fmt::format("expected the whole number 1, found {}", describe(*node)),
                       "write schema = 1");
  else if (node->integer != schema_version)
    diagnostics_.error(node->location, "schema",
                       fmt::format("schema {} is unknown; this version reads schema 1", node->integer),
                       "write schema = 1");
}

void SceneReader::read_title() {
  const Node *node = table("title");
  if (node == nullptr) {
    scene_.title = benchmark_ != nullptr ? benchmark_->meaning : "";
    return;
  }
  const Declaration declaration{.name = "title", .type = Type::text, .meaning = "heading of the report"};
  if (const auto value = read_value(*node, declaration, "title", diagnostics_))
    scene_.title = std::get<std::string>(*value);
  if (std::ranges::any_of(scene_.title, [](unsigned char c) { return c < 0x20; }))
    diagnostics_.error(node->location, "title", "a title is one line without control characters");
}

void SceneReader::read_benchmark() {
  const auto names = names_of(vocabulary_.benchmarks);
  const std::string allowed = fmt::format("{}", fmt::join(names, ", "));
  const Node *node = table("benchmark");
  const auto own = std::ranges::find(vocabulary_.benchmarks, true, &BenchmarkDescription::own_geometry);
  if (has_geometry() && own != vocabulary_.benchmarks.end()) {
    benchmark_ = &*own;
    if (node != nullptr && !(node->is(Node::Kind::text) && node->text == own->name))
      diagnostics_.error(node->location, "benchmark", "a scene has a benchmark or a [geometry], not both",
                         "remove one of them");
    return;
  }
  if (node == nullptr) {
    if (!has_geometry()) // else read_reserved_tables says it
      diagnostics_.error(here(), "benchmark", "the required key 'benchmark' is missing; allowed: " + allowed);
    return;
  }
  if (!node->is(Node::Kind::text)) {
    diagnostics_.error(node->location, "benchmark",
                       fmt::format("expected a text, one of {}; found {}", allowed, describe(*node)));
    return;
  }
  const auto found = std::ranges::find(vocabulary_.benchmarks, node->text, &BenchmarkDescription::name);
  if (found != vocabulary_.benchmarks.end() && found->own_geometry)
    diagnostics_.error(node->location, "benchmark", "the scene has no [geometry]",
                       "add [geometry] with file = \"...\", a mesh or a drawing of Gmsh");
  else if (found != vocabulary_.benchmarks.end())
    benchmark_ = &*found;
  else
    diagnostics_.error(node->location, "benchmark",
                       fmt::format("unknown benchmark {}; allowed: {}", in_quotes(node->text), allowed),
                       did_you_mean(node->text, names));
}

void SceneReader::read_problem_and_material() {
  if (benchmark_ == nullptr)
    return;
  problem_ = read_table(table("problem"),
                        {.declarations = benchmark_->problem,
                         .name = "problem",
                         .title = "[problem]",
                         .lists_allowed = true,
                         .other_keys = {}},
                        homes_, here(), diagnostics_);
  if (has_geometry())
    return read_geometry();
  const Node *material = table("material");
  if (material != nullptr && material->is(Node::Kind::array))
    material = nullptr; // reported by read_reserved_tables
  material_ = read_table(material,
                         {.declarations = benchmark_->material,
                          .name = "material",
                          .title = "[material]",
                          .lists_allowed = false,
                          .other_keys = {}},
                         homes_, here(), diagnostics_);
}

void SceneReader::read_study() {
  auto declarations = without(study_declarations(), "levels");
  if (benchmark_ != nullptr && !benchmark_->methods.empty()) // facts are of the table's methods in the plane
    declarations = without(std::move(declarations), "facts");
  for (auto &declaration : declarations)
    if (declaration.name == "analysis" && benchmark_ != nullptr) {
      declaration.choices = benchmark_->analyses;
      declaration.default_value = benchmark_->analyses.front();
    }
  const Node *node = table("study");
  study_ = read_table(node,
                      {.declarations = declarations,
                       .name = "study",
                       .title = "[study]",
                       .lists_allowed = false,
                       .other_keys = {"levels"}},
                      homes_, here(), diagnostics_);
  const Entry *levels = node != nullptr ? node->find("levels") : nullptr;
  study_has_levels_ = levels != nullptr;
  if (levels != nullptr)
    scene_.levels = read_levels(levels->value, level_form(), "study.levels", diagnostics_);
}

void SceneReader::read_output() {
  const auto declarations = without(output_declarations(), "formats");
  const Node *node = table("output");
  output_ = read_table(node,
                       {.declarations = declarations,
                        .name = "output",
                        .title = "[output]",
                        .lists_allowed = false,
                        .other_keys = {"formats"}},
                       homes_, here(), diagnostics_);
  const Entry *directory = node != nullptr ? node->find("directory") : nullptr;
  if (directory != nullptr && directory->value.is(Node::Kind::text) && directory->value.text.empty())
    diagnostics_.error(directory->value.location, "output.directory", "the directory's name is empty",
                       "write for example \"out\"");
  read_formats(node);
}

void SceneReader::read_formats(const Node *output) {
  const auto names = names_of(vocabulary_.formats);
  const Entry *formats = output != nullptr ? output->find("formats") : nullptr;
  if (formats == nullptr) {
    for (const auto *name : {"text", "json", "csv", "md", "tex", "html", "figures"})
      if (std::ranges::find(names, name) != names.end())
        scene_.formats.emplace_back(name);
    return;
  }
  const Declaration declaration{.name = "format", .type = Type::choice, .choices = names, .meaning = ""};
  const Node &node = formats->value;
  const auto read = [&](const Node &item) {
    const auto value = read_value(item, declaration, "output.formats", diagnostics_);
    if (!value)
      return;
    const auto &name = std::get<std::string>(*value);
    if (std::ranges::find(scene_.formats, name) == scene_.formats.end())
      scene_.formats.push_back(name);
    else
      diagnostics_.error(item.location, "output.formats", fmt::format("the format '{}' stands twice", name),
                         "remove one of them");
  };
  if (!node.is(Node::Kind::array))
    return read(node);
  if (node.items.empty())
    diagnostics_.error(node.location, "output.formats",
                       fmt::format("an empty list of formats; allowed: {}", fmt::join(names, ", ")));
  for (const Node &item : node.items)
    read(item);
}

} // namespace comparisons::scene
