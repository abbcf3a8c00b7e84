#include "comparisons/scene/reader.h"

#include "comparisons/scene/document.h"
#include "comparisons/scene/hash.h"
#include "comparisons/scene/overrides.h"
#include "comparisons/scene/scene_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace comparisons::scene {

namespace {

std::string hash_of(const std::string &text, std::span<const std::string> overrides) {
  Hash hash;
  hash.add(text);
  for (const auto &text_of_override : overrides)
    hash.add(text_of_override);
  return hash.text();
}

/// A file's name may hold any bytes; messages and JSON need UTF-8.
std::string printable(std::string name) {
  std::size_t position = 0;
  while (!is_plain_utf8(name, position))
    name[position] = '?';
  return name;
}

/// Findings in the order of the file; those without a place come last.
Diagnostics in_order(const Diagnostics &diagnostics) {
  auto all = diagnostics.all();
  std::ranges::stable_sort(all, {}, [](const Diagnostic &d) {
    return std::tuple(d.location.line == 0, d.location.line, d.location.column);
  });
  Diagnostics sorted;
  for (auto &diagnostic : all)
    sorted.add(std::move(diagnostic));
  return sorted;
}

/// The vocabulary with the methods that the scene's benchmark has for itself, if it has.
Vocabulary vocabulary_for(const Node &root, const Vocabulary &vocabulary) {
  Vocabulary result = vocabulary;
  if (const Entry *entry = root.find("benchmark"); entry != nullptr && entry->value.is(Node::Kind::text))
    for (const auto &benchmark : vocabulary.benchmarks)
      if (benchmark.name == entry->value.text && !benchmark.methods.empty())
        result.methods = benchmark.methods;
  return result;
}

} // namespace

ReadResult read_scene_text(const std::string &text, const std::string &file, std::span<const std::string> overrides,
                           const Vocabulary &vocabulary) {
  Diagnostics diagnostics;
  std::optional<Scene> scene;
  const std::string name = printable(file);
  if (auto root = parse_document(text, name, diagnostics)) {
    const Vocabulary own = vocabulary_for(*root, vocabulary);
    apply_overrides(*root, overrides, own, diagnostics);
    scene = SceneReader(*root, name, own, diagnostics).read();
  }
  if (scene)
    scene->hash = hash_of(text, overrides);
  return {std::move(scene), in_order(diagnostics)};
}

ReadResult read_scene(const std::filesystem::path &file, std::span<const std::string> overrides,
                      const Vocabulary &vocabulary) {
  Diagnostics diagnostics;
  const auto text = read_file(file, diagnostics);
  if (!text)
    return {std::nullopt, std::move(diagnostics)};
  return read_scene_text(*text, file.string(), overrides, vocabulary);
}

std::vector<Declaration> study_declarations() {
  const Range from_one{.lower = 1};
  return {
      {.name = "levels",
       .type = Type::text,
       .required = true,
       .meaning = "list of resolutions: 188, \"16x4\", [16, 4] or a spacing \"5 mm\""},
      {.name = "analysis",
       .type = Type::choice,
       .choices = {"static", "transient", "modes"},
       .default_value = "static",
       .meaning = "kind of analysis; the benchmark says which it knows"},
      {.name = "effort",
       .type = Type::choice,
       .choices = {"quick", "full"},
       .default_value = "quick",
       .meaning = "the run of shipped scenes that this one belongs to"},
      {.name = "repeats",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 1000},
       .default_value = std::int64_t{1},
       .meaning = "timed runs of every cell, after one warm-up"},
      {.name = "threads",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 1024},
       .default_value = std::int64_t{1},
       .meaning =
           "threads of every method: BLAS, the assembly of particle methods in weak form and of finite elements, "
           "multigrid"},
      {.name = "facts",
       .type = Type::boolean,
       .default_value = false,
       .meaning = "also measure what Zhang & Batra 2008, Table 7, compares in words (plane static scenes)"},
      {.name = "seed",
       .type = Type::integer,
       .range = {.lower = 0},
       .default_value = std::int64_t{42},
       .meaning = "start of the random numbers"},
      {.name = "max_seconds",
       .type = Type::real,
       .dimension = dimensions::time,
       .range = {.lower = 0, .lower_open = true},
       .meaning = "longest time of one cell, in s"},
      {.name = "max_memory",
       .type = Type::integer,
       .range = from_one,
       .meaning = "most memory of one cell: \"4 GiB\", \"500 MB\", or bytes",
       .is_bytes = true},
  };
}

std::vector<Declaration> output_declarations() {
  return {
      {.name = "directory", .type = Type::text, .default_value = "out", .meaning = "folder of the results"},
      {.name = "formats", .type = Type::text, .meaning = "list of the reports' formats; default all but vtu"},
  };
}

} // namespace comparisons::scene
