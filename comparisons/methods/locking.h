#pragma once

#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/vocabulary.h"

#include <string>

namespace comparisons::methods {

/// Whether displacement methods are known to lock: plane strain with nu above .49.
bool locks(const problems::Material &material);

/// Warns of a scene's [material] that locks; nu = 1/2 is an error of its own.
void check_locking(const scene::CheckContext &context, scene::Diagnostics &diagnostics);

/// The warning for the results of a cell.
std::string locking_warning(const problems::Material &material);

} // namespace comparisons::methods
