#include "comparisons/reports/recoveries_section.h"

#include "comparisons/reports/numbers.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::reports {

namespace {

struct Recovery {
  const char *quantity;
  const char *counted;
  const char *rule;
};

constexpr Recovery recoveries[] = {
    {"n_orders_lowered", "orders lowered",
     "if asked for (lower_order = \"on\"), particles that do not carry the order are solved with the highest lower one "
     "that they carry, and with all that follows from it"},
    {"n_enlarged", "particles enlarged",
     "where a moment matrix would be singular or poor, the smoothing lengths around it are enlarged by 5 % at a time, "
     "to twice at most (key enlarge; auto: on irregular particles)"},
    {"n_pivoted", "moment matrices pivoted",
     "a moment matrix that is not positive definite, as the kernel is negative in places, is factorised with complete "
     "pivoting"},
    {"n_direct_instead", "systems by sparse LU instead",
     "an iteration for the linear system that does not reach its backward error is replaced by sparse LU"},
    {"n_restarts", "iterations started anew",
     "an iteration whose solution misses the wanted backward error starts anew from the true residual, as long as that "
     "falls tenfold"},
    {"n_coarse_left_out", "coarse systems left out",
     "a preconditioner whose coarse system is singular does without it"},
    {"n_shrunk_slopes", "slopes shrunk",
     "slopes of a cell of the discontinuous Galerkin method are halved until the states at its ends are a gas"},
};

/// Of a cell with a result; not counted otherwise.
double count_of(const Cell &cell, const Recovery &recovery) {
  return reportable(cell, cell.quantities, recovery.quantity).value_or(0);
}

bool occurs(const std::vector<Group> &groups, const Recovery &recovery) {
  return std::any_of(groups.begin(), groups.end(), [&](const Group &group) {
    return std::any_of(group.cells.begin(), group.cells.end(),
                       [&](const Cell *cell) { return count_of(*cell, recovery) > 0; });
  });
}

} // namespace

bool is_recovery(std::string_view quantity) {
  return std::any_of(std::begin(recoveries), std::end(recoveries),
                     [&](const Recovery &recovery) { return quantity == recovery.quantity; });
}

void append_recoveries(Document &document, const std::vector<Group> &groups) {
  Bullets rules;
  for (const Recovery &recovery : recoveries)
    if (occurs(groups, recovery))
      rules.items.push_back(fmt::format("{}: {}.", recovery.counted, recovery.rule));
  if (rules.items.empty())
    return;
  document.push_back(Heading{2, "Recoveries"});
  document.push_back(Paragraph{"What was done so that these cells have a solution, by rule; what is singular or not a "
                               "number all the same is refused."});
  document.push_back(std::move(rules));
  Table table({{"comparison", Align::left, true}, {"cell", Align::left, true}, {"what", Align::left, true}, {"count"}});
  for (const Group &group : groups)
    for (const Cell *cell : group.cells)
      for (const Recovery &recovery : recoveries)
        if (const double count = count_of(*cell, recovery); count > 0)
          table.add_row({group.title(), cell_name(*cell), recovery.counted, exact(count)});
  document.push_back(std::move(table));
}

} // namespace comparisons::reports
