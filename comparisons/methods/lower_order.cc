#include "comparisons/methods/lower_order.h"

#include "meshless/basis/basis_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace comparisons::methods {

scene::Parameters with_order(const scene::Parameters &parameters, std::int64_t order) {
  scene::Parameters changed;
  for (auto parameter : parameters.all()) {
    if (parameter.declaration.name == "order")
      parameter.value = order;
    changed.add(std::move(parameter));
  }
  return changed;
}

OrderSearch::OrderSearch(const scene::Parameters &parameters, Form form)
    : parameters_(parameters), asked_(parameters.integer("order")), order_(asked_),
      least_(std::max<std::int64_t>(least_order(form),
                                    meshless::basis::describe_basis(parameters.text("basis")).lowest_order)),
      wanted_(parameters.text("lower_order") == "on") {}

bool OrderSearch::may_lower() const { return wanted_ && order_ > least_; }

void OrderSearch::lower(const std::string &reason) {
  if (reason_.empty())
    reason_ = reason;
  lost_seconds_ += watch_.lap();
  if (may_lower()) {
    parameters_ = with_order(parameters_, --order_);
    return;
  }
  if (order_ < asked_)
    throw Refused(fmt::format("{}; nor does a lower order exist, down to {}", reason_, least_));
  throw Refused(order_ > least_ ? reason_ + "; lower_order = \"on\" takes the highest order that there is" : reason_);
}

OrderTaken OrderSearch::taken() const {
  if (order_ == asked_)
    return {};
  return {asked_ - order_,
          fmt::format("order {} does not exist on these particles ({}); solved with order {}", asked_, reason_, order_),
          lost_seconds_};
}

} // namespace comparisons::methods
