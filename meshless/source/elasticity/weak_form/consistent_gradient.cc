#include "meshless/elasticity/weak_form/consistent_gradient.h"

#include <Eigen/Cholesky>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::elasticity::weak_form {

namespace {

/// Pivots of the scaled M below this part of the largest leave the correction no digits.
constexpr double singular_pivot = 1e-11;

} // namespace

ConsistentGradient::ConsistentGradient(int degree) : degree_(degree), n_terms_((degree + 1) * (degree + 2) / 2) {
  if (degree < 0 || degree > max_degree)
    throw std::invalid_argument(
        fmt::format("a consistent gradient of degree {}: 0 to {} are possible", degree, static_cast<int>(max_degree)));
}

void ConsistentGradient::monomials(double x, double y, Values &p) const {
  p[0] = 1;
  for (int d = 1, term = 1, last = 0; d <= degree_; ++d) { // x^d, x^(d-1) y, .., y^d
    for (int k = 0; k < d; ++k)
      p[term + k] = x * p[last + k];
    p[term + d] = y * p[term - 1];
    last = term;
    term += d + 1;
  }
}

void ConsistentGradient::derivatives(double x, double y, Values &p_1, Values &p_2) const {
  Values p;
  monomials(x, y, p);
  p_1[0] = p_2[0] = 0;
  for (int d = 1, term = 1, last = 0; d <= degree_; ++d) { // of x^(d-k) y^k: (d-k) x^(d-k-1) y^k, k x^(d-k) y^(k-1)
    for (int k = 0; k <= d; ++k) {
      p_1[term + k] = k < d ? (d - k) * p[last + k] : 0;
      p_2[term + k] = k > 0 ? k * p[last + k - 1] : 0;
    }
    last = term;
    term += d + 1;
  }
}

bool ConsistentGradient::correct(const domain::Point2 &centre, double radius,
                                 const domain::SubdomainQuadrature &quadrature, std::span<const double> test,
                                 std::span<const double> edge_test, std::array<std::vector<double>, 2> &gradient) {
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_terms, max_terms>;
  using Right = Eigen::Matrix<double, Eigen::Dynamic, 2, 0, max_terms, 2>;
  const double inverse = 1 / radius;
  const std::size_t n_points = quadrature.JxW.size();
  Matrix moments = Matrix::Zero(n_terms_, n_terms_);
  Right right = Right::Zero(n_terms_, 2);
  Values p, p_1, p_2;
  for (std::size_t q = 0; q < n_points; ++q) {
    const double x = (quadrature.point[0][q] - centre[0]) * inverse;
    const double y = (quadrature.point[1][q] - centre[1]) * inverse;
    monomials(x, y, p);
    derivatives(x, y, p_1, p_2);
    const double weight = quadrature.JxW[q];
    for (int a = 0; a < n_terms_; ++a) {
      right(a, 0) -= weight * (gradient[0][q] * p[a] + test[q] * p_1[a] * inverse);
      right(a, 1) -= weight * (gradient[1][q] * p[a] + test[q] * p_2[a] * inverse);
      for (int b = 0; b <= a; ++b)
        moments(a, b) += weight * p[a] * p[b];
    }
  }
  for (std::size_t q = 0; q < quadrature.boundary_JxW.size(); ++q) {
    monomials((quadrature.boundary_point[0][q] - centre[0]) * inverse,
              (quadrature.boundary_point[1][q] - centre[1]) * inverse, p);
    const double weight = quadrature.boundary_JxW[q] * edge_test[q];
    for (int a = 0; a < n_terms_; ++a) {
      right(a, 0) += weight * quadrature.boundary_normal[0][q] * p[a];
      right(a, 1) += weight * quadrature.boundary_normal[1][q] * p[a];
    }
  }
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_terms, 1> scale(n_terms_);
  for (int a = 0; a < n_terms_; ++a) {
    if (!(moments(a, a) > 0))
      return false;
    scale[a] = 1 / std::sqrt(moments(a, a));
  }
  for (int a = 0; a < n_terms_; ++a)
    for (int b = 0; b <= a; ++b)
      moments(b, a) = moments(a, b) = moments(a, b) * scale[a] * scale[b];
  const Eigen::LDLT<Matrix> factors(moments);
  const auto pivots = factors.vectorD();
  if (!(pivots.minCoeff() > singular_pivot * pivots.maxCoeff()))
    return false;
  Right coefficients = factors.solve(Right(scale.asDiagonal() * right));
  coefficients = scale.asDiagonal() * coefficients;
  for (std::size_t q = 0; q < n_points; ++q) {
    monomials((quadrature.point[0][q] - centre[0]) * inverse, (quadrature.point[1][q] - centre[1]) * inverse, p);
    for (int a = 0; a < n_terms_; ++a)
      for (std::size_t k = 0; k < 2; ++k)
        gradient[k][q] += coefficients(a, static_cast<Eigen::Index>(k)) * p[a];
  }
  return true;
}

domain::SubdomainPoints consistent_points(int order) {
  const int radial = order <= 3 ? 3 : 4;
  return {
      .radial = radial, .angular = std::max(8, 4 * order), .boundary = 5, .by_area = true, .radial_cut = 2 * radial};
}

} // namespace meshless::elasticity::weak_form
