#pragma once

#include "meshless/kernels/kernel_table.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Constructing conditions of smoothing functions, Liu, Liu & Lam 2003, sections 2 and 3: checking a
/// given function, and constructing a polynomial one. Lengths in units of h: S = |x - x'| / h.
namespace meshless::kernels {

/// A smoothing function in units of 1 / h^dim, normalising factor included.
struct SmoothingFunction {
  std::function<double(double)> value; ///< of S; in one dimension of the signed (x - x') / h
  /// dW / dS for S > 0; if absent it is found by one-sided differences to about 1e-9 of the largest value.
  std::function<double(double)> slope = {};
  /// d^2W / dS^2 for S > 0; may be absent.
  std::function<double(double)> curvature = {};
  double support = 0;              ///< kappa
  std::vector<double> breaks = {}; ///< distances inside the support where it is not smooth, increasing
};

/// A kernel of the table with its factor for this dimension.
SmoothingFunction smoothing_function(const Kernel &kernel, int dim);

/// The conditions, by quadrature.
enum class Condition {
  normalised,    ///< (1), (22): M_0 = 1
  first_moment,  ///< (22): M_1 = 0
  second_moment, ///< (22): M_2 = 0; holds for no non-negative function
  third_moment,  ///< (22): M_3 = 0
  edge_value,    ///< (23): W = 0 at the edge
  edge_slope,    ///< (23): W' = 0 at the edge
  symmetric,     ///< requirement 6: W(-S) = W(S)
  non_negative,  ///< requirement 3
  monotone       ///< requirement 4: W decreases from the centre to the edge
};

struct ConditionResult {
  Condition condition;
  std::string statement; ///< in words and symbols
  bool holds;
  double
      figure; ///< what was found: the moment, the edge value, the largest asymmetry, the least value, the steepest rise
};

struct ConditionReport {
  std::vector<ConditionResult> conditions; ///< in the order of the enumeration
  std::array<double, 5> moments{};         ///< M_0 .. M_4 (see below)
  double centre = 0;                       ///< W(0)
  double edge_value = 0;
  double edge_slope = 0;
  std::optional<double> edge_curvature; ///< if the function has a curvature
  double least_value = 0;
  double least_value_at = 0;
  std::vector<std::pair<double, double>> negative; ///< intervals of S where W < 0
  std::vector<std::pair<double, double>> rising;   ///< intervals of S where dW / dS > 0

  const ConditionResult &operator[](Condition condition) const {
    return conditions[static_cast<std::size_t>(condition)];
  }
};

/// Checks all conditions in dimension dim = 1, 2, 3.
///
/// The moments are integrals of ((x - x') / h)^k W in one dimension and of (|x - x'| / h)^k W for even k in two and
/// three, where those of odd k vanish for any function of S. Gauss quadrature, 40 points between breaks and on panels
/// no longer than 2: exact for polynomials, 1e-13 for Gaussians.
/// @param tolerance of the integrals and edge values, relative to the centre value where they have its unit
/// @throws std::invalid_argument for another dimension, a support that is not positive, or a function that is not
/// finite
ConditionReport check_conditions(const SmoothingFunction &function, int dim, double tolerance = 1e-10);

/// What a polynomial smoothing function shall satisfy; as many conditions as unknowns.
///
/// One piece (37): W = a_0 + a_2 S^2 + ... + a_n S^n on S <= kappa, n unknowns; without a_1 the second derivative
/// exists at the centre. Several pieces (40): W = sum_i b_i (S_i - S)_+^n with the knots S_i, one unknown a knot; the
/// derivatives up to n - 1 are continuous at all knots and vanish at the edge by themselves. The integral is always 1
/// (22).
struct ConstructingConditions {
  int dim = 1;
  int degree = 2;                     ///< n
  std::vector<double> knots = {};     ///< S_1 < S_2 < ... ; the last is the support kappa; one knot is one piece
  std::optional<double> peak = {};    ///< W(0), units of 1 / h^dim
  int edge_derivatives = 0;           ///< one piece: W, W', ... at the edge that vanish, this many
  std::vector<int> zero_moments = {}; ///< even k whose moment vanishes, such as 2
  /// Several pieces: odd k, d^kW / dS^k(0) = 0. With k = 1 the slope is continuous at the centre.
  std::vector<int> zero_centre_derivatives = {};
};

/// A polynomial in S between knots.
class PiecewisePolynomial {
public:
  /// @param knots ends of the pieces, the first piece begins at 0
  /// @param coefficients of every piece, of S^0, S^1, ...
  PiecewisePolynomial(std::vector<double> knots, std::vector<std::vector<double>> coefficients)
      : knots_(std::move(knots)), coefficients_(std::move(coefficients)) {}

  double support() const { return knots_.back(); }
  const std::vector<double> &knots() const { return knots_; }
  const std::vector<std::vector<double>> &coefficients() const { return coefficients_; }

  /// d^kW / dS^k at S >= 0; 0 outside.
  double derivative(int k, double s) const;
  double value(double s) const { return derivative(0, std::abs(s)); }

  SmoothingFunction smoothing_function() const;

private:
  std::vector<double> knots_;
  std::vector<std::vector<double>> coefficients_;
};

struct ConstructedFunction {
  PiecewisePolynomial polynomial;
  std::vector<double> parameters; ///< a_0, a_2, a_3, ... or b_1, b_2, ...
};

/// Solves the linear system of the conditions in long double.
/// @throws std::invalid_argument if the conditions are not as many as the unknowns (naming both counts), contradict
/// each
///   other or leave the function undetermined, or are malformed
ConstructedFunction construct(const ConstructingConditions &conditions);

} // namespace meshless::kernels
