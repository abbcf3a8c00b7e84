#include "meshless/dynamics/violation.h"

#include <fmt/format.h>

namespace meshless::dynamics {

namespace {

std::string text(double time, std::int64_t particle, double position, const std::string &reason) {
  if (particle < 0)
    return fmt::format("at t = {:.6g} s: {}", time, reason);
  return fmt::format("at t = {:.6g} s, particle {} at x = {:.6g} m: {}", time, particle + 1, position, reason);
}

} // namespace

Violation::Violation(double time, std::int64_t particle, double position, const std::string &reason)
    : std::runtime_error(text(time, particle, position, reason)), time_(time), particle_(particle) {}

} // namespace meshless::dynamics
