#include "meshless/linear_algebra/gauss_legendre.h"

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace meshless::linear_algebra {

GaussRule gauss_legendre(int n) {
  if (n < 1)
    throw std::invalid_argument("a Gauss rule needs at least one point");
  GaussRule rule;
  rule.points.resize(static_cast<std::size_t>(n));
  rule.weights.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
    double derivative = 1;
    for (int iteration = 0; iteration < 100; ++iteration) {
      double previous = 1;
      double value = x;
      for (int k = 2; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
        previous = value;
        value = next;
      }
      derivative = n * (x * value - previous) / (x * x - 1);
      const double step = value / derivative;
      x -= step;
      if (std::abs(step) < 1e-16)
        break;
    }
    // Descending in x, so stored from the end.
    const auto slot = static_cast<std::size_t>(n - 1 - i);
    rule.points[slot] = 0.5 * (1 + x);
    rule.weights[slot] = 1 / ((1 - x * x) * derivative * derivative);
  }
  return rule;
}

const GaussRule &cached_gauss_legendre(int n) {
  thread_local std::map<int, GaussRule> rules; // a map: references stay valid as it grows
  GaussRule &rule = rules[n];
  if (rule.points.empty())
    rule = gauss_legendre(n);
  return rule;
}

} // namespace meshless::linear_algebra
