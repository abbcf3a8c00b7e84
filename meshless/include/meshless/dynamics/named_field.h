#pragma once

#include <span>
#include <string>
#include <vector>

namespace meshless::dynamics {

/// One array of a run's state under its name, to be kept in a checkpoint and set again.
struct NamedField {
  std::string name;
  std::span<double> values;
};

/// All of a run's state: a run whose state is set to that of another goes on with the same bits.
using State = std::vector<NamedField>;

} // namespace meshless::dynamics
