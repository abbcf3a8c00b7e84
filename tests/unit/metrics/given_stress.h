#pragma once

#include "comparisons/methods/solution.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

namespace metrics_tests {

/// A solution of which nothing but the stress is known: components 11, 22, 12 as a function of the point.
class GivenStress final : public comparisons::methods::Solution {
public:
  using Point = std::array<double, 2>;
  using Stress = std::array<double, 3>;

  explicit GivenStress(std::function<Stress(const Point &)> stress) : stress_(std::move(stress)) {}
  std::vector<std::string> fields() const override { return {"stress"}; }
  std::size_t n_components(std::string_view) const override { return 3; }
  void evaluate(std::string_view field, std::span<const Point> points, std::span<double> values) const override {
    if (field != "stress")
      throw std::invalid_argument("stress only");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Stress s = stress_(points[i]);
      std::copy(s.begin(), s.end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  }

private:
  std::function<Stress(const Point &)> stress_;
};

} // namespace metrics_tests
