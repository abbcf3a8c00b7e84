#include "meshless/kernels/stress_growth.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace meshless::kernels {

StressGrowth stress_growth(const SmoothingFunction &function, double smoothing_length) {
  if (!function.curvature)
    throw std::invalid_argument("the growth under stress needs the second derivative of the kernel");
  if (!(smoothing_length > 0) || !std::isfinite(smoothing_length))
    throw std::invalid_argument("a smoothing length must be positive");
  const double spacing = 1 / smoothing_length;
  std::vector<double> curvature; // of the neighbours on one side
  for (double s = spacing; s < function.support; s = spacing * static_cast<double>(curvature.size() + 1))
    curvature.push_back(function.curvature(s));
  StressGrowth growth;
  constexpr int n_waves = 1000; // up to two spacings a wave
  for (int i = 1; i <= n_waves; ++i) {
    const double phase = std::numbers::pi * i / n_waves;
    double sum = 0;
    for (std::size_t j = 0; j < curvature.size(); ++j)
      sum += curvature[j] * (1 - std::cos(phase * static_cast<double>(j + 1)));
    growth.tension = std::max(growth.tension, 2 * spacing * sum);
    growth.compression = std::max(growth.compression, -2 * spacing * sum);
  }
  return growth;
}

} // namespace meshless::kernels
