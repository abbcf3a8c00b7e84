// Sparse rows and their LU against dense matrices of Eigen.

#include "meshless/linear_algebra/sparse_lu.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace {

using namespace meshless::linear_algebra;
using refusal::mentions;
using refusal::message_of;

/// long double: more exact than what is tested, and no SIMD code, at which g++ 12 warns when sanitizing.
using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

SparseRows rows_of(const Matrix &dense) {
  SparseRows rows(dense.cols());
  std::vector<std::int64_t> columns(static_cast<std::size_t>(dense.cols()));
  std::vector<double> values(columns.size());
  for (Eigen::Index i = 0; i < dense.rows(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      columns[j] = static_cast<std::int64_t>(j);
      values[j] = static_cast<double>(dense(i, static_cast<Eigen::Index>(j)));
    }
    rows.append_row(columns, values);
  }
  return rows;
}

/// Unsymmetric, a fraction of the entries filled, row i multiplied by up to 10^decades.
Matrix random_matrix(int n, double fill, double decades, std::uint64_t seed) {
  sample_clouds::Uniform random(seed);
  Matrix matrix = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j)
      if (random() < fill)
        matrix(i, j) = random.between(-1, 1);
    matrix(i, (3 * i + 1) % n) += 1; // n is no multiple of 3: a permutation, so that no row is empty
    matrix.row(i) *= std::pow(10, decades * random());
  }
  return matrix.unaryExpr([](long double x) { return static_cast<long double>(static_cast<double>(x)); });
}

std::vector<double> random_vector(int n, std::uint64_t seed) {
  sample_clouds::Uniform random(seed);
  std::vector<double> vector(static_cast<std::size_t>(n));
  for (double &x : vector)
    x = random.between(-1, 1);
  return vector;
}

Vector dense_of(const std::vector<double> &v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())).cast<long double>();
}

double largest(const Vector &v) { return static_cast<double>(v.cwiseAbs().maxCoeff()); }

/// Largest sum of absolute entries of a row.
double norm(const Matrix &m) { return static_cast<double>(m.cwiseAbs().rowwise().sum().maxCoeff()); }

TEST(SparseRows, refuse_columns_beyond_32_bits) {
  EXPECT_NO_THROW(SparseRows((std::int64_t{1} << 31) - 1));
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([] { SparseRows(std::int64_t{1} << 31); }), {"2147483648"}));
}

TEST(SparseRows, keep_entries_that_are_not_zero) {
  SparseRows rows(5);
  rows.reserve(10);
  const std::vector<std::int64_t> columns{0, 2, 4};
  rows.append_row(columns, std::vector<double>{1, 0, -3});
  rows.append_row(std::vector<std::int64_t>{}, {});
  rows.append_row(columns, std::vector<double>{-0., 2, 0});
  EXPECT_EQ(rows.n_rows(), 3);
  EXPECT_EQ(rows.n_columns(), 5);
  EXPECT_EQ(rows.nonzeros(), 3);
  EXPECT_TRUE(std::ranges::equal(rows.offsets(), std::vector<std::int64_t>{0, 2, 2, 3}));
  EXPECT_TRUE(std::ranges::equal(rows.columns(), std::vector<std::int64_t>{0, 4, 2}));
  EXPECT_TRUE(std::ranges::equal(rows.values(), std::vector<double>{1, -3, 2}));
}

TEST(SparseRows, multiply_as_a_dense_matrix) {
  const auto dense = random_matrix(50, .2, 3, 1);
  const auto x = random_vector(50, 2);
  std::vector<double> y(50);
  rows_of(dense).multiply(x, y);
  // Sums of at most 50 products.
  EXPECT_LT(largest(dense_of(y) - dense * dense_of(x)), 50 * epsilon * norm(dense));
}

TEST(SparseRows, equilibrate_to_a_largest_entry_of_one) {
  const auto dense = random_matrix(40, .3, 12, 3);
  auto rows = rows_of(dense);
  const auto divisors = rows.equilibrate_rows();
  for (std::size_t i = 0; i < divisors.size(); ++i) {
    EXPECT_EQ(divisors[i], dense.row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff());
    double largest_left = 0;
    for (auto k = rows.offsets()[i]; k < rows.offsets()[i + 1]; ++k)
      largest_left = std::max(largest_left, std::abs(rows.values()[static_cast<std::size_t>(k)]));
    EXPECT_EQ(largest_left, 1);
  }
}

