// Orderings, preconditioners and Krylov methods: every alternative of the tables against one known solution and sparse
// LU, what an ordering is, and what is refused.

#include "meshless/linear_algebra/iterative_solver.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/system_solver.h"
#include "unit/linear_algebra/refusal.h"
#include "unit/linear_algebra/wide_rows.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace {

using namespace meshless::linear_algebra;
using refusal::mentions;
using refusal::message_of;
using wide_rows_sample::balanced_centre;
using wide_rows_sample::wavy;
using wide_rows_sample::wide_rows;

/// A system whose solution is known, particles numbered without order.
struct Known {
  SparseRows matrix = wide_rows(26, balanced_centre(), true);
  std::vector<double> solution = wavy(static_cast<std::size_t>(matrix.n_rows()));
  std::vector<double> right_hand_side = std::vector<double>(solution.size());

  Known() { matrix.multiply(solution, right_hand_side); }

  void expect_solved(const std::vector<double> &x, const std::string &by) const {
    // Backward error 1e-15 times a condition below 1e4, as the iterative solver's own test has it.
    for (std::size_t i = 0; i < x.size(); ++i)
      ASSERT_NEAR(x[i], solution[i], 1e-11) << by << ", unknown " << i;
  }
};

/// Largest distance of two places that are coupled.
std::int64_t bandwidth(const SparseRows &matrix, const std::vector<std::uint32_t> &order) {
  std::vector<std::int64_t> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    place[order[k]] = static_cast<std::int64_t>(k);
  std::int64_t widest = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(matrix.n_rows()); ++row)
    for (auto k = matrix.offsets()[row]; k < matrix.offsets()[row + 1]; ++k)
      widest = std::max(widest,
                        std::abs(place[row / 2] -
                                 place[static_cast<std::size_t>(matrix.columns()[static_cast<std::size_t>(k)]) / 2]));
  return widest;
}

TEST(Ordering, is_a_permutation_of_the_groups_and_the_same_each_time) {
  const Known known;
  for (const auto &[ordering, name, meaning] : ordering_table())
    for (const std::size_t group : {1, 2, 4}) {
      const auto order = order_of(known.matrix, ordering, group);
      EXPECT_EQ(order, order_of(known.matrix, ordering, group)) << name;
      auto sorted = order;
      std::sort(sorted.begin(), sorted.end());
      std::vector<std::uint32_t> all(static_cast<std::size_t>(known.matrix.n_rows()) / group);
      std::iota(all.begin(), all.end(), 0U);
      EXPECT_EQ(sorted, all) << name << " in groups of " << group;
    }
}

/// Places of an n x n grid within 2 of each other are coupled: breadth first from a corner, three levels of at most
/// 2 n particles are between two of them.
TEST(Ordering, reverse_cuthill_mckee_makes_a_narrow_band_of_any_numbering) {
  const Known known; // 26 x 26
  EXPECT_GT(bandwidth(known.matrix, order_of(known.matrix, Ordering::natural)), 26 * 26 / 2);
  EXPECT_LE(bandwidth(known.matrix, order_of(known.matrix, Ordering::rcm)), 3 * 2 * 26);
}

/// Of a grid in a random numbering the orderings leave less fill than none, which is what they are for.
TEST(Ordering, lowers_the_fill_of_sparse_lu) {
  const Known known;
  const std::size_t natural = SparseLu(known.matrix, Ordering::natural).bytes();
  for (const Ordering ordering : {Ordering::rcm, Ordering::amd, Ordering::metis})
    EXPECT_LT(SparseLu(known.matrix, ordering).bytes(), natural) << to_text(ordering);
}

TEST(Ordering, is_found_by_its_name) {
  for (const auto &[ordering, name, meaning] : ordering_table()) {
    EXPECT_EQ(ordering_of(name), ordering);
    EXPECT_STREQ(to_text(ordering), name);
  }
  for (const auto &[preconditioner, name, meaning] : preconditioner_table()) {
    EXPECT_EQ(preconditioner_of(name), preconditioner);
    EXPECT_STREQ(to_text(preconditioner), name);
  }
  for (const auto &[krylov, name, meaning] : krylov_table()) {
    EXPECT_EQ(krylov_of(name), krylov);
    EXPECT_STREQ(to_text(krylov), name);
  }
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([] { ordering_of("colamd"); }),
                       {"no ordering 'colamd'", "natural", "rcm", "amd", "metis"}));
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([] { preconditioner_of("jacobi"); }), {"thinned+coarse"}));
  EXPECT_TRUE(mentions(message_of<std::invalid_argument>([] { krylov_of("cg"); }), {"gmres"}));
}

