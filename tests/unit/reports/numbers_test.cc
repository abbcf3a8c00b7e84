// Every number that text, Markdown, LaTeX, CSV and the page print is the JSON's, rounded to the printed digits.

#include "comparisons/reports/answers.h"
#include "comparisons/reports/answers_section.h"
#include "comparisons/reports/groups.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/numbers.h"
#include "comparisons/reports/page/page.h"
#include "comparisons/reports/reports.h"
#include "comparisons/reports/theory.h"
#include "unit/reports/parsed_tables.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <sstream>
#include <zlib.h>

using namespace comparisons::reports;
using namespace reports_sample;
using Json = nlohmann::ordered_json;

namespace {

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
      {"neighbours fewest", "/quantities/cloud_fewest_neighbours"},
      {"median", "/quantities/cloud_median_neighbours"},
      {"most", "/quantities/cloud_most_neighbours"},
      {"least distance / h", "/quantities/cloud_smallest_distance"},
      {"least pivot ratio", "/quantities/cloud_pivot_ratio"},
      {"at x m", "/quantities/cloud_worst_x"},
      {"at y m", "/quantities/cloud_worst_y"},
      {"total s", "/seconds/total"},
      {"total minimum", "/seconds/minimum/total"},
      {"total maximum", "/seconds/maximum/total"},
      {"neigh- bours", "/seconds/neighbours"},
      {"runs", "/seconds/repeats"},
      {"iter- ations", "/quantities/solver_iterations"},
      {"iterations", "/quantities/solver_iterations"},
      {"solver iterations", "/quantities/solver_iterations"},
      {"backward error", "/quantities/backward_error"},
      {"algebraic error", "/quantities/algebraic_error"}};
  if (header == "spread %")
    return scaled(cell["seconds"]["spread"], 100);
  for (const char *words : {"method", "level", "status", "linear solver", "ordering", "preconditioner"})
    if (header == words)
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

/// "cantilever / convergence: displacement l2 relative".
std::string equal_error_title(const Json &entry) {
  std::string title = entry["benchmark"].get<std::string>() + " / " + entry["scene"].get<std::string>();
  if (entry["variant"] != "")
    title += ", " + entry["variant"].get<std::string>();
  return title + ": " + words_of(entry["error"]);
}

void check_equal_error(Comparison &comparison, const Json &json, const ParsedTable &table) {
  std::size_t n = 0;
  for (const Json &entry : json["equal_error"]) {
    if (equal_error_title(entry) != table.title)
      continue;
    const std::string column = "s for " + target_text(entry["target"], entry["error"].get<std::string>());
    const auto j = std::find(table.header.begin(), table.header.end(), column) - table.header.begin();
    const auto row = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const auto &fields) { return fields[0] == entry["method"]; });
    ASSERT_NE(row, table.rows.end()) << entry;
    ASSERT_LT(static_cast<std::size_t>(j), table.header.size()) << column;
    comparison.expect_printed((*row)[static_cast<std::size_t>(j)], entry["seconds"], table.title + ", " + column);
    ++n;
  }
  EXPECT_EQ(n, table.rows.size() * (table.header.size() - 1)) << table.title;
}

/// The front's own numbers, and those made of them.
void check_pareto(Comparison &comparison, const Json &json, const ParsedTable &table) {
  for (const auto &row : table.rows) {
    const Json *cell = find_cell(json, table.title, row[1], row[2]);
    ASSERT_NE(cell, nullptr) << table.title << ", " << row[1];
    std::string name = row[0];
    std::replace(name.begin(), name.end(), ' ', '_');
    const double error = cell->at("errors").at(name), seconds = cell->at("seconds").at("total");
    comparison.expect_printed(row[3], error, row[0]);
    comparison.expect_printed(row[4], seconds, "seconds");
    comparison.expect_printed(row[5], 1 / (error * seconds), "efficiency");
    comparison.expect_printed(row[6], 1e6 / (error * cell->at("memory_bytes").get<double>()), "per MB");
  }
}

void check_rates(Comparison &comparison, const Results &results, const ParsedTable &table) {
  for (const auto &row : table.rows)
    for (const Group &group : group_cells(results)) {
      if (group.title() != table.title)
        continue;
      std::string name = row[0];
      std::replace(name.begin(), name.end(), ' ', '_');
      for (const MethodSeries &series : series_of(group)) {
        if (series.label != row[1])
          continue;
        std::istringstream printed(row[2]);
        std::string word;
        for (const Cell *cell : series.cells)
          if (const auto observed = observed_rate(group, *cell, name)) {
            printed >> word;
            comparison.expect_printed(word, *observed, row[1]);
          }
      }
    }
}

