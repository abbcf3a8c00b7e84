#pragma once

#include "comparisons/methods/solution.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>

namespace metrics_tests {

/// A solution of which nothing but the stress is known: components 11, 22, 12 as a function of the point; and, if it is
/// given, one displacement everywhere with the penalty that holds it.
class GivenStress final : public comparisons::methods::Solution {
public:
  using Point = std::array<double, 2>;
  using Stress = std::array<double, 3>;

  explicit GivenStress(std::function<Stress(const Point &)> stress, double penalty = 0, Point displacement = {})
      : stress_(std::move(stress)), penalty_(penalty), displacement_(displacement) {}
  std::vector<std::string> fields() const override { return {"displacement", "stress"}; }
  std::size_t n_components(std::string_view field) const override { return field == "stress" ? 3 : 2; }
  std::vector<double> penalty(std::span<const Point> points) const override {
    return std::vector<double>(penalty_ > 0 ? points.size() : 0, penalty_);
  }
  void evaluate(std::string_view field, std::span<const Point> points, std::span<double> values) const override {
    if (field == "displacement") {
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = displacement_[i % 2];
      return;
    }
    if (field != "stress")
      throw std::invalid_argument("stress and displacement only");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Stress s = stress_(points[i]);
      std::copy(s.begin(), s.end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
  }

private:
  std::function<Stress(const Point &)> stress_;
  double penalty_;
  Point displacement_;
};

} // namespace metrics_tests