TEST(Ordering, refuses_groups_that_do_not_fit) {
  const auto matrix = wide_rows(4, 5);
  EXPECT_THROW(order_of(matrix, Ordering::rcm, 3), std::invalid_argument);
  EXPECT_THROW(order_of(matrix, Ordering::amd, 0), std::invalid_argument);
  SparseRows wide(3);
  wide.append_row(std::vector<std::int64_t>{0}, std::vector<double>{1});
  EXPECT_THROW(order_of(wide, Ordering::metis, 1), std::invalid_argument);
}

TEST(Alternatives, sparse_lu_of_every_ordering_finds_the_known_solution) {
  const Known known;
  for (const auto &[ordering, name, meaning] : ordering_table()) {
    const auto result = solve_lu(known.matrix, known.right_hand_side, ordering);
    known.expect_solved(result.solution, name);
    EXPECT_LE(result.algebraic_error, 1e-11) << name;
  }
}

TEST(Alternatives, every_iteration_finds_the_known_solution) {
  const Known known;
  for (const auto &krylov : krylov_table())
    for (const auto &preconditioner : preconditioner_table())
      for (const auto &ordering : ordering_table()) {
        const std::string by = fmt::format("{} {} {}", krylov.name, preconditioner.name, ordering.name);
        PreconditionedSystem system(known.matrix, {preconditioner.preconditioner, ordering.ordering});
        const auto result = system.solve(krylov.krylov, known.right_hand_side);
        ASSERT_TRUE(result.converged) << by;
        EXPECT_LE(result.backward_error, 2e-15) << by;
        EXPECT_GT(result.iterations, 1) << by;
        EXPECT_GT(system.bytes(), 0) << by;
        known.expect_solved(result.solution, by);
        EXPECT_EQ(result.solution, system.solve(krylov.krylov, known.right_hand_side).solution) << by << ", again";
      }
}

/// The coarse system is for motions of many particles, which factors alone do not see.
TEST(Alternatives, the_coarse_system_saves_iterations) {
  const Known known;
  const auto iterations = [&](Preconditioner preconditioner) {
    PreconditionedSystem system(known.matrix, {.preconditioner = preconditioner});
    return system.solve(Krylov::bicgstab, known.right_hand_side).iterations;
  };
  EXPECT_LT(iterations(Preconditioner::ilu0_coarse), iterations(Preconditioner::ilu0));
  EXPECT_LT(iterations(Preconditioner::thinned_coarse), iterations(Preconditioner::thinned));
  EXPECT_LT(iterations(Preconditioner::ilut_coarse), iterations(Preconditioner::ilut));
}

/// With nothing dropped and room for all fill, incomplete factors in single precision are the factors: what is left
/// after one iteration is their rounding.
TEST(Alternatives, ilut_without_dropping_is_a_factorisation) {
  const Known known;
  PreconditionedSystem system(known.matrix, {Preconditioner::ilut, Ordering::rcm, 0.0, 1e3});
  EXPECT_LE(system.solve(Krylov::bicgstab, known.right_hand_side).iterations, 3);
  PreconditionedSystem dropping(known.matrix, {Preconditioner::ilut, Ordering::rcm, 1e-2, 1e3});
  EXPECT_GT(dropping.solve(Krylov::bicgstab, known.right_hand_side).iterations, 3);
  EXPECT_LT(dropping.bytes(), system.bytes() / 2);
}

