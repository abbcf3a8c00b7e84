#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/results.h"
#include "comparisons/reports/table.h"

#include <vector>

namespace comparisons::reports {

/// Cells of the benchmark of linear solvers. They solve one and the same system, so that they have a section of their
/// own and are in no other comparison.
inline bool is_solver_case(const Cell &cell) { return cell.benchmark == "solvers"; }

bool has_solver_cases(const Results &results);

/// A table for every system: alternative, seconds of setup and solve, iterations, bytes of factors, backward error,
/// algebraic error and what it is of the discretisation's; what is chosen, and what is fastest.
void append_solvers(Document &document, const Results &results);

/// Which linear solver, ordering and preconditioner the cells of other benchmarks have used, with iterations and
/// errors.
void append_used_solvers(Document &document, const std::vector<Group> &groups);

/// The tables of the main scene, for the terminal; nothing without such cells.
void append_solvers_in_brief(Document &document, const Results &results);

} // namespace comparisons::reports
