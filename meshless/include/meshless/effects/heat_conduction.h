#pragma once

#include "meshless/kernels/elementary.h"

namespace meshless::effects {

/// Artificial heat conduction of gases against wall heating, after Noh 1987 and Monaghan 1988: a pair that approaches
/// exchanges the power
///   P_ij = 2 m_i m_j q_ij / rho (e_i - e_j) x_ij W'_ij / (x_ij^2 + epsilon h^2),  q = h (g1 c + g2 |v_ij|),
/// so that what one loses the other gains. W'_ij is the derivative by x_i.
struct HeatConduction {
  double linear = 0.1;     ///< g1
  double quadratic = 1;    ///< g2
  double softening = 0.01; ///< epsilon

  /// P_ij / (m_i m_j W'_ij) in J m^2 / (kg^2 s). T is double or a SIMD pack.
  /// @param dx, dv, de differences x_i - x_j, v_i - v_j, e_i - e_j
  template <typename T>
  T flux(const T &dx, const T &dv, const T &de, const T &h, const T &sound_speed, const T &density) const {
    const T speed = kernels::select(dv < T(0), T(-dv), dv);
    const T q = h * (linear * sound_speed + quadratic * speed);
    const T all = 2 * q / density * de * dx / (dx * dx + softening * h * h);
    return kernels::select(dx * dv < T(0), all, T(0));
  }
};

} // namespace meshless::effects
