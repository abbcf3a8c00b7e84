#include "comparisons/reports/json.h"

#include <cmath>

namespace comparisons::reports {

namespace {

using Json = nlohmann::ordered_json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number_or_null(const std::optional<double> &value) { return value ? number_or_null(*value) : Json(nullptr); }

Json numbers(const Cell &cell, const std::map<std::string, double> &map) {
  Json json = Json::object();
  for (const auto &[name, value] : map)
    json[name] = number_or_null(reportable(cell, map, name));
  return json;
}

Json seconds(const Cell &cell) {
  Json json = Json::object();
  Json minimum = Json::object();
  Json maximum = Json::object();
  for (const char *phase : phases) {
    const auto found = cell.seconds.find(phase);
    if (found == cell.seconds.end())
      continue;
    json[phase] = number_or_null(found->second.median);
    minimum[phase] = number_or_null(found->second.minimum);
    maximum[phase] = number_or_null(found->second.maximum);
  }
  json["repeats"] = cell.repeats;
  json["spread"] = number_or_null(relative_spread(cell));
  json["minimum"] = std::move(minimum);
  json["maximum"] = std::move(maximum);
  return json;
}

Json cell_json(const Cell &cell) {
  Json json = Json::object();
  json["benchmark"] = cell.benchmark;
  json["scene"] = cell.scene;
  json["variant"] = cell.variant;
  json["method"] = cell.method;
  json["label"] = cell.label;
  json["level"] = cell.level;
  json["dimension"] = cell.dimension;
  json["n_points"] = cell.n_points;
  json["n_dofs"] = cell.n_dofs;
  json["parameters"] = cell.parameters;
  json["status"] = to_text(cell.status);
  json["reason"] = cell.reason;
  json["warnings"] = cell.warnings;
  json["errors"] = numbers(cell, cell.errors);
  json["quantities"] = numbers(cell, cell.quantities);
  if (!cell.linear_solver.empty())
    json["linear_solver"] = cell.linear_solver;
  json["seconds"] = seconds(cell);
  json["series"] = Json::array();
  for (const Series &series : cell.series) {
    json["series"].push_back({{"name", series.name}, {"file", series.file}});
    if (series.time)
      json["series"].back()["time"] = *series.time;
  }
  json["steps"] = cell.steps;
  json["memory_bytes"] = cell.memory_bytes;
  json["nonzeros"] = cell.nonzeros;
  json["expected"] = cell.expected;
  return json;
}

Json published_json(const Published &entry) {
  Json json = Json::object();
  json["source"] = entry.source;
  json["entry"] = entry.entry;
  json["benchmark"] = entry.benchmark;
  json["scene"] = entry.scene;
  json["variant"] = entry.variant;
  json["method"] = entry.method;
  json["level"] = entry.level;
  json["quantity"] = entry.quantity;
  json["kind"] = to_text(entry.kind);
  json["statement"] = entry.statement;
  json["published"] = number_or_null(entry.published);
  json["computed"] = number_or_null(entry.computed);
  json["tolerance"] = number_or_null(entry.tolerance);
  json["verdict"] = to_text(entry.verdict);
  json["expected"] = entry.expected;
  json["finding"] = entry.finding;
  json["remark"] = entry.remark;
  return json;
}

Json program_json(const Program &program) {
  return {{"name", program.name},
          {"version", program.version},
          {"commit", program.commit},
          {"build_type", program.build_type},
          {"flags", program.flags}};
}

Json machine_json(const Machine &machine) {
  return {{"cpu", machine.cpu},
          {"cores", machine.cores},
          {"memory", machine.memory_bytes},
          {"load", number_or_null(machine.load)},
          {"load_at_end", number_or_null(machine.load_at_end)},
          {"competing_cores", number_or_null(machine.competing_cores)},
          {"blas", machine.blas},
          {"threads", machine.threads},
          {"simd_lanes", machine.simd_lanes},
          {"libraries", machine.libraries}};
}

} // namespace

ResultsError::ResultsError(std::string path, const std::string &message)
    : std::runtime_error(path.empty() ? message : path + ": " + message), path_(std::move(path)) {}

Json to_json(const Results &results) {
  Json json = Json::object();
  json["schema"] = results_schema;
  json["program"] = program_json(results.program);
  json["machine"] = machine_json(results.machine);
  json["not_comparable"] = results.not_comparable;
  json["interrupted"] = results.interrupted;
  json["scene"] = results.scene.is_null() ? Json::object() : results.scene;
  json["effects"] = {{"active", results.effects_active}, {"absent", results.effects_absent}};
  json["cells"] = Json::array();
  for (const Cell &cell : results.cells)
    json["cells"].push_back(cell_json(cell));
  json["published"] = Json::array();
  for (const Published &entry : results.published)
    json["published"].push_back(published_json(entry));
  json["equal_error"] = Json::array();
  for (const EqualError &entry : results.equal_error)
    json["equal_error"].push_back({{"benchmark", entry.benchmark},
                                   {"scene", entry.scene},
                                   {"variant", entry.variant},
                                   {"error", entry.error},
                                   {"target", number_or_null(entry.target)},
                                   {"method", entry.method},
                                   {"seconds", number_or_null(entry.seconds)},
                                   {"reason", entry.reason}});
  return json;
}

std::string json_text(const Results &results) {
  return to_json(results).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace comparisons::reports
