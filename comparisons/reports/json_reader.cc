#include "comparisons/reports/json.h"
#include "comparisons/reports/json_depth.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

namespace comparisons::reports {

namespace {

using Json = nlohmann::ordered_json;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// One value of the file together with its path, so that every complaint can name the place.
class Node {
public:
  Node(const Json &json, std::string path) : json_(&json), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string &message) const { throw ResultsError(path_, message); }

  Node at(const char *key) const {
    expect(json_->is_object(), "an object");
    const auto found = json_->find(key);
    if (found == json_->end())
      fail(fmt::format("the key '{}' is missing", key));
    return {*found, path_ + "." + key};
  }

  std::string text() const {
    expect(json_->is_string(), "a text");
    return json_->get<std::string>();
  }

  /// Text of a key that older files lack.
  std::string text_or_empty(const char *key) const { return has(key) ? at(key).text() : std::string(); }

  bool boolean() const {
    expect(json_->is_boolean(), "true or false");
    return json_->get<bool>();
  }

  std::int64_t count() const {
    expect(json_->is_number_integer(), "a whole number");
    if (json_->is_number_unsigned() && json_->get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max())
      fail("the number is too large");
    const auto value = json_->get<std::int64_t>();
    if (value < 0)
      fail(fmt::format("found {}, expected 0 or more", value));
    return value;
  }

  int small_count() const {
    const std::int64_t value = count();
    if (value > std::numeric_limits<int>::max())
      fail("the number is too large");
    return static_cast<int>(value);
  }

  double number_or_nan() const { return json_->is_null() ? not_a_number : number(); }

  std::optional<double> optional_number() const {
    return json_->is_null() ? std::nullopt : std::optional<double>(number());
  }

  std::vector<Node> items() const {
    expect(json_->is_array(), "an array");
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < json_->size(); ++i)
      nodes.emplace_back((*json_)[i], fmt::format("{}[{}]", path_, i));
    return nodes;
  }

  std::vector<std::pair<std::string, Node>> members() const {
    expect(json_->is_object(), "an object");
    std::vector<std::pair<std::string, Node>> nodes;
    for (const auto &[key, value] : json_->items())
      nodes.push_back({key, {value, path_ + "." + key}});
    return nodes;
  }

  std::vector<std::string> texts() const {
    std::vector<std::string> all;
    for (const Node &node : items())
      all.push_back(node.text());
    return all;
  }

  bool has(const char *key) const {
    expect(json_->is_object(), "an object");
    return json_->contains(key);
  }

  const Json &json() const { return *json_; }

private:
  double number() const {
    expect(json_->is_number(), "a number or null");
    const auto value = json_->get<double>();
    if (!std::isfinite(value))
      fail("the number is not finite");
    return value;
  }

  void expect(bool condition, const char *what) const {
    if (!condition)
      fail(fmt::format("found {} ({}), expected {}", json_->type_name(), excerpt(), what));
  }

  std::string excerpt() const {
    std::string text = json_->dump(-1, ' ', true, Json::error_handler_t::replace);
    if (text.size() > 40)
      text = text.substr(0, 40) + " ...";
    return text;
  }

  const Json *json_;
  std::string path_;
};

template <typename Convert>
auto word(const Node &node, Convert convert, const char *allowed) {
  const std::string text = node.text();
  const auto value = convert(text);
  if (!value)
    node.fail(fmt::format("found '{}', expected one of {}", text, allowed));
  return *value;
}

std::map<std::string, double> read_numbers(const Node &node) {
  std::map<std::string, double> map;
  for (const auto &[name, value] : node.members())
    map[name] = value.number_or_nan();
  return map;
}

std::map<std::string, Spread> read_seconds(const Node &node) {
  std::map<std::string, Spread> seconds;
  const Node minimum = node.at("minimum");
  const Node maximum = node.at("maximum");
  for (const char *phase : phases) {
    if (!node.has(phase))
      continue;
    seconds[phase] = {node.at(phase).number_or_nan(), minimum.at(phase).number_or_nan(),
                      maximum.at(phase).number_or_nan()};
  }
  return seconds;
}

/// Reports are rebuilt into files beside these: none may lie outside the folder.
Series read_series(const Node &node) {
  Series series{node.at("name").text(), node.at("file").text()};
  const std::filesystem::path file = std::filesystem::path(series.file).lexically_normal();
  if (file.empty() || file.is_absolute() || *file.begin() == "..")
    node.at("file").fail(fmt::format("found '{}', expected a file below the folder of the results", series.file));
  if (node.has("time"))
    series.time = node.at("time").optional_number();
  return series;
}

