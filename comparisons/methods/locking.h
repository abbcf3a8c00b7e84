#pragma once

#include "comparisons/problems/plane_problem.h"

#include <string>

namespace comparisons::methods {

/// Whether displacement methods are known to lock: plane strain with nu above .49.
bool locks(const problems::Material &material);

/// The warning for the results of a cell.
std::string locking_warning(const problems::Material &material);

} // namespace comparisons::methods
