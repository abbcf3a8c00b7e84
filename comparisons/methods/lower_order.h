#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/methods/particle_keys.h"

#include "meshless/basis/shape_functions.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <cstdint>
#include <string>

namespace comparisons::methods {

/// What was found out about the order before a cell was solved.
struct OrderTaken {
  std::int64_t n_lowered = 0; ///< below the one asked for
  std::string warning;        ///< that says so; empty if the order is the one asked for
  double lost_seconds = 0;    ///< of what was begun with higher orders
};

/// The same keys with another order.
scene::Parameters with_order(const scene::Parameters &parameters, std::int64_t order);

/// Looks for the highest order that particles carry, from the one asked for down. With the key lower_order off that one
/// is the only one.
class OrderSearch {
public:
  OrderSearch(const scene::Parameters &parameters, Form form);

  /// With the order to be tried, and all that follows from it as if it had been asked for.
  const scene::Parameters &parameters() const { return parameters_; }
  bool may_lower() const;
  /// To the next lower order, since a moment matrix is singular.
  /// @throws Refused if there is none, with the first reason
  void lower(const std::string &reason);
  OrderTaken taken() const;

private:
  scene::Parameters parameters_;
  std::int64_t asked_, order_, least_;
  bool wanted_;
  std::string reason_; ///< why the order asked for does not exist
  meshless::linear_algebra::Stopwatch watch_;
  double lost_seconds_ = 0;
};

/// act(request, order_search) with the order asked for or, with lower_order on, the highest lower one whose moment
/// matrices are regular.
/// @throws Refused if there is no such order
template <typename Act>
auto at_existing_order(const SolveRequest &request, Form form, Act act) {
  OrderSearch search(request.parameters, form);
  while (true)
    try {
      return act(SolveRequest{request.statement, request.cloud, request.mesh, search.parameters()}, search);
    } catch (const meshless::basis::SingularMomentMatrix &error) {
      search.lower(error.what());
    }
}

} // namespace comparisons::methods
