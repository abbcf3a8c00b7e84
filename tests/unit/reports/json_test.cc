#include "comparisons/reports/json.h"

#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>

using namespace comparisons::reports;
using Json = nlohmann::ordered_json;

namespace {

std::string complaint(const Json &json) {
  try {
    from_json(json);
  } catch (const ResultsError &error) {
    return error.what();
  }
  return "no complaint";
}

std::string text_complaint(std::string_view text) {
  try {
    parse_results(text);
  } catch (const ResultsError &error) {
    return error.what();
  }
  return "no complaint";
}

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

/// The part of JSON Schema that results.schema.json uses; returns the faults.
class Schema {
public:
  explicit Schema(Json root) : root_(std::move(root)) {}

  std::vector<std::string> faults(const Json &value) const {
    std::vector<std::string> all;
    check(root_, value, "$", all);
    return all;
  }
  const Json &resolve(const Json &schema) const {
    if (!schema.contains("$ref"))
      return schema;
    return root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
  }
  const Json &root() const { return root_; }

private:
  static bool has_type(const Json &value, const std::string &type) {
    if (type == "integer")
      return value.is_number_integer();
    if (type == "number")
      return value.is_number();
    if (type == "null")
      return value.is_null();
    return type == value.type_name();
  }

  void check(const Json &given, const Json &value, const std::string &path, std::vector<std::string> &all) const {
    const Json &schema = resolve(given);
    if (schema.contains("const") && value != schema["const"])
      all.push_back(path + ": const");
    if (schema.contains("enum") &&
        std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
      all.push_back(path + ": enum");
    if (schema.contains("type")) {
      const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
      if (std::none_of(types.begin(), types.end(), [&](const Json &type) { return has_type(value, type); }))
        all.push_back(path + ": type");
    }
    if (schema.contains("minimum") && value.is_number() && value < schema["minimum"])
      all.push_back(path + ": minimum");
    for (const Json &key : schema.value("required", Json::array()))
      if (!value.contains(key.get<std::string>()))
        all.push_back(path + ": required " + key.get<std::string>());
    if (value.is_array() && schema.contains("items"))
      for (std::size_t i = 0; i < value.size(); ++i)
        check(schema["items"], value[i], path + "[" + std::to_string(i) + "]", all);
    if (value.is_object())
      check_members(schema, value, path, all);
  }

  void check_members(const Json &schema, const Json &value, const std::string &path,
                     std::vector<std::string> &all) const {
    const bool is_listed = schema.contains("properties");
    for (const auto &[key, member] : value.items()) {
      if (is_listed && schema["properties"].contains(key))
        check(schema["properties"][key], member, path + "." + key, all);
      else if (schema.contains("additionalProperties"))
        check(schema["additionalProperties"], member, path + "." + key, all);
      else if (is_listed)
        all.push_back(path + ": the schema does not know " + key);
    }
  }

  Json root_;
};

Schema schema() {
  std::ifstream file(PETROV_SOURCE_DIR "/comparisons/reports/results.schema.json");
  return Schema(Json::parse(file));
}

/// Every path of the schema that names a property.
void property_paths(const Schema &schema, const Json &given, const std::string &path, std::set<std::string> &paths) {
  const Json &here = schema.resolve(given);
  if (here.contains("items"))
    property_paths(schema, here["items"], path + "[]", paths);
  const Json properties = here.value("properties", Json::object());
  for (const auto &[key, member] : properties.items()) {
    paths.insert(path + "." + key);
    property_paths(schema, member, path + "." + key, paths);
  }
}

void value_paths(const Json &value, const std::string &path, std::set<std::string> &paths) {
  if (value.is_array())
    for (const Json &item : value)
      value_paths(item, path + "[]", paths);
  if (value.is_object())
    for (const auto &[key, member] : value.items()) {
      paths.insert(path + "." + key);
      value_paths(member, path + "." + key, paths);
    }
}

} // namespace

TEST(ResultsJson, RoundTripGivesTheSameBytes) {
  const std::string text = json_text(reports_sample::results());
  EXPECT_EQ(json_text(parse_results(text)), text);
}

TEST(ResultsJson, RoundTripKeepsEveryDigit) {
  Results results = reports_sample::results();
  results.cells[0].errors["displacement_l2_relative"] = 0.1 + 0.2;
  const Results back = parse_results(json_text(results));
  EXPECT_EQ(back.cells[0].errors.at("displacement_l2_relative"), 0.1 + 0.2);
  EXPECT_EQ(back.machine.memory_bytes, results.machine.memory_bytes);
  EXPECT_EQ(back.cells[7].series.at(0).file, "u2_bottom.csv");
  EXPECT_EQ(back.cells[7].series.at(0).time, 2e-6);
  EXPECT_EQ(back.published[3].statement, results.published[3].statement);
}

TEST(ResultsJson, NothingMeaninglessIsANumber) {
  const Json json = to_json(reports_sample::results());
  for (const Json &cell : json["cells"]) {
    if (cell["status"] == "ok")
      continue;
    for (const auto *key : {"errors", "quantities"})
      for (const Json &value : cell[key])
        EXPECT_TRUE(value.is_null());
  }
  EXPECT_TRUE(json["cells"][8]["errors"]["stress_l2_relative"].is_null());
  EXPECT_TRUE(json["cells"][8]["quantities"]["tip_deflection"].is_null());
  EXPECT_TRUE(json["equal_error"][1]["seconds"].is_null());
}

TEST(ResultsJson, SpreadIsRangeOverMedianOfTheTotal) {
  const Json json = to_json(reports_sample::results());
  // The sample's extremes are 0.9 and 1.25 of the median; rounding only.
  EXPECT_NEAR(json["cells"][0]["seconds"]["spread"].get<double>(), 0.35, 1e-14);
  EXPECT_EQ(json["cells"][0]["seconds"]["repeats"], 5);
}

TEST(ResultsJson, SchemaFileAcceptsWhatIsWrittenAndKnowsEveryKey) {
  EXPECT_EQ(schema().faults(to_json(reports_sample::results())), std::vector<std::string>());
  EXPECT_EQ(schema().faults(to_json(Results())), std::vector<std::string>());
}

TEST(ResultsJson, EveryKeyOfTheSchemaFileIsWritten) {
  std::set<std::string> declared, written;
  const Schema file = schema();
  property_paths(file, file.root(), "$", declared);
  value_paths(to_json(reports_sample::results()), "$", written);
  for (const std::string &path : declared)
    EXPECT_TRUE(written.contains(path)) << path;
}

TEST(ResultsJson, EveryRequiredKeyIsMissedByName) {
  const Json good = to_json(reports_sample::results());
  const Schema file = schema();
  const auto expect_missed = [&](const std::string &place, const Json &required) {
    for (const Json &key : required) {
      Json bad = good;
      bad.at(Json::json_pointer(place)).erase(key.get<std::string>());
      EXPECT_TRUE(contains(complaint(bad), "'" + key.get<std::string>() + "' is missing")) << complaint(bad);
    }
  };
  expect_missed("", file.root()["required"]);
  expect_missed("/program", file.root()["properties"]["program"]["required"]);
  expect_missed("/machine", file.root()["properties"]["machine"]["required"]);
  expect_missed("/effects", file.root()["properties"]["effects"]["required"]);
  expect_missed("/cells/2", file.root()["$defs"]["cell"]["required"]);
  expect_missed("/published/0", file.root()["$defs"]["published"]["required"]);
  expect_missed("/equal_error/0", file.root()["$defs"]["equal_error"]["required"]);
}

TEST(ResultsJson, ComplaintsNameThePlace) {
  const Json good = to_json(reports_sample::results());
  const auto with = [&](const char *pointer, const Json &value) {
    Json bad = good;
    bad[Json::json_pointer(pointer)] = value;
    return complaint(bad);
  };
  EXPECT_TRUE(contains(with("/schema", 2), "$.schema: found schema 2, this program reads schema 1"));
  EXPECT_TRUE(
      contains(with("/cells/1/status", "fine"), "$.cells[1].status: found 'fine', expected one of ok, refused"));
  EXPECT_TRUE(contains(with("/cells/1/n_points", 6.5), "$.cells[1].n_points: found number (6.5)"));
  EXPECT_TRUE(contains(with("/cells/1/n_points", -1), "$.cells[1].n_points: found -1, expected 0 or more"));
  EXPECT_TRUE(contains(with("/cells/0/errors/displacement_log10_E", "-2"), "$.cells[0].errors.displacement_log10_E"));
  EXPECT_TRUE(contains(with("/cells/0/seconds/total", true), "$.cells[0].seconds.total: found boolean (true)"));
  EXPECT_TRUE(contains(with("/cells", Json::object()), "$.cells: found object"));
  EXPECT_TRUE(contains(with("/cells/0", 3), "$.cells[0]: found number (3), expected an object"));
  EXPECT_TRUE(contains(with("/published/0/verdict", "maybe"), "$.published[0].verdict"));
  EXPECT_TRUE(contains(with("/machine/libraries/Eigen", 3), "$.machine.libraries.Eigen"));
  EXPECT_TRUE(contains(with("/scene", "x"), "$.scene"));
  // Reports are written beside these files: a results file must not choose a place elsewhere.
  for (const char *file : {"/etc/passwd", "../up.csv", "series/../../up.csv", ""})
    EXPECT_TRUE(contains(with("/cells/7/series/0/file", file), "$.cells[7].series[0].file: found")) << file;
  EXPECT_TRUE(contains(complaint(Json::array()), "$: found array"));
}

TEST(ResultsJson, TextThatIsNoJsonIsRefused) {
  const std::string text = json_text(reports_sample::results());
  for (const std::size_t length : {std::size_t(0), std::size_t(1), text.size() / 2, text.size() - 3})
    EXPECT_TRUE(contains(text_complaint(text.substr(0, length)), "no complete JSON text")) << length;
  EXPECT_TRUE(contains(text_complaint("{\"schema\": NaN}"), "no complete JSON text"));
  EXPECT_TRUE(contains(text_complaint("{\"schema\": 1e999}"), "no complete JSON text"));
}

TEST(ResultsJson, UnknownKeysAreIgnored) {
  Json json = to_json(reports_sample::results());
  json["later"] = 1;
  json["cells"][0]["later"] = {1, 2};
  EXPECT_EQ(complaint(json), "no complaint");
}

TEST(ResultsJson, ReadingAMissingFileNamesIt) {
  try {
    read_results("/nonexistent/results.json");
    FAIL();
  } catch (const ResultsError &error) {
    EXPECT_TRUE(contains(error.what(), "/nonexistent/results.json"));
  }
}

TEST(Results, WordsAndTheirInverse) {
  for (const Status status : {Status::ok, Status::refused, Status::failed, Status::limit})
    EXPECT_EQ(status_from_text(to_text(status)), status);
  for (const Verdict verdict :
       {Verdict::reproduced, Verdict::differs, Verdict::not_reproducible, Verdict::holds, Verdict::does_not_hold})
    EXPECT_EQ(verdict_from_text(to_text(verdict)), verdict);
  for (const Kind kind : {Kind::value, Kind::claim})
    EXPECT_EQ(kind_from_text(to_text(kind)), kind);
  EXPECT_EQ(status_from_text("OK"), std::nullopt);
}

TEST(Results, SpacingOfALevel) {
  Cell cell;
  cell.n_points = 400;
  const auto spacing = [&](const char *level) {
    cell.level = level;
    return relative_spacing(cell).value();
  };
  EXPECT_EQ(spacing("16x4"), 1.0 / 15);
  EXPECT_EQ(spacing("0.005 m"), 0.005);
  EXPECT_EQ(spacing("400"), 0.05);
  EXPECT_EQ(spacing("1x4"), 0.05);
  cell.n_points = 0;
  EXPECT_EQ(relative_spacing(cell), std::nullopt);
}

// The library's writer, which a complaint quotes from, calls itself for every bracket.
TEST(ResultsJson, AMillionBracketsAreRefused) {
  const std::string text = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  EXPECT_NE(text_complaint(text).find("levels of brackets"), std::string::npos);
}
