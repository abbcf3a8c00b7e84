#pragma once

#include "comparisons/methods/method_table.h"

namespace comparisons::methods {

/// Collocation with the basis' second derivatives, Batra & Zhang 2008, section 3.1.
Method strong();
/// MLPG with directly found derivatives, section 3.2.1.
Method weak1();
/// MLPG with differentiated shape functions, section 3.2.2.
Method weak2();

/// The strong form inside with weak1's rows on the boundary, where collocation is inaccurate.
Method hybrid();

/// Displacement and pressure, both unknown: meshless::elasticity::mixed_form.
Method mixed();

} // namespace comparisons::methods
