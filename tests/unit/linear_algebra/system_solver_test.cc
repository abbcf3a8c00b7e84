// The iterative solver for systems of particles: against sparse LU and known solutions, what it gives up, and who
// solves what.

#include "meshless/linear_algebra/iterative_solver.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/system_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

using namespace meshless::linear_algebra;

/// A non-symmetric operator of wide rows on an n x n grid of particles with two unknowns each: a smooth kernel of
/// radius 2.5 with a dominant centre, and a coupling of both unknowns. `shuffled`: particles are numbered without
/// order.
SparseRows wide_rows(std::int64_t n, double centre, bool shuffled = false) {
  const auto number = [&](std::int64_t i, std::int64_t j) {
    const std::int64_t k = i * n + j;
    return shuffled ? (k * 7919) % (n * n) : k; // 7919 is prime and divides no n used here
  };
  std::vector<std::int64_t> where_i(static_cast<std::size_t>(n * n));
  std::vector<std::int64_t> where_j(where_i.size());
  for (std::int64_t i = 0; i < n; ++i)
    for (std::int64_t j = 0; j < n; ++j) {
      where_i[static_cast<std::size_t>(number(i, j))] = i;
      where_j[static_cast<std::size_t>(number(i, j))] = j;
    }
  SparseRows matrix(2 * n * n);
  for (std::size_t k = 0; k < where_i.size(); ++k) {
    const std::int64_t i = where_i[k];
    const std::int64_t j = where_j[k];
    std::vector<std::pair<std::int64_t, std::pair<double, double>>> row; // column, diagonal part, coupling
    for (std::int64_t di = -2; di <= 2; ++di)
      for (std::int64_t dj = -2; dj <= 2; ++dj) {
        if (i + di < 0 || i + di >= n || j + dj < 0 || j + dj >= n)
          continue;
        const double r2 = double(di * di + dj * dj);
        const double value = r2 == 0 ? centre : -std::exp(-r2) * (1 + .1 * double(di));
        row.push_back({number(i + di, j + dj), {value, .2 * double(di * dj) * std::exp(-r2)}});
      }
    std::sort(row.begin(), row.end());
    for (std::int64_t d = 0; d < 2; ++d) {
      std::vector<std::int64_t> columns;
      std::vector<double> values;
      for (const auto &[column, value] : row)
        for (std::int64_t e = 0; e < 2; ++e) {
          columns.push_back(2 * column + e);
          values.push_back(d == e ? value.first : value.second);
        }
      matrix.append_row(columns, values);
    }
  }
  return matrix;
}

/// The centre that makes the rows inside sum to zero, as those of an operator without supports do.
double balanced_centre() {
  double sum = 0;
  for (int di = -2; di <= 2; ++di)
    for (int dj = -2; dj <= 2; ++dj)
      if (di != 0 || dj != 0)
        sum += std::exp(-double(di * di + dj * dj));
  return sum;
}

std::vector<double> wavy(std::size_t n) {
  std::vector<double> x(n);
  for (std::size_t i = 0; i < n; ++i)
    x[i] = std::sin(.37 * double(i)) + .1 * std::cos(11. * double(i));
  return x;
}

TEST(IterativeSolver, finds_the_known_solution_in_any_numbering) {
  for (const bool shuffled : {false, true}) {
    const auto matrix = wide_rows(40, balanced_centre(), shuffled);
    const auto expected = wavy(static_cast<std::size_t>(matrix.n_rows()));
    std::vector<double> b(expected.size());
    matrix.multiply(expected, b);
    const auto result = solve_iteratively(matrix, b);
    ASSERT_TRUE(result);
    EXPECT_GT(result->iterations, 1);
    EXPECT_LE(backward_error(matrix, result->solution, b), 2e-15);
    EXPECT_GT(result->reciprocal_condition, 0);
    EXPECT_LE(result->reciprocal_condition, 1);
    const auto lu = solve_lu(matrix, b);
    for (std::size_t i = 0; i < b.size(); ++i) {
      EXPECT_NEAR(result->solution[i], expected[i], 1e-11) << i;
      EXPECT_NEAR(result->solution[i], lu.solution[i], 1e-11) << i;
    }
  }
}

TEST(IterativeSolver, no_load_no_solution) {
  const auto matrix = wide_rows(10, 5);
  const std::vector<double> zero(static_cast<std::size_t>(matrix.n_rows()), 0.0);
  const auto result = solve_iteratively(matrix, zero);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->iterations, 0);
  EXPECT_EQ(result->solution, zero);
}

