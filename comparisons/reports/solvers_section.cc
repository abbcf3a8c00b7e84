#include "comparisons/reports/solvers_section.h"

#include "comparisons/reports/comparison_section.h"
#include "comparisons/reports/numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace comparisons::reports {

namespace {

constexpr double most_of_discretisation = 0.01;

/// Cells of one system: same scene, variant and level.
using System = std::vector<const Cell *>;

std::vector<System> systems_of(const Results &results, bool main_scene_alone) {
  std::vector<System> systems;
  for (const Cell &cell : results.cells) {
    if (!is_solver_case(cell) || (main_scene_alone && cell.scene != "scene"))
      continue;
    const auto found = std::find_if(systems.begin(), systems.end(), [&](const System &system) {
      const Cell &first = *system.front();
      return first.scene == cell.scene && first.variant == cell.variant && first.level == cell.level;
    });
    if (found == systems.end())
      systems.push_back({&cell});
    else
      found->push_back(&cell);
  }
  return systems;
}

std::string title_of(const Cell &cell) {
  return fmt::format("Linear solvers{}{}{}, {}", cell.scene == "scene" ? "" : ": " + cell.scene,
                     cell.variant.empty() ? "" : ", ", cell.variant, cell.level);
}

/// Of the linear solver; a file from elsewhere may not have it.
std::string name_of(const Cell &cell, const char *part) {
  const auto found = cell.linear_solver.find(part);
  return found != cell.linear_solver.end() ? found->second : no_number;
}

/// "bicgstab, rcm, thinned+coarse"
std::string linear_solver_text(const Cell &cell) {
  std::vector<std::string> names;
  for (const char *part : {"method", "ordering", "preconditioner"})
    if (cell.linear_solver.contains(part))
      names.push_back(name_of(cell, part));
  return names.empty() ? cell.label : fmt::format("{}", fmt::join(names, ", "));
}

std::string wanted_of(const Cell &cell) {
  const auto found = cell.parameters.find("backward_error");
  return found != cell.parameters.end() && found->is_number() ? fmt::format("{:.0e}", found->get<double>()) : no_number;
}

bool is_chosen(const Cell &cell) {
  const auto found = cell.parameters.find("chosen");
  return found != cell.parameters.end() && found->is_boolean() && found->get<bool>();
}

std::string count_or_none(std::optional<double> value) { return value ? fmt::format("{:.0f}", *value) : no_number; }

bool keeps_rule(const Cell &cell) {
  const auto part = reportable(cell, "algebraic_over_discretisation");
  return part && *part <= most_of_discretisation;
}

/// Several tolerances are told apart; one is not worth a column.
bool has_tolerances(const System &system) {
  std::string first;
  for (const Cell *cell : system)
    if (const std::string wanted = wanted_of(*cell); wanted != no_number) {
      if (!first.empty() && wanted != first)
        return true;
      first = wanted;
    }
  return false;
}

Table table_of(const System &system) {
  Table table({{"method", Align::left},
               {"ordering", Align::left},
               {"preconditioner", Align::left},
               {"ends at"},
               {"setup\ns"},
               {"solve\ns"},
               {"total\ns"},
               {"iter-\nations"},
               {"factors\nMB"},
               {"backward\nerror"},
               {"algebraic\nerror"},
               {"of discre-\ntisation"},
               {"status", Align::left}});
  const bool tolerances = has_tolerances(system);
  for (const Cell *cell : system) {
    const auto bytes = reportable(*cell, "factor_bytes");
    const bool breaks_rule = cell->status == Status::ok && !keeps_rule(*cell);
    table.add_row({name_of(*cell, "method") + (is_chosen(*cell) ? " *" : ""), name_of(*cell, "ordering"),
                   name_of(*cell, "preconditioner"), tolerances ? wanted_of(*cell) : no_number,
                   seconds(median_seconds(*cell, "setup")), seconds(median_seconds(*cell, "solve")),
                   seconds(median_seconds(*cell, "total")), count_or_none(reportable(*cell, "solver_iterations")),
                   bytes ? megabytes(static_cast<std::int64_t>(*bytes)) : no_number,
                   significant(reportable(*cell, "backward_error")), significant(reportable(*cell, "algebraic_error")),
                   significant(reportable(*cell, "algebraic_over_discretisation")),
                   breaks_rule ? "too loose" : status_text(*cell)});
  }
  table.drop_columns_without(no_number);
  return table;
}

Bullets findings_of(const System &system) {
  Bullets bullets;
  const Cell *fastest = nullptr;
  const Cell *chosen = nullptr;
  for (const Cell *cell : system) {
    if (is_chosen(*cell) && keeps_rule(*cell) && chosen == nullptr)
      chosen = cell;
    if (keeps_rule(*cell) && median_seconds(*cell, "total") &&
        (fastest == nullptr || *median_seconds(*cell, "total") < *median_seconds(*fastest, "total")))
      fastest = cell;
  }
  if (fastest != nullptr)
    bullets.items.push_back(fmt::format("{} unknowns, {} entries, discretisation error {}", fastest->n_dofs,
                                        fastest->nonzeros, scientific(reportable(*fastest, "discretisation_error"))));
  const auto told = [](const Cell &cell) {
    return fmt::format("{}: {} s", linear_solver_text(cell), seconds(median_seconds(cell, "total")));
  };
  if (chosen != nullptr)
    bullets.items.push_back("* what the methods take by themselves at this size: " + told(*chosen));
  if (fastest != nullptr)
    bullets.items.push_back("fastest of those that keep the rule: " + told(*fastest));
  for (const Cell *cell : system) {
    if (cell->status != Status::ok)
      bullets.items.push_back(fmt::format("{}: {}: {}", linear_solver_text(*cell), status_text(*cell), cell->reason));
  }
  std::map<std::string, std::vector<std::string>> warned; // who shares a warning
  for (const Cell *cell : system)
    for (const std::string &warning : cell->warnings)
      warned[warning].push_back(linear_solver_text(*cell));
  for (const auto &[warning, names] : warned)
    bullets.items.push_back(fmt::format("{}: {}", fmt::join(names, "; "), warning));
  return bullets;
}

void append(Document &document, const std::vector<System> &systems) {
  if (systems.empty())
    return;
  document.push_back(Heading{2, "Linear solvers"});
  document.push_back(Paragraph{
      "Alternatives for one and the same system of weak1, all by one rule: the algebraic error, of the coefficients "
      "against sparse LU refined in extended precision, is at most a hundredth of the discretisation error. Setup is "
      "ordering and factors, or coarse levels; an iteration ends at a backward error of 1e-15 if nothing else is "
      "said."});
  for (const System &system : systems) {
    document.push_back(Heading{3, title_of(*system.front())});
    document.push_back(table_of(system));
    document.push_back(findings_of(system));
  }
}

} // namespace

