#pragma once

namespace meshless::effects {

/// Damping in proportion to the mass: the force per mass -rate v.
struct Damping {
  double rate = 0; ///< 1/s
};

} // namespace meshless::effects
