#include "comparisons/scene/expression.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace comparisons::scene {

namespace {

constexpr double step = 1.0 / 64;
constexpr int reach = 4;
// Coefficients of f(x + i step) - f(x - i step) in f'(x) step, and of f(x + i step) + f(x - i step)
// in f''(x) step^2; eighth order.
constexpr double first_coefficient[reach + 1] = {0, 4.0 / 5, -1.0 / 5, 4.0 / 105, -1.0 / 280};
constexpr double second_coefficient[reach + 1] = {-205.0 / 72, 8.0 / 5, -1.0 / 5, 8.0 / 315, -1.0 / 560};

} // namespace

struct Expression::Parser {
  mu::Parser parser;
  std::array<double, 3> variables{};
};

Expression::Expression(const std::string &text, int dim) : parser_(std::make_unique<Parser>()), text_(text) {
  const char *names[] = {"x", "y", "z"};
  try {
    for (int k = 0; k < dim; ++k)
      parser_->parser.DefineVar(names[k], &parser_->variables[static_cast<std::size_t>(k)]);
    parser_->parser.DefineConst("pi", std::numbers::pi);
    parser_->parser.SetExpr(text);
    parser_->parser.Eval();
  } catch (const mu::Parser::exception_type &error) {
    throw std::invalid_argument(fmt::format("'{}' is no function of {}: {}", text,
                                            dim == 1   ? "x"
                                            : dim == 2 ? "x and y"
                                                       : "x, y and z",
                                            error.GetMsg()));
  }
}

Expression::~Expression() = default;

double Expression::value(const std::array<double, 3> &point) const {
  parser_->variables = point;
  double result = std::nan("");
  try {
    result = parser_->parser.Eval();
  } catch (const mu::Parser::exception_type &) {
    // reported below as not finite
  }
  if (!std::isfinite(result))
    throw std::domain_error(
        fmt::format("'{}' is not finite at ({:.6g}, {:.6g}, {:.6g})", text_, point[0], point[1], point[2]));
  return result;
}

double Expression::first(const std::array<double, 3> &point, int k) const {
  double sum = 0;
  for (int i = 1; i <= reach; ++i) {
    auto forward = point;
    auto backward = point;
    forward[static_cast<std::size_t>(k)] += i * step;
    backward[static_cast<std::size_t>(k)] -= i * step;
    sum += first_coefficient[i] * (value(forward) - value(backward));
  }
  return sum / step;
}

double Expression::second(const std::array<double, 3> &point, int k, int l) const {
  if (k != l) {
    double sum = 0;
    for (int i = 1; i <= reach; ++i) {
      auto forward = point;
      auto backward = point;
      forward[static_cast<std::size_t>(k)] += i * step;
      backward[static_cast<std::size_t>(k)] -= i * step;
      sum += first_coefficient[i] * (first(forward, l) - first(backward, l));
    }
    return sum / step;
  }
  double sum = second_coefficient[0] * value(point);
  for (int i = 1; i <= reach; ++i) {
    auto forward = point;
    auto backward = point;
    forward[static_cast<std::size_t>(k)] += i * step;
    backward[static_cast<std::size_t>(k)] -= i * step;
    sum += second_coefficient[i] * (value(forward) + value(backward));
  }
  return sum / (step * step);
}

} // namespace comparisons::scene