/// Two bodies that do not touch: the search for an order starts anew.
TEST(IterativeSolver, takes_parts_that_do_not_hang_together) {
  const auto one = wide_rows(12, balanced_centre());
  SparseRows both(2 * one.n_columns());
  for (const std::int64_t shift : {std::int64_t{0}, one.n_columns()})
    for (std::size_t row = 0; row < static_cast<std::size_t>(one.n_rows()); ++row) {
      std::vector<std::int64_t> columns;
      std::vector<double> values;
      for (auto k = one.offsets()[row]; k < one.offsets()[row + 1]; ++k) {
        columns.push_back(one.columns()[static_cast<std::size_t>(k)] + shift);
        values.push_back(one.values()[static_cast<std::size_t>(k)]);
      }
      both.append_row(columns, values);
    }
  const auto expected = wavy(static_cast<std::size_t>(both.n_rows()));
  std::vector<double> b(expected.size());
  both.multiply(expected, b);
  const auto result = solve_iteratively(both, b);
  ASSERT_TRUE(result);
  for (std::size_t i = 0; i < b.size(); ++i)
    EXPECT_NEAR(result->solution[i], expected[i], 1e-11) << i;
}

/// 2 x 2 blocks on the diagonal alone; the second is singular.
TEST(IterativeSolver, gives_up_what_has_no_pivot) {
  SparseRows matrix(4);
  const std::vector<std::int64_t> first{0, 1};
  const std::vector<std::int64_t> second{2, 3};
  matrix.append_row(first, std::vector<double>{2, 1});
  matrix.append_row(first, std::vector<double>{1, 2});
  matrix.append_row(second, std::vector<double>{1, 1});
  matrix.append_row(second, std::vector<double>{1, 1});
  EXPECT_FALSE(solve_iteratively(matrix, std::vector<double>{1, 2, 3, 4}));
  EXPECT_THROW(solve_system(matrix, std::vector<double>{1, 2, 3, 4}, SystemSolver::iterative), SolveError);
}

TEST(IterativeSolver, refuses_matrices_without_blocks) {
  SparseRows matrix(1);
  matrix.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1});
  EXPECT_THROW(solve_iteratively(matrix, std::vector<double>{1}), std::invalid_argument);
}

TEST(SystemSolver, automatic_iterates_from_a_thousand_unknowns_up) {
  for (const auto &[n, iterates] : {std::pair{22, false}, std::pair{23, true}}) { // 968 and 1058
    const auto matrix = wide_rows(n, balanced_centre());
    const auto expected = wavy(static_cast<std::size_t>(matrix.n_rows()));
    std::vector<double> b(expected.size());
    matrix.multiply(expected, b);
    const auto automatic = solve_system(matrix, b, SystemSolver::automatic);
    EXPECT_EQ(automatic.iterations > 0, iterates);
    EXPECT_FALSE(automatic.fell_back);
    EXPECT_LE(automatic.backward_error, 2e-15);
    EXPECT_EQ(solve_system(matrix, b, SystemSolver::direct).iterations, 0);
    EXPECT_GT(solve_system(matrix, b, SystemSolver::iterative).iterations, 0);
    EXPECT_EQ(solve_system(matrix, b, SystemSolver::iterative, 3).iterations, 0) << "no blocks of two";
  }
}

/// A cyclic shift with a tiny diagonal: the incomplete factors are useless, BiCGSTAB stagnates, sparse LU solves it.
TEST(SystemSolver, falls_back_to_sparse_lu_and_says_so) {
  constexpr std::int64_t n = 400;
  SparseRows matrix(n);
  for (std::int64_t i = 0; i < n; ++i) {
    const std::int64_t next = (i + 2) % n;
    std::vector<std::pair<std::int64_t, double>> row{{i, 1e-3}, {next, 1.0}};
    std::sort(row.begin(), row.end());
    matrix.append_row(std::vector<std::int64_t>{row[0].first, row[1].first},
                      std::vector<double>{row[0].second, row[1].second});
  }
  const auto expected = wavy(n);
  std::vector<double> b(expected.size());
  matrix.multiply(expected, b);
  const auto result = solve_system(matrix, b, SystemSolver::iterative);
  EXPECT_TRUE(result.fell_back);
  EXPECT_EQ(result.iterations, 0);
  for (std::size_t i = 0; i < b.size(); ++i)
    EXPECT_NEAR(result.solution[i], expected[i], 1e-12) << i;
}

} // namespace