/// The estimate by tightening, against the true error at loose and tight tolerances.
TEST(Alternatives, the_algebraic_error_is_estimated_within_two_decades) {
  const Known known;
  for (const auto &krylov : krylov_table())
    for (const double tolerance : {1e-6, 1e-9, 1e-12}) {
      PreconditionedSystem system(known.matrix, {});
      const auto result = system.solve(krylov.krylov, known.right_hand_side, {.backward_error = tolerance});
      ASSERT_TRUE(result.converged);
      EXPECT_LE(result.backward_error, 100 * tolerance);
      const double error = relative_distance(result.solution, known.solution);
      EXPECT_LT(result.algebraic_error, 100 * error) << krylov.name << " " << tolerance;
      EXPECT_GT(result.algebraic_error, .01 * error) << krylov.name << " " << tolerance;
    }
}

TEST(Alternatives, every_one_refuses_a_singular_matrix_by_name) {
  SparseRows matrix(8); // blocks on the diagonal, all singular
  for (std::int64_t row = 0; row < 8; ++row)
    matrix.append_row(std::vector<std::int64_t>{row / 2 * 2, row / 2 * 2 + 1}, std::vector<double>{1, 1});
  const std::vector<double> b{1, 2, 3, 4, 5, 6, 7, 8};
  for (const auto &ordering : ordering_table()) {
    EXPECT_TRUE(mentions(message_of<SolveError>([&] { SparseLu(matrix, ordering.ordering); }), {"singular"}))
        << ordering.name;
    for (const auto &preconditioner : preconditioner_table()) {
      EXPECT_TRUE(mentions(message_of<SolveError>([&] {
                             PreconditionedSystem(matrix, {preconditioner.preconditioner, ordering.ordering});
                           }),
                           {"a pivot of the incomplete factors is singular"}))
          << preconditioner.name;
      for (const SystemSolver solver : {SystemSolver::bicgstab, SystemSolver::gmres}) {
        SolverRequest request(solver);
        request.preconditioner = preconditioner.preconditioner;
        request.ordering = ordering.ordering;
        EXPECT_TRUE(mentions(message_of<SolveError>([&] { solve_system(matrix, b, request); }), {"singular"}));
      }
    }
  }
}

/// A singular matrix whose blocks have inverses: no iteration may call what it finds a solution.
TEST(Alternatives, no_iteration_accepts_a_right_hand_side_outside_the_range) {
  const auto matrix = [] {
    SparseRows rows(200); // a chain without supports: the rows sum to zero
    for (std::int64_t row = 0; row < 200; ++row) {
      std::vector<std::int64_t> columns;
      std::vector<double> values;
      for (const std::int64_t column : {row - 2, row, row + 2})
        if (column >= 0 && column < 200) {
          columns.push_back(column);
          values.push_back(column == row ? (row < 2 || row >= 198 ? 1 : 2) : -1);
        }
      rows.append_row(columns, values);
    }
    return rows;
  }();
  const std::vector<double> pull(200, 1.0); // not in balance
  for (const auto &krylov : krylov_table())
    for (const auto &preconditioner : preconditioner_table()) {
      IterativeSettings settings;
      settings.krylov = krylov.krylov;
      settings.preconditioner.preconditioner = preconditioner.preconditioner;
      EXPECT_FALSE(solve_iteratively(matrix, pull, settings)) << krylov.name << " " << preconditioner.name;
    }
}

TEST(Alternatives, what_is_chosen_depends_on_the_size) {
  EXPECT_EQ(choose({}, least_unknowns_to_iterate - 2), SolverChoice{});
  const SolverChoice iteration{Krylov::bicgstab, Preconditioner::thinned_coarse, Ordering::rcm};
  EXPECT_EQ(choose({}, least_unknowns_to_iterate), iteration);
  EXPECT_FALSE(choose({}, 3000, 3).krylov) << "no blocks of two";
  EXPECT_EQ(choose(SystemSolver::direct, least_unknowns_to_dissect - 1).ordering, Ordering::amd);
  EXPECT_EQ(choose(SystemSolver::direct, least_unknowns_to_dissect).ordering, Ordering::metis);
  SolverRequest request(SystemSolver::gmres);
  request.ordering = Ordering::natural;
  request.preconditioner = Preconditioner::ilut;
  EXPECT_EQ(choose(request, 100), (SolverChoice{Krylov::gmres, Preconditioner::ilut, Ordering::natural}));
}

} // namespace
