#include "meshless/kernels/constructing.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace meshless::kernels {

namespace {

using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

Real surface(int dim) {
  constexpr Real pi = std::numbers::pi_v<Real>;
  const Real content[] = {2, 2 * pi, 4 * pi};
  return content[dim - 1];
}

Real binomial(int n, int k) {
  Real result = 1;
  for (int i = 1; i <= k; ++i)
    result = result * (n - k + i) / i;
  return result;
}

Real falling_factorial(int n, int k) {
  Real result = 1;
  for (int i = 0; i < k; ++i)
    result *= n - i;
  return result;
}

/// The functions whose combination is sought: what the conditions make of each.
class Terms {
public:
  explicit Terms(const ConstructingConditions &conditions) : given_(conditions) {
    if (one_piece())
      for (int k = 0; k <= given_.degree; ++k)
        if (k != 1)
          powers_.push_back(k);
  }

  bool one_piece() const { return given_.knots.size() == 1; }
  std::size_t size() const { return one_piece() ? powers_.size() : given_.knots.size(); }

  /// Integral of S^k times term t over the space.
  Real moment(std::size_t t, int k) const {
    const int power = k + given_.dim - 1;
    if (one_piece()) {
      const int total = powers_[t] + power + 1;
      return surface(given_.dim) * std::pow(Real(given_.knots[0]), total) / total;
    }
    // Integral of S^p (a - S)^n from 0 to a: a^(n + p + 1) n! p! / (n + p + 1)!.
    const int n = given_.degree;
    return surface(given_.dim) * std::pow(Real(given_.knots[t]), n + power + 1) /
           ((n + power + 1) * binomial(n + power, power));
  }

  /// d^k / dS^k of term t at s inside its piece.
  Real derivative(std::size_t t, int k, Real s) const {
    if (one_piece())
      return powers_[t] < k ? 0 : falling_factorial(powers_[t], k) * std::pow(s, powers_[t] - k);
    const int n = given_.degree;
    const Real base = Real(given_.knots[t]) - s;
    return base < 0 || k > n ? 0 : (k % 2 == 0 ? 1 : -1) * falling_factorial(n, k) * std::pow(base, n - k);
  }

  PiecewisePolynomial combine(const Vector &parameters) const {
    const auto n = static_cast<std::size_t>(given_.degree);
    std::vector<std::vector<double>> pieces;
    for (std::size_t piece = 0; piece < given_.knots.size(); ++piece) {
      std::vector<Real> coefficients(n + 1, 0);
      if (one_piece())
        for (std::size_t t = 0; t < powers_.size(); ++t)
          coefficients[static_cast<std::size_t>(powers_[t])] = parameters[static_cast<Eigen::Index>(t)];
      else
        for (std::size_t t = piece; t < given_.knots.size(); ++t)
          for (int k = 0; k <= given_.degree; ++k)
            coefficients[static_cast<std::size_t>(k)] +=
                parameters[static_cast<Eigen::Index>(t)] * derivative(t, k, 0) / falling_factorial(k, k);
      pieces.emplace_back(coefficients.begin(), coefficients.end());
    }
    return {given_.knots, std::move(pieces)};
  }

private:
  const ConstructingConditions &given_;
  std::vector<int> powers_; ///< one piece: 0, 2, 3, ...
};

/// One linear condition: the sum of coefficient times term is `right`.
struct Equation {
  std::function<Real(std::size_t)> coefficient;
  Real right;
};

std::vector<Equation> equations(const ConstructingConditions &given, const Terms &terms) {
  std::vector<Equation> result;
  result.push_back({[&](std::size_t t) { return terms.moment(t, 0); }, 1});
  if (given.peak)
    result.push_back({[&](std::size_t t) { return terms.derivative(t, 0, 0); }, *given.peak});
  for (int k = 0; k < given.edge_derivatives; ++k)
    result.push_back({[&, k](std::size_t t) { return terms.derivative(t, k, given.knots[0]); }, 0});
  for (const int k : given.zero_moments)
    result.push_back({[&, k](std::size_t t) { return terms.moment(t, k); }, 0});
  for (const int k : given.zero_centre_derivatives)
    result.push_back({[&, k](std::size_t t) { return terms.derivative(t, k, 0); }, 0});
  return result;
}

void check_input(const ConstructingConditions &given) {
  if (given.dim < 1 || given.dim > 3)
    throw std::invalid_argument(fmt::format("a smoothing function in {} dimensions; there are 1, 2 and 3", given.dim));
  if (given.degree < 1 || given.degree > 20)
    throw std::invalid_argument(fmt::format("a smoothing function of degree {}; 1 to 20 are possible", given.degree));
  if (given.knots.empty())
    throw std::invalid_argument("a smoothing function without a support: give its knots, the last is the support");
  for (std::size_t i = 0; i < given.knots.size(); ++i)
    if (!(given.knots[i] > (i == 0 ? 0 : given.knots[i - 1])) || !std::isfinite(given.knots[i]))
      throw std::invalid_argument(fmt::format(
          "knot {} of the smoothing function, {}, does not exceed the one before it", i + 1, given.knots[i]));
  if (given.knots.size() > 1 && given.edge_derivatives > 0)
    throw std::invalid_argument(
        "a smoothing function of several pieces vanishes at its edge by itself: it takes no edge "
        "conditions");
  if (given.knots.size() == 1 && !given.zero_centre_derivatives.empty())
    throw std::invalid_argument(
        "a smoothing function of one piece has no term S^1: it takes no conditions on derivatives "
        "at the centre");
  for (const int k : given.zero_moments)
    if (k < 2 || k % 2 != 0)
      throw std::invalid_argument(fmt::format("moment {}: only even ones from 2 on can be made zero; odd ones are", k));
  for (const int k : given.zero_centre_derivatives)
    if (k < 1 || k % 2 != 1)
      throw std::invalid_argument(fmt::format("derivative {} at the centre: only odd ones must vanish", k));
}

} // namespace