/// A column a method, a row a fact; rows of facts that the sample does not have hold dashes.
void check_facts(Comparison &comparison, const Json &json, const ParsedTable &table) {
  const std::map<std::string, std::string> quantities{{"nonzeros a row", "fact_nonzeros_per_row"},
                                                      {"symmetry defect", "fact_symmetry_defect"},
                                                      {"jump between neighbours over size", "fact_stress_jump"}};
  ASSERT_EQ(table.header.size(), 7u) << table.title;
  std::size_t n_found = 0, n_rows_of_the_paper = 0;
  for (const auto &row : table.rows) {
    n_rows_of_the_paper += !row[0].empty() && !row[3].empty() ? 1 : 0;
    const auto found = quantities.find(row[3]);
    n_found += found != quantities.end() ? 1 : 0;
    for (std::size_t j = 4; j < row.size(); ++j) {
      const Json *cell = find_cell(json, table.title, table.header[j], "16x4");
      ASSERT_NE(cell, nullptr) << table.title << ", " << table.header[j];
      const Json value = found != quantities.end() ? cell->at("quantities").at(found->second) : Json();
      comparison.expect_printed(row[j], value, table.title + ", " + row[3]);
    }
  }
  EXPECT_EQ(n_found, quantities.size());
  EXPECT_GE(n_rows_of_the_paper, 14u);
}

void check(const std::vector<ParsedTable> &tables, const std::map<std::string, int> &fewer = {}) {
  const Results results = reports_sample::results();
  const Json json = to_json(results);
  Comparison comparison;
  std::map<std::string, int> seen;
  for (const ParsedTable &table : tables) {
    ++seen[table.section];
    if (table.section == "Seconds for equal errors")
      check_equal_error(comparison, json, table);
    else if (table.section.starts_with("Not beaten"))
      check_pareto(comparison, json, table);
    else if (table.section == "Orders of convergence")
      check_rates(comparison, results, table);
    else if (table.section == "Comparison" || table.section == "Seconds by phase" ||
             table.section == "Particles and bases" || table.section == "Linear solvers used" ||
             table.section == "Further errors and quantities")
      check_cell_table(comparison, json, results, table);
    else if (table.section.starts_with("SSPH and finite elements"))
      check_facts(comparison, json, table);
    else if (table.section == "Published numbers and claims" && table.header[1] != "claim")
      check_ledger_table(comparison, json, table);
  }
  std::map<std::string, int> expected{{"Comparison", 3},
                                      {"Published numbers and claims", 2},
                                      {"Seconds for equal errors", 2},
                                      {"Not beaten in seconds and error (Pareto front)", 2},
                                      {"Orders of convergence", 1},
                                      {"Linear solvers used", 3},
                                      {"SSPH and finite elements, measured (Zhang & Batra 2008, Table 7)", 1},
                                      {"Scenes", 1},
                                      {"Summary", 1},
                                      {"Seconds by phase", 3},
                                      {"Particles and bases", 3},
                                      {"Further errors and quantities", 3}};
  for (const auto &[section, n] : fewer)
    expected[section] = n;
  std::erase_if(expected, [](const auto &entry) { return entry.second == 0; });
  EXPECT_EQ(seen, expected);
  EXPECT_GT(comparison.n_compared(), 150u);
}

/// Base64 and zlib, as the page holds its data.
std::string unpacked(const std::string &text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : text) {
    if (c == '=')
      break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    n_bits += 6;
    if (n_bits >= 8)
      bytes += static_cast<char>(bits >> (n_bits -= 8) & 0xff);
  }
  std::string whole(1000000, '\0');
  uLongf size = whole.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef *>(whole.data()), &size, reinterpret_cast<const Bytef *>(bytes.data()),
                       bytes.size()),
            Z_OK);
  whole.resize(size);
  return whole;
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

TEST(ReportNumbers, LatexShowsTheJson) { check(parse_latex(latex_report(reports_sample::results()))); }

/// The page leaves further quantities, and the phases of all but the main scene, to its data and the explorer.
TEST(ReportNumbers, ThePageShowsTheJson) {
  check(parse_html(html_page(reports_sample::results(), {})),
        {{"Further errors and quantities", 0}, {"Seconds by phase", 1}});
}

TEST(ReportNumbers, ThePageHoldsTheJson) {
  const std::string page = html_page(reports_sample::results(), {});
  const std::string tag = "<script type='text/plain' id='results'>";
  const auto begin = page.find(tag) + tag.size();
  EXPECT_EQ(Json::parse(unpacked(page.substr(begin, page.find("</script>", begin) - begin))),
            to_json(reports_sample::results()));
}

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