TEST(SparseRows, name_a_row_that_is_zero_or_not_finite) {
  const std::vector<std::int64_t> columns{0, 1};
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    SparseRows rows(2);
    rows.append_row(columns, std::vector<double>{1, 2});
    rows.append_row(columns, std::vector<double>{1, bad});
    EXPECT_TRUE(mentions(message_of<std::runtime_error>([&] { rows.equilibrate_rows(); }), {"row 1", "not finite"}));
  }
  SparseRows rows(2);
  rows.append_row(columns, std::vector<double>{0, 0});
  EXPECT_TRUE(mentions(message_of<std::runtime_error>([&] { rows.equilibrate_rows(); }), {"row 0", "zero"}));
}

TEST(SparseLu, agrees_with_dense_lu) {
  for (const int n : {1, 2, 5, 20, 100, 151})
    for (const double fill : {.02, .2, 1.}) {
      const auto dense = random_matrix(n, fill, 2, static_cast<std::uint64_t>(n));
      const auto b = random_vector(n, 7);
      const Eigen::PartialPivLU<Matrix> lu(dense);
      const Vector expected = lu.solve(dense_of(b));
      const auto rows = rows_of(dense);
      const auto result = solve_lu(rows, b);
      // Backward stable: eps times the condition number, with a factor n.
      const double condition = norm(lu.inverse()) * norm(dense);
      EXPECT_LT(largest(dense_of(result.solution) - expected), n * epsilon * condition * largest(expected))
          << n << " " << fill;
      EXPECT_LT(backward_error(rows, result.solution, b), 4 * epsilon);
      EXPECT_GT(result.reciprocal_condition, 0);
    }
}

TEST(SparseLu, solves_rows_and_not_columns) {
  // A matrix far from its transpose: x1 = 1, x0 = 10 - 4 x1.
  SparseRows rows(2);
  rows.append_row(std::vector<std::int64_t>{0, 1}, std::vector<double>{1, 4});
  rows.append_row(std::vector<std::int64_t>{1}, std::vector<double>{2});
  const auto result = solve_lu(rows, std::vector<double>{10, 2});
  EXPECT_EQ(result.solution, (std::vector<double>{6, 1}));
}

TEST(SparseLu, refuses_singular_matrices) {
  SparseRows equal_rows(2);
  SparseRows empty_column(2);
  for (int i = 0; i < 2; ++i) {
    equal_rows.append_row(std::vector<std::int64_t>{0, 1}, std::vector<double>{1, 2});
    empty_column.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1. + i});
  }
  const std::vector<double> b{1, 1};
  for (const auto *matrix : {&equal_rows, &empty_column})
    EXPECT_TRUE(mentions(message_of<SolveError>([&] { solve_lu(*matrix, b); }), {"singular"}));
}

TEST(SparseLu, refuses_a_matrix_that_is_not_square) {
  SparseRows wide(3);
  SparseRows tall(1);
  for (int i = 0; i < 2; ++i) {
    wide.append_row(std::vector<std::int64_t>{0, 2}, std::vector<double>{1, 2. + i});
    tall.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1});
  }
  const std::vector<double> b{1, 1};
  EXPECT_THROW(solve_lu(wide, b), SolveError);
  EXPECT_THROW(solve_lu(tall, b), SolveError);
}

TEST(SparseLu, refuses_what_is_not_finite) {
  SparseRows rows(1);
  rows.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1});
  EXPECT_THROW(solve_lu(rows, std::vector<double>{std::nan("")}), SolveError);
}

TEST(BackwardError, is_relative_to_matrix_and_right_hand_side) {
  SparseRows rows(2);
  rows.append_row(std::vector<std::int64_t>{0, 1}, std::vector<double>{3, -1});
  rows.append_row(std::vector<std::int64_t>{1}, std::vector<double>{2});
  // A x = (5, 2), residual (1, 0); |A| = 4, |x| = 2, |b| = 6.
  EXPECT_DOUBLE_EQ(backward_error(rows, std::vector<double>{2, 1}, std::vector<double>{6, 2}), 1. / 14);
  EXPECT_EQ(backward_error(rows, std::vector<double>{0, 0}, std::vector<double>{0, 0}), 0);
}

} // namespace
