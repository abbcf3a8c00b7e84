#pragma once

#include <algorithm>

namespace meshless::effects {

/// Release of an explosive's energy at a front x = D t that is prescribed: the pressure of a particle that started at X
/// is F p with the burn fraction
///   F = 1 if X <= D t, else 0;  with a ramp of the width w:  F = (D t - X) / w within [0, 1].
struct ProgrammedBurn {
  double speed = 0; ///< D, m/s
  double ramp = 0;  ///< w, m; 0: at once

  /// @param start position X at t = 0, m
  double fraction(double start, double time) const {
    const double burnt = speed * time - start;
    return ramp > 0 ? std::clamp(burnt / ramp, 0.0, 1.0) : (burnt >= 0 ? 1.0 : 0.0);
  }
};

} // namespace meshless::effects
