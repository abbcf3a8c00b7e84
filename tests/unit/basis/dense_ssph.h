#pragma once

#include "meshless/cloud/particles.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <vector>

/// The SSPH basis written down a second time, from the papers' formulas: dense, in long double,
/// one point and all particles at once, with Eigen's pivoted LDL^T. Shares nothing with meshless/basis.
namespace dense_ssph {

using meshless::cloud::Point;
using Real = long double;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;

/// Exponents of all monomials of degree <= order, squares anywhere: the order does not matter.
template <int dim>
std::vector<std::array<int, dim>> exponents(int order) {
  std::vector<std::array<int, dim>> all(1, std::array<int, dim>{});
  for (int k = 0; k < dim; ++k) {
    std::vector<std::array<int, dim>> longer;
    for (auto alpha : all) {
      int degree = 0;
      for (const int a : alpha)
        degree += a;
      for (int a = 0; a + degree <= order; ++a) {
        alpha[k] = a;
        longer.push_back(alpha);
      }
    }
    all = std::move(longer);
  }
  return all;
}

template <int dim>
Real monomial(const std::array<int, dim> &alpha, const std::array<Real, dim> &d) {
  Real product = 1;
  for (int k = 0; k < dim; ++k)
    for (int a = 0; a < alpha[k]; ++a)
      product *= d[k];
  return product;
}

/// Shape functions of all particles at one point; the kernel is Gauss' with cut-off rho.
template <int dim>
struct ShapeFunctions {
  std::vector<Real> value;
  std::array<std::vector<Real>, dim> gradient;
  std::array<std::array<std::vector<Real>, dim>, dim> hessian;
  std::array<std::vector<Real>, dim> differentiated_gradient;
  /// Condition number of the moment matrix, its diagonal scaled to one.
  double condition = 0;
};

namespace detail {

template <int dim>
struct Sums {
  std::vector<std::array<int, dim>> alpha;
  Matrix C;                     ///< sum p p^T W
  std::array<Matrix, dim> C_k;  ///< its derivative, with that of p
  Matrix pW;                    ///< p_J W_J, a column a particle
  std::array<Matrix, dim> pW_k; ///< its derivative
};

/// Offsets scaled by `scale`; derivatives with respect to the scaled evaluation point.
template <int dim>
Sums<dim> sums(const meshless::cloud::Particles<dim> &particles, int order, Real rho, const Point<dim> &x, Real scale) {
  Sums<dim> result;
  result.alpha = exponents<dim>(order);
  const auto n = static_cast<Eigen::Index>(result.alpha.size());
  const auto n_particles = static_cast<Eigen::Index>(particles.size());
  result.C = Matrix::Zero(n, n);
  result.pW = Matrix::Zero(n, n_particles);
  result.C_k.fill(Matrix::Zero(n, n));
  result.pW_k.fill(Matrix::Zero(n, n_particles));
  for (Eigen::Index j = 0; j < n_particles; ++j) {
    const auto particle = static_cast<std::size_t>(j);
    const Real h = Real(particles.smoothing_length(particle)) / scale;
    std::array<Real, dim> d;
    Real s_squared = 0;
    for (int k = 0; k < dim; ++k) {
      d[k] = (Real(particles.position(particle)[k]) - Real(x[k])) / scale;
      s_squared += d[k] * d[k] / (h * h);
    }
    if (s_squared >= rho * rho * (1 - 1e-12L))
      continue;
    const Real W = std::exp(-s_squared) - std::exp(-rho * rho);
    Vector p(n);
    for (Eigen::Index a = 0; a < n; ++a)
      p[a] = monomial<dim>(result.alpha[static_cast<std::size_t>(a)], d);
    result.C += p * p.transpose() * W;
    result.pW.col(j) = p * W;
    for (int k = 0; k < dim; ++k) {
      const Real W_k = 2 * d[k] / (h * h) * std::exp(-s_squared);
      Vector p_k = Vector::Zero(n); // d = xi - x: the derivative by x is minus that by d
      for (Eigen::Index a = 0; a < n; ++a) {
        auto lower = result.alpha[static_cast<std::size_t>(a)];
        if (lower[k]-- > 0)
          p_k[a] = -Real(lower[k] + 1) * monomial<dim>(lower, d);
      }
      result.C_k[k] += (p_k * p.transpose() + p * p_k.transpose()) * W + p * p.transpose() * W_k;
      result.pW_k[k].col(j) = p_k * W + p * W_k;
    }
  }
  return result;
}

inline std::vector<Real> row(const Matrix &matrix, Eigen::Index i, Real factor) {
  std::vector<Real> result;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    result.push_back(factor * matrix(i, j));
  return result;
}

inline double scaled_condition(const Matrix &C) {
  const Vector d = C.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix scaled = d.asDiagonal() * C * d.asDiagonal();
  const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<double>(values.maxCoeff() / values.minCoeff());
}

} // namespace detail

/// C Q = D F (Batra & Zhang 2008, (2.8)-(2.11)) with the Taylor factors of (2.15); the derivative of
/// the shape function by the product rule on e_1^T C^-1 p W, dp/dx included.
template <int dim>
ShapeFunctions<dim> evaluate(const meshless::cloud::Particles<dim> &particles, int order, double rho,
                             const Point<dim> &x, double scale) {
  const auto s = detail::sums<dim>(particles, order, rho, x, scale);
  const Eigen::LDLT<Matrix> factor(s.C);
  const Matrix K = factor.solve(s.pW);
  const auto index = [&](const std::array<int, dim> &wanted) {
    Eigen::Index a = 0;
    while (s.alpha[static_cast<std::size_t>(a)] != wanted)
      ++a;
    return a;
  };
  const Vector first = factor.solve(Vector(Vector::Unit(s.C.rows(), index({}))));
  ShapeFunctions<dim> result;
  result.condition = detail::scaled_condition(s.C);
  result.value = detail::row(K, index({}), 1);
  for (int k = 0; k < dim; ++k) {
    std::array<int, dim> alpha{};
    ++alpha[k];
    result.gradient[k] = detail::row(K, index(alpha), 1 / Real(scale));
    for (int l = 0; l < dim && order >= 2; ++l) {
      auto second = alpha;
      ++second[l];
      result.hessian[k][l] = detail::row(K, index(second), Real(k == l ? 2 : 1) / (Real(scale) * Real(scale)));
    }
    // C is symmetric: (C^-1)^T = C^-1 moves to the left factor.
    const Matrix derivative = first.transpose() * s.pW_k[k] - factor.solve(s.C_k[k] * first).transpose() * s.pW;
    result.differentiated_gradient[k] = detail::row(derivative, 0, 1 / Real(scale));
  }
  return result;
}

} // namespace dense_ssph
