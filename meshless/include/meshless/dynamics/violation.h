#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace meshless::dynamics {

/// A run in time has left the set of states that mean something: a time step that is not stable, a value that is not
/// finite, a negative density, particles that cross, energy that grows. What it has computed since is no result.
class Violation : public std::runtime_error {
public:
  /// @param particle counted from 0; -1 if it is not about one
  /// @param position of that particle, m
  Violation(double time, std::int64_t particle, double position, const std::string &reason);

  double time() const { return time_; }
  std::int64_t particle() const { return particle_; }

private:
  double time_;
  std::int64_t particle_;
};

} // namespace meshless::dynamics
