#pragma once

#include <array>
#include <memory>
#include <string>

namespace comparisons::scene {

/// A function of x, y, z (each where there are that many dimensions) and pi, given as an expression
/// ("sin(8*(1-x))/sin(8)"), with its derivatives.
///
/// Derivatives are central differences of eighth order with a step of 1/64: for a smooth function
/// their error is near 1e-13 and 1e-11 of its size, far below the errors that are measured with them.
class Expression {
public:
  /// @throws std::invalid_argument saying what is wrong and where, for an expression that does not
  ///   parse or names a variable beyond `dim`
  Expression(const std::string &text, int dim);
  ~Expression();
  Expression(const Expression &) = delete;
  Expression &operator=(const Expression &) = delete;

  /// @throws std::domain_error naming the point where the value is not finite
  double value(const std::array<double, 3> &point) const;
  double first(const std::array<double, 3> &point, int k) const;
  double second(const std::array<double, 3> &point, int k, int l) const;

private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::string text_;
};

} // namespace comparisons::scene
