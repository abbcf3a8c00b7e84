#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace meshless::effects {

/// Stands in a template for an effect that the scene does not call for: its code is not generated.
struct Absent {};

template <typename Effect>
inline constexpr bool is_present = true;
template <>
inline constexpr bool is_present<Absent> = false;

/// What one effect costs a run: the bytes of the arrays that exist for it alone, and how often it was evaluated (once a
/// step and pass, not once a particle). An effect that is not called for has no entry.
struct Usage {
  std::string effect;
  std::size_t bytes = 0;
  std::int64_t calls = 0;
};

} // namespace meshless::effects
