#pragma once

#include "comparisons/methods/method_table.h"

namespace comparisons::methods {

/// The finite-element reference: isoparametric Q1 to Q4 by deal.II.
Method fem();

} // namespace comparisons::methods
