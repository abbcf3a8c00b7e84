#pragma once

#include "comparisons/problems/plane_problem.h"

#include <array>
#include <memory>
#include <string>

namespace comparisons::problems {

/// A function of x and y from a text: a number or an expression, SI. May be called by several threads.
class ScalarField {
public:
  /// @throws std::invalid_argument for a text that is no expression
  explicit ScalarField(const std::string &text);

  /// Values at points. @throws std::domain_error naming the point where the value is not finite
  void evaluate(std::span<const Point2> points, std::span<double> values) const;
  double value(const Point2 &point) const;

private:
  struct Function;
  std::shared_ptr<const Function> function_;
};

/// factor f
ScalarValues scalar_values(const std::string &text, double factor);
VectorField vector_field(const std::array<std::string, 2> &texts);
/// Components 11, 22, 12.
StressField stress_field(const std::array<std::string, 3> &texts);
TractionField traction_field(const std::array<std::string, 2> &texts);
/// -p n
TractionField pressure_field(const std::string &text);
/// sigma n
TractionField traction_of(StressField stress);

} // namespace comparisons::problems
