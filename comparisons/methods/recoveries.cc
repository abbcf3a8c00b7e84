#include "comparisons/methods/recoveries.h"

#include <fmt/format.h>

namespace comparisons::methods {

Recoveries recoveries_of(const Prepared &prepared) {
  Recoveries result;
  if (prepared.order.n_lowered > 0) {
    result.quantities["n_orders_lowered"] = static_cast<double>(prepared.order.n_lowered);
    result.warnings.push_back(prepared.order.warning);
  }
  if (prepared.n_enlarged > 0) {
    result.quantities["n_enlarged"] = static_cast<double>(prepared.n_enlarged);
    result.quantities["largest_enlargement"] = prepared.largest_factor;
    result.warnings.push_back(fmt::format("smoothing lengths of {} particles enlarged, at most by {:.2f}",
                                          prepared.n_enlarged, prepared.largest_factor));
  }
  return result;
}

} // namespace comparisons::methods
