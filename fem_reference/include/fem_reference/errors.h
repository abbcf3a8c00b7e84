#pragma once

#include <stdexcept>

namespace fem_reference {
/// The caller's data cannot be solved as given: an invalid mesh, material or boundary condition.
/// The message names the item, what was found and what was expected.
class InvalidInput : public std::invalid_argument {
public:
  using std::invalid_argument::invalid_argument;
};

/// The data are valid but the linear system could not be solved: not positive definite, singular,
/// out of memory, or not finite.
class SolveFailure : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};
} // namespace fem_reference