bool has_solver_cases(const Results &results) {
  return std::any_of(results.cells.begin(), results.cells.end(), is_solver_case);
}

void append_solvers(Document &document, const Results &results) { append(document, systems_of(results, false)); }

void append_used_solvers(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    Table table({{"method", Align::left, true},
                 {"level", Align::left},
                 {"linear\nsolver", Align::left},
                 {"ordering", Align::left},
                 {"preconditioner", Align::left},
                 {"iter-\nations"},
                 {"backward\nerror"},
                 {"algebraic\nerror"}});
    for (const Cell *cell : group.cells)
      if (cell->status == Status::ok && !cell->linear_solver.empty())
        table.add_row({cell->label, group.common_level().empty() ? cell->level : no_number, name_of(*cell, "method"),
                       name_of(*cell, "ordering"), name_of(*cell, "preconditioner"),
                       count_or_none(reportable(*cell, "solver_iterations")),
                       significant(reportable(*cell, "backward_error")),
                       significant(reportable(*cell, "algebraic_error"))});
    if (table.rows().empty())
      continue;
    table.drop_columns_without(no_number);
    if (!has_heading) {
      document.push_back(Heading{2, "Linear solvers used"});
      document.push_back(
          Paragraph{"The algebraic error is the solver's own estimate for the unknowns, relative, from what the last "
                    "tightening has "
                    "changed. A cell is warned of where it is more than a hundredth of the displacement's error."});
    }
    has_heading = true;
    document.push_back(Heading{3, group.title()});
    document.push_back(std::move(table));
  }
}

void append_solvers_in_brief(Document &document, const Results &results) {
  append(document, systems_of(results, true));
}

} // namespace comparisons::reports
