// Every number that text, Markdown and CSV print is the JSON's, rounded to the printed digits.

#include "comparisons/reports/groups.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/reports.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>

using namespace comparisons::reports;
using Json = nlohmann::ordered_json;

namespace {

struct ParsedTable {
  std::string section; ///< heading of level 2
  std::string title;   ///< heading of level 3
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

std::string trimmed(const std::string &text) {
  const auto begin = text.find_first_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') - begin + 1);
}

std::vector<std::string> lines_of(const std::string &text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

std::vector<std::string> markdown_fields(const std::string &line) {
  std::vector<std::string> fields(1);
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] == '\\' && i + 1 < line.size())
      fields.back() += line[++i];
    else if (line[i] == '|')
      fields.emplace_back();
    else
      fields.back() += line[i];
  fields.pop_back();
  for (std::string &field : fields)
    field = trimmed(field);
  return fields;
}

std::vector<ParsedTable> parse_markdown(const std::string &text) {
  std::vector<ParsedTable> tables;
  std::string section, title, previous;
  for (const std::string &line : lines_of(text)) {
    if (line.starts_with("## "))
      section = line.substr(3), title.clear();
    if (line.starts_with("### "))
      title = line.substr(4);
    if (line.starts_with("| ---"))
      tables.push_back({section, title, markdown_fields(previous), {}});
    else if (line.starts_with("|") && previous.starts_with("|"))
      tables.back().rows.push_back(markdown_fields(line));
    previous = line;
  }
  return tables;
}

/// Columns of a text table are where its rule has dashes.
std::vector<std::string> text_fields(const std::string &line, const std::string &rule) {
  std::vector<std::string> fields;
  for (std::size_t begin = 0; begin < rule.size();) {
    const std::size_t end = std::min(rule.find(' ', begin), rule.size());
    fields.push_back(begin < line.size() ? trimmed(line.substr(begin, end - begin)) : "");
    begin = std::min(rule.find('-', end), rule.size());
  }
  return fields;
}

bool is_rule(const std::string &line) {
  return line.find("--  --") != std::string::npos && line.find_first_not_of(" -") == std::string::npos;
}

/// A line without a number goes on with the words of the row above.
void append_row(ParsedTable &table, const std::vector<std::string> &fields) {
  const auto is_words = [](const std::string &field) {
    return field.empty() || field.find_first_of("0123456789-") == std::string::npos;
  };
  const std::size_t n_words = static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), is_words));
  if (table.rows.empty() || n_words < fields.size()) {
    table.rows.push_back(fields);
    return;
  }
  for (std::size_t j = 0; j < fields.size(); ++j)
    table.rows.back()[j] = trimmed(table.rows.back()[j] + " " + fields[j]);
}

std::vector<ParsedTable> parse_text(const std::string &text) {
  std::vector<ParsedTable> tables;
  const std::vector<std::string> lines = lines_of(text);
  std::string section, title;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (i + 1 < lines.size() && lines[i + 1].starts_with("--") && !is_rule(lines[i + 1]) && !lines[i].empty())
      section = lines[i], title.clear();
    if (!is_rule(lines[i]))
      continue;
    std::size_t top = i;
    while (top > 0 && !lines[top - 1].empty())
      --top;
    if (top >= 2 && !lines[top - 2].empty() && !lines[top - 2].starts_with("--"))
      title = lines[top - 2];
    ParsedTable table{section, title, std::vector<std::string>(text_fields("", lines[i]).size()), {}};
    for (std::size_t k = top; k < i; ++k) {
      const auto fields = text_fields(lines[k], lines[i]);
      for (std::size_t j = 0; j < fields.size(); ++j)
        table.header[j] = trimmed(table.header[j] + " " + fields[j]);
    }
    for (std::size_t k = i + 1; k < lines.size() && !lines[k].empty(); ++k)
      append_row(table, text_fields(lines[k], lines[i]));
    tables.push_back(std::move(table));
  }
  return tables;
}

/// Half a unit of the last digit that is printed, and the rounding of the comparison itself.
double half_unit(const std::string &printed) {
  const auto exponent_at = printed.find('e');
  const std::string mantissa = printed.substr(0, exponent_at);
  const auto point = mantissa.find('.');
  const double decimals = point == std::string::npos ? 0 : static_cast<double>(mantissa.size() - point - 1);
  const double exponent = exponent_at == std::string::npos ? 0 : std::atof(printed.c_str() + exponent_at + 1);
  return 0.5000001 * std::pow(10.0, exponent - decimals);
}

/// Compares and counts.
class Comparison {
public:
  void expect_printed(const std::string &printed, const Json &value, const std::string &where);
  std::size_t n_compared() const { return n_compared_; }

private:
  std::size_t n_compared_ = 0;
};

