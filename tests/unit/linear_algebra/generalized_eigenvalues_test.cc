// Eigenvalues of pairs of sparse matrices that are known by construction.

#include "meshless/linear_algebra/generalized_eigenvalues.h"
#include "meshless/linear_algebra/sparse_lu.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace meshless::linear_algebra;
using Complex = std::complex<double>;

SparseRows rows_of(const Eigen::MatrixXd &dense) {
  SparseRows rows(dense.cols());
  std::vector<std::int64_t> columns;
  for (std::int64_t j = 0; j < dense.cols(); ++j)
    columns.push_back(j);
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    const Eigen::VectorXd row = dense.row(i);
    rows.append_row(columns, {row.data(), static_cast<std::size_t>(row.size())});
  }
  return rows;
}

/// A well-conditioned matrix: entries at random beside a diagonal of n.
Eigen::MatrixXd mixing(int n, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::MatrixXd m = Eigen::MatrixXd::Identity(n, n) * std::sqrt(n);
  for (Eigen::Index k = 0; k < m.size(); ++k)
    m.data()[k] += static_cast<double>(random()) / 4294967296.0 - 0.5;
  return m;
}

/// K = P B Q, M = P C Q, with B a diagonal of the values and a 2 x 2 block of a +- b i at its end, C the identity.
struct Pair {
  SparseRows stiffness, mass;
};
Pair pair(const std::vector<double> &values, Complex last, int n_empty) {
  const int n_real = static_cast<int>(values.size());
  const int n = n_real + 2 + n_empty;
  Eigen::MatrixXd b = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd c = Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i < n_real; ++i)
    b(i, i) = values[static_cast<std::size_t>(i)];
  b.block(n_real, n_real, 2, 2) << last.real(), last.imag(), -last.imag(), last.real();
  for (int i = n_real + 2; i < n; ++i)
    c(i, i) = 0;
  const Eigen::MatrixXd p = mixing(n, 1), q = mixing(n, 2);
  return {rows_of(p * b * q), rows_of(p * c * q)};
}

/// eps times the condition of the factors, about 10 each, and of the eigenvectors.
constexpr double tolerance = 1e-11;

TEST(GeneralizedEigenvalues, AllOfAPairAreFoundAndInfiniteOnesLeftOut) {
  const auto [k, m] = pair({0, 0, 0, 1, 2.5, 7}, {3, 0.5}, 2);
  const auto found = generalized_eigenvalues(k, m, -0.3);
  const std::vector<Complex> expected{0, 0, 0, 1, 2.5, {3, -0.5}, {3, 0.5}, 7};
  // Those of a triple zero may be a complex pair of rounding size.
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(std::abs(found[i] - expected[i]), tolerance) << i;
}

TEST(GeneralizedEigenvalues, TheNearestAreFoundRepeatedOnesToo) {
  std::vector<double> values{0, 0, 0};
  for (int i = 1; i <= 120; ++i)
    values.push_back(i * i);
  const auto [k, m] = pair(values, {2.5, 0.25}, 3);
  const auto found = nearest_eigenvalues(k, m, -0.3, 8);
  const std::vector<Complex> expected{0, 0, 0, 1, {2.5, -0.25}, {2.5, 0.25}, 4, 9};
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
    EXPECT_LT(std::abs(found[i] - expected[i]), 1e-9) << i;
}

TEST(GeneralizedEigenvalues, BadInputIsRefused) {
  const auto [k, m] = pair({1, 2}, {3, 1}, 0);
  EXPECT_THROW(generalized_eigenvalues(k, rows_of(Eigen::MatrixXd::Identity(3, 3)), 0), std::invalid_argument);
  EXPECT_THROW(nearest_eigenvalues(k, m, 0, 0), std::invalid_argument);
  EXPECT_THROW(nearest_eigenvalues(k, m, 0, 100), std::invalid_argument);
  Eigen::MatrixXd singular = Eigen::MatrixXd::Zero(3, 3);
  singular(0, 0) = 1;
  EXPECT_ANY_THROW(generalized_eigenvalues(rows_of(singular), rows_of(Eigen::MatrixXd::Zero(3, 3)), 1));
}

} // namespace
