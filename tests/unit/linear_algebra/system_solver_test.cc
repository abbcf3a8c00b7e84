// The iterative solver for systems of particles: against sparse LU and known solutions, what it gives up, and who
// solves what.

#include "meshless/linear_algebra/iterative_solver.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/system_solver.h"
#include "unit/linear_algebra/wide_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace {

using namespace meshless::linear_algebra;

using wide_rows_sample::balanced_centre;
using wide_rows_sample::wavy;
using wide_rows_sample::wide_rows;

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

/// A cubic patch of 98 unknowns once ended after all iterations with 83 times the wanted error, and passed for solved.
TEST(IterativeSolver, that_runs_out_of_iterations_has_not_converged) {
  const auto matrix = wide_rows(40, balanced_centre());
  const auto expected = wavy(static_cast<std::size_t>(matrix.n_rows()));
  std::vector<double> b(expected.size());
  matrix.multiply(expected, b);
  PreconditionedSystem system(matrix, {.preconditioner = Preconditioner::ilu0});
  const double wanted = 1e-12;
  int n_near = 0;
  for (int most = 1; most <= 100; ++most) {
    const auto result = system.solve(Krylov::gmres, b, {.backward_error = wanted, .max_iterations = most});
    const double error = backward_error(matrix, result.solution, b);
    if (result.iterations < most)
      break;
    EXPECT_EQ(result.converged, error < 10 * wanted) << most << " iterations: " << error;
    n_near += error > 10 * wanted && error < 100 * wanted;
  }
  EXPECT_GT(n_near, 0);
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

/// What cannot be reached is tried for as long as the error falls tenfold: from the true residual each time.
TEST(IterativeSolver, counts_how_often_it_starts_anew) {
  const auto matrix = wide_rows(20, balanced_centre());
  const auto expected = wavy(static_cast<std::size_t>(matrix.n_rows()));
  std::vector<double> b(expected.size());
  matrix.multiply(expected, b);
  IterativeSettings loose;
  loose.tolerance.backward_error = 1e-6;
  IterativeSettings unreachable;
  unreachable.tolerance.backward_error = 1e-17; // below rounding; a hundred times that is accepted
  const auto easy = solve_iteratively(matrix, b, loose);
  const auto hard = solve_iteratively(matrix, b, unreachable);
  ASSERT_TRUE(easy);
  ASSERT_TRUE(hard);
  EXPECT_EQ(easy->n_restarts, 0);
  EXPECT_GE(hard->n_restarts, 1);
  EXPECT_EQ(solve_system(matrix, b, SystemSolver::direct).n_restarts, 0);
}

/// Two particles are one aggregate; the sum of all entries of each direction is 0, so that the coarse system is
/// singular and the matrix is not: det (1 3; -5 1) = 16.
TEST(IterativeSolver, leaves_a_singular_coarse_system_out_and_says_so) {
  SparseRows matrix(4);
  for (std::int64_t d = 0; d < 2; ++d)
    matrix.append_row(std::vector<std::int64_t>{d, 2 + d}, std::vector<double>{1, 3});
  for (std::int64_t d = 0; d < 2; ++d)
    matrix.append_row(std::vector<std::int64_t>{d, 2 + d}, std::vector<double>{-5, 1});
  const std::vector<double> b{4, 7, -4, -3}; // of 1, 1, 1, 2
  for (const bool coarse : {true, false}) {
    IterativeSettings settings;
    settings.preconditioner.preconditioner = coarse ? Preconditioner::ilu0_coarse : Preconditioner::ilu0;
    const auto result = solve_iteratively(matrix, b, settings);
    ASSERT_TRUE(result);
    EXPECT_EQ(result->coarse_left_out, coarse);
    const double expected[] = {1, 1, 1, 2};
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_NEAR(result->solution[i], expected[i], 1e-14) << i;
  }
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
  EXPECT_THROW(solve_system(matrix, std::vector<double>{1, 2, 3, 4}, SystemSolver::bicgstab), SolveError);
}

TEST(IterativeSolver, refuses_matrices_without_blocks) {
  SparseRows matrix(1);
  matrix.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1});
  EXPECT_THROW(solve_iteratively(matrix, std::vector<double>{1}), std::invalid_argument);
}

TEST(SystemSolver, automatic_iterates_from_two_hundred_unknowns_up) {
  for (const auto &[n, iterates] : {std::pair{9, false}, std::pair{10, true}}) { // 162 and 200
    const auto matrix = wide_rows(n, balanced_centre());
    const auto expected = wavy(static_cast<std::size_t>(matrix.n_rows()));
    std::vector<double> b(expected.size());
    matrix.multiply(expected, b);
    const auto automatic = solve_system(matrix, b, SystemSolver::automatic);
    EXPECT_EQ(automatic.iterations > 0, iterates);
    EXPECT_FALSE(automatic.fell_back);
    EXPECT_LE(automatic.backward_error, 2e-15);
    EXPECT_EQ(solve_system(matrix, b, SystemSolver::direct).iterations, 0);
    EXPECT_GT(solve_system(matrix, b, SystemSolver::bicgstab).iterations, 0);
    EXPECT_EQ(solve_system(matrix, b, SystemSolver::bicgstab, 3).iterations, 0) << "no blocks of two";
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
  const auto result = solve_system(matrix, b, SystemSolver::bicgstab);
  EXPECT_TRUE(result.fell_back);
  EXPECT_EQ(result.iterations, 0);
  for (std::size_t i = 0; i < b.size(); ++i)
    EXPECT_NEAR(result.solution[i], expected[i], 1e-12) << i;
}

} // namespace