void Comparison::expect_printed(const std::string &printed, const Json &value, const std::string &where) {
  if (printed == no_number || printed.empty()) {
    EXPECT_TRUE(value.is_null()) << where << ": nothing printed, but the value is " << value;
    return;
  }
  char *end = nullptr;
  const double number = std::strtod(printed.c_str(), &end);
  ASSERT_EQ(*end, '\0') << where << ": '" << printed << "' is no number";
  ASSERT_TRUE(value.is_number()) << where << ": printed " << printed << ", but the value is " << value;
  EXPECT_LE(std::abs(number - value.get<double>()), half_unit(printed)) << where;
  ++n_compared_;
}

Json scaled(const Json &value, double factor) { return value.is_number() ? Json(value.get<double>() * factor) : value; }

/// What a column of the cells' tables must show; nothing for columns of words.
std::optional<Json> value_of(const Json &cell, const std::string &section, const std::string &header) {
  if (section == "Seconds by phase" && header == "points")
    return cell["seconds"]["points"];
  static const std::map<std::string, std::string> pointers{
      {"points", "/n_points"},
      {"dofs", "/n_dofs"},
      {"u L2 relative", "/errors/displacement_l2_relative"},
      {"log10 E", "/errors/displacement_log10_E"},
      {"u2 max relative", "/errors/u2_max_relative"},
      {"stress L2 relative", "/errors/stress_l2_relative"},
      {"displacement max relative", "/errors/displacement_max_relative"},
      {"tip deflection", "/quantities/tip_deflection"},
      {"total s", "/seconds/total"},
      {"total minimum", "/seconds/minimum/total"},
      {"total maximum", "/seconds/maximum/total"},
      {"repeats", "/seconds/repeats"}};
  if (header == "method" || header == "level" || header == "status")
    return std::nullopt;
  if (header == "memory MB")
    return cell["status"] == "ok" ? scaled(cell["memory_bytes"], 1e-6) : Json(nullptr);
  if (cell["status"] != "ok" && header == "total s")
    return Json(nullptr); // a time without a result compares with nothing
  if (const auto found = pointers.find(header); found != pointers.end())
    return cell.at(Json::json_pointer(found->second));
  EXPECT_TRUE(cell["seconds"].contains(header)) << "unknown column " << header;
  return cell["seconds"].value(header, Json());
}

/// "cantilever / order, jitter=0.25, 16x4": the heading names the level if all cells share it.
const Json *find_cell(const Json &json, const std::string &title, const std::string &label, const std::string &level) {
  for (const Json &cell : json["cells"]) {
    std::string name = cell["benchmark"].get<std::string>() + " / " + cell["scene"].get<std::string>();
    if (cell["variant"] != "")
      name += ", " + cell["variant"].get<std::string>();
    const bool in_title = title == name + ", " + cell["level"].get<std::string>();
    if (cell["label"] == label && (in_title || (title == name && cell["level"] == level)))
      return &cell;
  }
  return nullptr;
}

void check_cell_table(Comparison &comparison, const Json &json, const Results &results, const ParsedTable &table) {
  for (const auto &row : table.rows) {
    std::map<std::string, std::string> fields;
    for (std::size_t j = 0; j < row.size(); ++j)
      fields[table.header[j]] = row[j];
    const Json *cell = find_cell(json, table.title, fields["method"], fields["level"]);
    ASSERT_NE(cell, nullptr) << table.title << ": " << fields["method"] << " " << fields["level"];
    for (const auto &[header, printed] : fields) {
      const std::string where = table.section + ", " + table.title + ", " + fields["method"] + ", " + header;
      if (header == "rate") {
        for (const Group &group : group_cells(results))
          for (const Cell *other : group.cells)
            if (group.title() == table.title && other->label == fields["method"] && other->level == fields["level"]) {
              const auto rate = observed_rate(group, *other, "displacement_l2_relative");
              comparison.expect_printed(printed, rate ? Json(*rate) : Json(), where);
            }
      } else if (const auto value = value_of(*cell, table.section, header)) {
        comparison.expect_printed(printed, *value, where);
      }
    }
  }
}

void check_ledger_table(Comparison &comparison, const Json &json, const ParsedTable &table) {
  const auto column = [&](const char *name) {
    return static_cast<std::size_t>(std::find(table.header.begin(), table.header.end(), name) - table.header.begin());
  };
  std::vector<Json> values;
  for (const Json &entry : json["published"])
    if (entry["kind"] == "value")
      values.push_back(entry);
  std::size_t i = 0;
  for (const auto &row : table.rows) {
    if (row[column("published")].empty())
      continue; // the second line of a long entry
    ASSERT_LT(i, values.size());
    const Json &entry = values[i++];
    for (const char *name : {"published", "computed", "tolerance"})
      comparison.expect_printed(row[column(name)], entry[name], entry["entry"].get<std::string>() + ", " + name);
    comparison.expect_printed(row[column("difference")],
                              entry["computed"].get<double>() - entry["published"].get<double>(), "difference");
  }
  EXPECT_EQ(i, values.size());
}

