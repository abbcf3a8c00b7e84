#pragma once

#include "meshless/kernels/constructing.h"

namespace meshless::kernels {

/// How fast perturbations of a uniform row of particles grow under a uniform stress (Swegle, Hicks & Attaway 1995).
///
/// Moving the particles of the SPH sum a_i = sum m (sigma_i + sigma_j) / rho^2 W,i by e^(ikx) with nothing but a stress
/// sigma (positive in tension) in them gives them the acceleration growth^2 = 2 sigma / (rho h^2) G(k) times the
/// motion,
///   G(k) = D / h sum_j W''(j D / h) (1 - cos(k j D)),
/// with W of S in units of 1 / h. It is the part of the stability that the second derivative of the kernel decides; the
/// stiffness of a material works against it.
struct StressGrowth {
  double tension = 0;     ///< the largest G over all k: 0 if no motion grows in tension
  double compression = 0; ///< the largest -G
};

/// @param function in one dimension, with its curvature
/// @param smoothing_length h over the spacing D
/// @throws std::invalid_argument without a curvature, or for an h that is not positive
StressGrowth stress_growth(const SmoothingFunction &function, double smoothing_length);

} // namespace meshless::kernels