Cell read_cell(const Node &node) {
  Cell cell;
  cell.benchmark = node.at("benchmark").text();
  cell.scene = node.text_or_empty("scene");
  cell.variant = node.text_or_empty("variant");
  cell.method = node.at("method").text();
  cell.label = node.at("label").text();
  cell.level = node.at("level").text();
  if (node.has("dimension")) {
    cell.dimension = node.at("dimension").small_count();
    if (cell.dimension < 1 || cell.dimension > 3)
      node.at("dimension").fail(fmt::format("found {}, expected 1, 2 or 3", cell.dimension));
  }
  cell.n_points = node.at("n_points").count();
  cell.n_dofs = node.at("n_dofs").count();
  cell.parameters = node.at("parameters").json();
  node.at("parameters").members(); // must be an object
  cell.status = word(node.at("status"), status_from_text, "ok, refused, failed, limit");
  cell.reason = node.at("reason").text();
  if (node.has("warnings"))
    cell.warnings = node.at("warnings").texts();
  cell.errors = read_numbers(node.at("errors"));
  cell.quantities = read_numbers(node.at("quantities"));
  if (node.has("linear_solver"))
    for (const auto &[name, value] : node.at("linear_solver").members())
      cell.linear_solver[name] = value.text();
  cell.seconds = read_seconds(node.at("seconds"));
  cell.repeats = node.at("seconds").at("repeats").small_count();
  for (const Node &series : node.at("series").items())
    cell.series.push_back(read_series(series));
  cell.steps = node.at("steps").count();
  cell.memory_bytes = node.at("memory_bytes").count();
  cell.nonzeros = node.at("nonzeros").count();
  cell.expected = node.at("expected").boolean();
  return cell;
}

Published read_published(const Node &node) {
  Published entry;
  entry.source = node.at("source").text();
  entry.entry = node.at("entry").text();
  entry.benchmark = node.at("benchmark").text();
  entry.scene = node.text_or_empty("scene");
  entry.variant = node.text_or_empty("variant");
  entry.method = node.at("method").text();
  entry.level = node.at("level").text();
  entry.quantity = node.at("quantity").text();
  entry.kind = word(node.at("kind"), kind_from_text, "value, claim");
  entry.statement = node.text_or_empty("statement");
  entry.published = node.at("published").optional_number();
  entry.computed = node.at("computed").optional_number();
  entry.tolerance = node.at("tolerance").optional_number();
  entry.verdict =
      word(node.at("verdict"), verdict_from_text, "reproduced, differs, not reproducible, holds, does not hold");
  entry.expected = node.at("expected").boolean();
  entry.finding = node.text_or_empty("finding");
  entry.remark = node.at("remark").text();
  return entry;
}

Program read_program(const Node &node) {
  Program program;
  program.name = node.at("name").text();
  program.version = node.at("version").text();
  program.commit = node.at("commit").text();
  program.build_type = node.at("build_type").text();
  program.flags = node.at("flags").text();
  return program;
}

Machine read_machine(const Node &node) {
  Machine machine;
  machine.cpu = node.at("cpu").text();
  machine.cores = node.at("cores").small_count();
  machine.memory_bytes = node.at("memory").count();
  machine.load = node.at("load").number_or_nan();
  if (node.has("load_at_end"))
    machine.load_at_end = node.at("load_at_end").optional_number();
  if (node.has("competing_cores"))
    machine.competing_cores = node.at("competing_cores").optional_number();
  machine.blas = node.at("blas").text();
  machine.threads = node.at("threads").small_count();
  machine.simd_lanes = node.at("simd_lanes").small_count();
  for (const auto &[name, version] : node.at("libraries").members())
    machine.libraries[name] = version.text();
  return machine;
}

} // namespace

Results from_json(const Json &json) {
  const Node root(json, "$");
  const std::int64_t schema = root.at("schema").count();
  if (schema != results_schema)
    root.at("schema").fail(fmt::format("found schema {}, this program reads schema {}", schema, results_schema));
  Results results;
  results.program = read_program(root.at("program"));
  results.machine = read_machine(root.at("machine"));
  if (root.has("not_comparable"))
    results.not_comparable = root.at("not_comparable").texts();
  results.interrupted = root.has("interrupted") && root.at("interrupted").boolean();
  results.scene = root.at("scene").json();
  if (!results.scene.is_structured())
    root.at("scene").fail("expected an object or an array of objects");
  results.effects_active = root.at("effects").at("active").texts();
  results.effects_absent = root.at("effects").at("absent").texts();
  for (const Node &cell : root.at("cells").items())
    results.cells.push_back(read_cell(cell));
  for (const Node &entry : root.at("published").items())
    results.published.push_back(read_published(entry));
  for (const Node &entry : root.at("equal_error").items())
    results.equal_error.push_back({entry.text_or_empty("benchmark"), entry.text_or_empty("scene"),
                                   entry.text_or_empty("variant"), entry.at("error").text(),
                                   entry.at("target").number_or_nan(), entry.at("method").text(),
                                   entry.at("seconds").optional_number(), entry.text_or_empty("reason")});
  return results;
}

Results parse_results(std::string_view text) {
  if (!JsonDepth::is_bounded(text, nlohmann::json::input_format_t::json))
    throw ResultsError("", fmt::format("this is no results file: more than {} levels of brackets", largest_json_depth));
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception &failure) {
    // The library's message gives line and column; its prefix "[json.exception...]" means nothing to a user.
    std::string what = failure.what();
    if (const auto end = what.find("] "); end != std::string::npos)
      what = what.substr(end + 2);
    throw ResultsError("", "this is no complete JSON text: " + what);
  }
  return from_json(json);
}

Results read_results(const std::filesystem::path &file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  if (!stream || !(text << stream.rdbuf()))
    throw ResultsError("", fmt::format("{}: the file cannot be read", file.string()));
  try {
    return parse_results(text.str());
  } catch (const ResultsError &failure) {
    throw ResultsError("", fmt::format("{}: {}", file.string(), failure.what()));
  }
}

} // namespace comparisons::reports