void check_equal_error(Comparison &comparison, const Json &json, const ParsedTable &table) {
  ASSERT_EQ(table.rows.size(), json["equal_error"].size());
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    comparison.expect_printed(table.rows[i][1], json["equal_error"][i]["target"], "target");
    comparison.expect_printed(table.rows[i][3], json["equal_error"][i]["seconds"], "seconds");
  }
}

void check(const std::vector<ParsedTable> &tables) {
  const Results results = reports_sample::results();
  const Json json = to_json(results);
  Comparison comparison;
  std::map<std::string, int> seen;
  for (const ParsedTable &table : tables) {
    ++seen[table.section];
    if (table.section == "Seconds for equal errors")
      check_equal_error(comparison, json, table);
    else if (table.section != "Published numbers and claims")
      check_cell_table(comparison, json, results, table);
    else if (table.header[1] != "claim")
      check_ledger_table(comparison, json, table);
  }
  const std::map<std::string, int> expected{{"Comparison", 3},
                                            {"Published numbers and claims", 2},
                                            {"Seconds for equal errors", 1},
                                            {"Seconds by phase", 3},
                                            {"Further errors and quantities", 3}};
  EXPECT_EQ(seen, expected);
  EXPECT_GT(comparison.n_compared(), 150u);
}

/// RFC 4180.
std::vector<std::vector<std::string>> parse_csv(const std::string &text) {
  std::vector<std::vector<std::string>> rows(1, std::vector<std::string>(1));
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      rows.back().back() += text[++i];
    else if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      rows.back().emplace_back();
    else if (c == '\n' && !quoted)
      rows.emplace_back(1);
    else
      rows.back().back() += c;
  }
  rows.pop_back();
  return rows;
}

} // namespace

TEST(ReportNumbers, TextShowsTheJson) { check(parse_text(text_report(reports_sample::results()))); }

TEST(ReportNumbers, MarkdownShowsTheJson) { check(parse_markdown(markdown_report(reports_sample::results()))); }

TEST(ReportNumbers, CsvHoldsEveryNumberInFull) {
  const Json json = to_json(reports_sample::results());
  const auto rows = parse_csv(csv_report(reports_sample::results()));
  const std::map<std::string, std::string> places{{"error", "/errors/"},
                                                  {"quantity", "/quantities/"},
                                                  {"seconds", "/seconds/"},
                                                  {"seconds_minimum", "/seconds/minimum/"},
                                                  {"seconds_maximum", "/seconds/maximum/"}};
  std::size_t i = 1;
  for (const Json &cell : json["cells"]) {
    const bool ok = cell["status"] == "ok";
    // errors, quantities, three times the phases, and four sizes; or one empty row
    const std::size_t n = ok ? cell["errors"].size() + cell["quantities"].size() + 3 * phases.size() + 4 : 1;
    for (const std::size_t end = i + n; i < end; ++i) {
      ASSERT_LT(i, rows.size());
      const auto &row = rows[i];
      ASSERT_EQ(row.size(), rows[0].size());
      EXPECT_EQ(row[4], cell["label"]);
      EXPECT_EQ(row[5], cell["level"]);
      EXPECT_EQ(row[6], std::to_string(cell["n_points"].get<long>()));
      EXPECT_EQ(row[10], cell["reason"]);
      if (!ok) {
        EXPECT_EQ(row[13], "");
        continue;
      }
      const auto place = places.find(row[11]);
      Json value;
      if (place != places.end())
        value = cell.at(Json::json_pointer(place->second + row[12]));
      else
        value = row[12] == "repeats" ? cell["seconds"]["repeats"] : cell.at(row[12]);
      if (value.is_null())
        EXPECT_EQ(row[13], "");
      else
        EXPECT_EQ(std::atof(row[13].c_str()), value.get<double>()) << row[12];
    }
  }
  EXPECT_EQ(i, rows.size());
}

TEST(ReportNumbers, CsvOfTheLedgerHoldsEveryEntry) {
  const Json json = to_json(reports_sample::results());
  const auto rows = parse_csv(csv_published(reports_sample::results()));
  ASSERT_EQ(rows.size(), json["published"].size() + 1);
  for (std::size_t i = 1; i < rows.size(); ++i)
    for (std::size_t j = 0; j < rows[0].size(); ++j) {
      const Json &value = json["published"][i - 1].at(rows[0][j]);
      if (value.is_string())
        EXPECT_EQ(rows[i][j], value.get<std::string>());
      else if (value.is_number())
        EXPECT_EQ(std::atof(rows[i][j].c_str()), value.get<double>());
      else
        EXPECT_EQ(rows[i][j], value.is_null() ? "" : value.dump());
    }
}
