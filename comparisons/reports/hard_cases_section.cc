#include "comparisons/reports/hard_cases_section.h"

#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <vector>

namespace comparisons::reports {

namespace {

/// A text among the parameters; results files may come from elsewhere.
std::string text_of(const Cell &cell, const char *name) {
  const auto found = cell.parameters.find(name);
  return found != cell.parameters.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string threshold_of(const Cell &cell) {
  const auto found = cell.parameters.find("threshold");
  return found != cell.parameters.end() && found->is_number() ? fmt::format("{:g}", found->get<double>()) : no_number;
}

std::vector<const Cell *> hard_cells(const Results &results) {
  std::vector<const Cell *> cells;
  for (const Cell &cell : results.cells)
    if (is_hard_case(cell))
      cells.push_back(&cell);
  return cells;
}

std::string counts_line(const std::vector<const Cell *> &cells) {
  std::map<std::string, int> n;
  for (const Cell *cell : cells)
    ++n[text_of(*cell, "verdict")];
  return fmt::format("Hard cases: {} cells; {} hold, {} degrade, {} are refused by name, {} fail.", cells.size(),
                     n["holds"], n["degrades"], n["refused"], n["fails"]);
}

std::string note_of(const Cell &cell) {
  if (!cell.reason.empty())
    return cell.reason;
  return text_of(cell, "verdict") == "degrades" && !cell.warnings.empty() ? "warned: " + cell.warnings.front()
                                                                          : std::string();
}

/// What the errors of the cases are from. Tables can be sorted, so that this stands below.
Bullets references_of(const std::vector<const Cell *> &cells) {
  Bullets bullets;
  const Cell *before = nullptr;
  for (const Cell *cell : cells) {
    if (before == nullptr || before->variant != cell->variant)
      bullets.items.push_back(
          fmt::format("{}: {}; reference: {}", cell->variant, text_of(*cell, "meaning"), text_of(*cell, "reference")));
    before = cell;
  }
  return bullets;
}

Table family_table(const std::vector<const Cell *> &cells) {
  Table table({{"case", Align::left, true},
               {"method", Align::left},
               {"verdict", Align::left},
               {"error"},
               {"threshold"},
               {"value"},
               {"why", Align::left, true}});
  for (const Cell *cell : cells) {
    table.add_row({cell->variant, cell->label, text_of(*cell, "verdict"),
                   scientific(reportable(*cell, "error_of_case")), threshold_of(*cell),
                   significant(reportable(*cell, "value")), note_of(*cell)});
  }
  return table;
}

} // namespace

bool has_hard_cases(const Results &results) {
  return std::any_of(results.cells.begin(), results.cells.end(), is_hard_case);
}

void append_hard_cases_in_brief(Document &document, const Results &results) {
  if (const auto cells = hard_cells(results); !cells.empty())
    document.push_back(Paragraph{counts_line(cells) + " The matrix is in the files."});
}

void append_hard_cases(Document &document, const Results &results) {
  const auto cells = hard_cells(results);
  if (cells.empty())
    return;
  document.push_back(Heading{2, "Hard cases"});
  document.push_back(Paragraph{
      counts_line(cells) +
      " A method holds where its error is within the threshold of the case; it degrades above it, with a warning or an "
      "error of at most 10 %; it refuses by name what it cannot do; it fails by a crash, a hang, no number, or an "
      "error "
      "above 10 % without a warning. `petrov verify --list` says what the cases are and why their thresholds."});
  std::vector<std::string> families;
  for (const Cell *cell : cells)
    if (std::find(families.begin(), families.end(), cell->scene) == families.end())
      families.push_back(cell->scene);
  for (const std::string &family : families) {
    std::vector<const Cell *> own;
    std::copy_if(cells.begin(), cells.end(), std::back_inserter(own),
                 [&](const Cell *cell) { return cell->scene == family; });
    document.push_back(Heading{3, "Hard cases: " + family});
    document.push_back(family_table(own));
    document.push_back(references_of(own));
  }
}

} // namespace comparisons::reports