double PiecewisePolynomial::derivative(int k, double s) const {
  const auto piece = std::lower_bound(knots_.begin(), knots_.end(), s) - knots_.begin();
  if (static_cast<std::size_t>(piece) == knots_.size())
    return 0;
  const auto &coefficients = coefficients_[static_cast<std::size_t>(piece)];
  Real sum = 0;
  for (int i = static_cast<int>(coefficients.size()) - 1; i >= k; --i)
    sum = sum * s + falling_factorial(i, k) * coefficients[static_cast<std::size_t>(i)];
  return static_cast<double>(sum);
}

SmoothingFunction PiecewisePolynomial::smoothing_function() const {
  return {.value = [copy = *this](double s) { return copy.value(s); },
          .slope = [copy = *this](double s) { return copy.derivative(1, s); },
          .curvature = [copy = *this](double s) { return copy.derivative(2, s); },
          .support = support(),
          .breaks = {knots_.begin(), knots_.end() - 1}};
}

ConstructedFunction construct(const ConstructingConditions &conditions) {
  check_input(conditions);
  const Terms terms(conditions);
  const auto system = equations(conditions, terms);
  if (system.size() != terms.size())
    throw std::invalid_argument(
        fmt::format("a smoothing function with {} unknowns ({}) and {} conditions, the integral "
                    "among them: they must be as many",
                    terms.size(), terms.one_piece() ? "a_0, a_2, a_3, ..." : "one a knot", system.size()));
  const auto n = static_cast<Eigen::Index>(terms.size());
  Matrix matrix(n, n);
  Vector right(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto &equation = system[static_cast<std::size_t>(i)];
    for (Eigen::Index t = 0; t < n; ++t)
      matrix(i, t) = equation.coefficient(static_cast<std::size_t>(t));
    right[i] = equation.right;
    const Real largest = matrix.row(i).cwiseAbs().maxCoeff();
    if (largest > 0) {
      matrix.row(i) /= largest;
      right[i] /= largest;
    }
  }
  Eigen::FullPivLU<Matrix> factor(matrix);
  factor.setThreshold(1e-14L);
  if (!factor.isInvertible())
    throw std::invalid_argument(
        fmt::format("the conditions of the smoothing function depend on each other: {} of {} are "
                    "independent",
                    factor.rank(), n));
  const Vector parameters = factor.solve(right);
  return {terms.combine(parameters), {parameters.begin(), parameters.end()}};
}

} // namespace meshless::kernels
