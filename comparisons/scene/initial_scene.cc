#include "comparisons/scene/describe.h"
#include "comparisons/scene/geometry_tables.h"
#include "comparisons/scene/reader.h"
#include "comparisons/scene/table_reader.h"
#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::scene {

namespace {

std::string toml_string(const std::string &text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F)
      result += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result += c;
  }
  return result + "\"";
}

/// A value inside the range, for a required key without default.
Value placeholder(const Declaration &declaration) {
  const Range &range = declaration.range;
  double number = 1;
  if (std::isfinite(range.lower) && std::isfinite(range.upper))
    number = 0.5 * (range.lower + range.upper);
  else if (std::isfinite(range.lower))
    number = range.lower_open ? std::max(1.0, range.lower + 1) : range.lower;
  else if (std::isfinite(range.upper))
    number = std::min(1.0, range.upper - 1);
  switch (declaration.type) {
  case Type::boolean:
    return true;
  case Type::integer:
    return static_cast<std::int64_t>(std::ceil(number));
  case Type::real:
    return number;
  case Type::text:
    return std::string("fill in");
  case Type::expression:
    return std::string("0");
  case Type::expressions:
    return std::string("0; 0");
  case Type::choice:
    return declaration.choices.empty() ? std::string{} : declaration.choices.front();
  case Type::point:
    return Point{number, number};
  }
  return number;
}

std::string comment(const Declaration &declaration) {
  const std::string allowed = allowed_text(declaration);
  return declaration.meaning + (allowed.empty() ? "" : "; " + allowed);
}

/// One line a key: the default (as a comment if `quiet`), a placeholder for what is required.
std::string key_lines(std::span<const Declaration> declarations, bool quiet) {
  std::string text;
  for (const Declaration &declaration : declarations) {
    std::string line;
    if (declaration.default_value)
      line = fmt::format("{}{} = {}", quiet ? "# " : "", declaration.name,
                         toml_text(*declaration.default_value, declaration.dimension));
    else if (declaration.required)
      line = fmt::format("{} = {}", declaration.name, toml_text(placeholder(declaration), declaration.dimension));
    else
      line = fmt::format("# {} =", declaration.name);
    constexpr std::size_t comment_column = 36;
    text += fmt::format("{:{}} # {}{}\n", line, comment_column, comment(declaration),
                        declaration.required && !declaration.default_value ? "; required: fill in" : "");
  }
  return text;
}

std::string level_list(const BenchmarkDescription &benchmark, std::span<const std::string> levels) {
  if (!levels.empty())
    return fmt::format("{}", fmt::join(levels, ", "));
  if (benchmark.own_geometry)
    return "\"mesh\", \"mesh/2\"";
  return benchmark.counts_per_level == 1 ? "16, 32" : "\"16x4\", \"31x7\"";
}

/// The tables of a geometry of one's own, to be filled in.
std::string geometry_tables() {
  std::string text = "\n[geometry]\n" + key_lines(geometry_declarations(), true);
  text += "\n[[material]]  # one for each region, or one without the key region for the whole domain\n" +
          key_lines(region_material_declarations(), true);
  text += "\n[[boundary]]  # one for each group of curves; what is not named is free of traction\n" +
          key_lines(boundary_declarations(), true);
  const auto as_comments = [](const std::string &title, std::vector<Declaration> declarations) {
    std::string lines = "\n# " + title + "\n";
    for (const auto &declaration : declarations)
      lines += fmt::format("# {:34} # {}\n", declaration.name + " =", comment(declaration));
    return lines;
  };
  text += as_comments("[reference]  # what errors are relative to", reference_declarations());
  text += as_comments("[[quantity]]  # figures and lines of interest", quantity_declarations());
  return text;
}

} // namespace

std::string toml_text(const Value &value, const Dimension &dimension) {
  const auto number = [&](double v) {
    const std::string text = quantity_text(v, dimension);
    return dimension == dimensions::none ? text : "\"" + text + "\"";
  };
  if (const auto *real = std::get_if<double>(&value))
    return number(*real);
  if (const auto *point = std::get_if<Point>(&value))
    return fmt::format("[{}, {}]", number((*point)[0]), number((*point)[1]));
  if (const auto *text = std::get_if<std::string>(&value))
    return toml_string(*text);
  return to_text(value);
}

std::string initial_scene(const BenchmarkDescription &benchmark, std::span<const MethodDescription> methods,
                          std::span<const std::string> levels) {
  std::string text = fmt::format("schema = 1\ntitle = {}\n", toml_string(benchmark.meaning));
  if (!benchmark.own_geometry)
    text += fmt::format("benchmark = {}\n", toml_string(benchmark.name));
  text += "# Numbers are in SI; a quantity may carry its unit: \"226.9 GPa\".\n";
  if (!benchmark.problem.empty())
    text += "\n[problem]  # a list in place of a value makes one problem per combination\n" +
            key_lines(benchmark.problem, false);
  if (benchmark.own_geometry)
    text += geometry_tables();
  else if (!benchmark.material.empty())
    text += "\n[material]\n" + key_lines(benchmark.material, false);
  if (!benchmark.effects.empty()) {
    text += "\n[effects]  # what is not named here is neither computed nor allocated\n";
    for (const auto &effect : benchmark.effects)
      text += effect + " = true\n";
  }
  if (!benchmark.time.empty())
    text += "\n[time]\n" + key_lines(benchmark.time, true);
  for (const auto &method : methods) {
    text += fmt::format("\n[[method]]  # {}\nname = {}\n", method.meaning, toml_string(method.name));
    text += "# label = \"...\"                      # name in the tables\n";
    text += key_lines(method.parameters, true);
  }
  text += fmt::format("\n[study]\nlevels = [{}]\n", level_list(benchmark, levels));
  auto study = study_declarations();
  std::erase_if(study, [&](const Declaration &d) {
    return d.name == "levels" || (d.name == "facts" && !benchmark.methods.empty());
  });
  for (auto &declaration : study)
    if (declaration.name == "analysis") {
      declaration.choices = benchmark.analyses;
      declaration.default_value = benchmark.analyses.front();
    }
  text += key_lines(study, true);
  text += "\n[output]\n";
  text += key_lines(output_declarations(), true);
  return text;
}

} // namespace comparisons::scene
