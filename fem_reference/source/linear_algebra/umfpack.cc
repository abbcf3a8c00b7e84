#include "direct_solvers.h"

#include "fem_reference/errors.h"

#include <array>

#include <fmt/format.h>
#include <suitesparse/umfpack.h>

namespace fem_reference::linear_algebra {
namespace {
struct FullMatrix {
  std::vector<SuiteSparse_long> start;
  std::vector<SuiteSparse_long> rows;
  std::vector<double> values;
};

/// Both triangles, columns sorted: first the mirrored rows above the diagonal, then the stored part.
FullMatrix expand(const BlockMatrix &matrix) {
  std::vector<int> lower_start;
  std::vector<int> lower_rows;
  matrix.scalar_pattern(lower_start, lower_rows);
  const auto n = static_cast<std::size_t>(matrix.n_rows());
  FullMatrix full;
  full.start.assign(n + 1, 0);
  for (std::size_t j = 0; j < n; ++j)
    for (int k = lower_start[j]; k < lower_start[j + 1]; ++k) {
      ++full.start[j + 1];
      if (lower_rows[k] != static_cast<int>(j))
        ++full.start[lower_rows[k] + 1];
    }
  for (std::size_t j = 0; j < n; ++j)
    full.start[j + 1] += full.start[j];
  full.rows.resize(full.start[n]);
  full.values.resize(full.start[n]);
  std::vector<SuiteSparse_long> next(full.start.begin(), full.start.end() - 1);
  // Column j is complete above its diagonal when the loop reaches it.
  for (std::size_t j = 0; j < n; ++j)
    for (int k = lower_start[j]; k < lower_start[j + 1]; ++k) {
      const int i = lower_rows[k];
      const double value = matrix.values[k];
      full.rows[next[j]] = i;
      full.values[next[j]++] = value;
      if (i != static_cast<int>(j)) {
        full.rows[next[i]] = static_cast<SuiteSparse_long>(j);
        full.values[next[i]++] = value;
      }
    }
  return full;
}

void check(SuiteSparse_long status, const char *step) {
  if (status == UMFPACK_WARNING_singular_matrix)
    throw PivotFailure{-1, "UMFPACK found a zero pivot"};
  if (status == UMFPACK_ERROR_out_of_memory)
    throw SolveFailure(fmt::format("UMFPACK: out of memory in {}", step));
  if (status != UMFPACK_OK)
    throw SolveFailure(fmt::format("UMFPACK: error {} in {}", status, step));
}

class LuFactors : public DirectSolver {
public:
  explicit LuFactors(const BlockMatrix &matrix) : matrix_(expand(matrix)), n_rows_(matrix.n_rows()) {
    umfpack_dl_defaults(control_.data());
    control_[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    control_[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
    control_[UMFPACK_IRSTEP] = 0; // refinement is the caller's
  }
  ~LuFactors() override {
    umfpack_dl_free_symbolic(&symbolic_);
    umfpack_dl_free_numeric(&numeric_);
  }
  /// Apart from the constructor, so that the destructor frees what a failure leaves.
  void factorise();
  std::vector<double> solve(std::span<const double> right_hand_side) override;

private:
  FullMatrix matrix_; // UMFPACK's substitution asks for it
  SuiteSparse_long n_rows_;
  std::array<double, UMFPACK_CONTROL> control_{};
  void *symbolic_ = nullptr;
  void *numeric_ = nullptr;
};

void LuFactors::factorise() {
  const SuiteSparse_long n = n_rows_;
  std::array<double, UMFPACK_INFO> info{};
  const auto *start = matrix_.start.data();
  const auto *rows = matrix_.rows.data();
  const auto *values = matrix_.values.data();
  const auto symbolic_status = umfpack_dl_symbolic(n, n, start, rows, values, &symbolic_, control_.data(), info.data());
  check(symbolic_status, "ordering");
  const auto numeric_status =
      umfpack_dl_numeric(start, rows, values, symbolic_, &numeric_, control_.data(), info.data());
  check(numeric_status, "factorisation");
  // The ratio of the extreme pivots, as for Cholesky after squaring.
  if (!(info[UMFPACK_RCOND] > 1e-14))
    throw PivotFailure{-1, fmt::format("the reciprocal condition number is about {:.1e}", info[UMFPACK_RCOND])};
}

std::vector<double> LuFactors::solve(std::span<const double> right_hand_side) {
  std::array<double, UMFPACK_INFO> info{};
  std::vector<double> solution(right_hand_side.size());
  const auto status = umfpack_dl_solve(UMFPACK_A, matrix_.start.data(), matrix_.rows.data(), matrix_.values.data(),
                                       solution.data(), right_hand_side.data(), numeric_, control_.data(), info.data());
  check(status, "substitution");
  return solution;
}
} // namespace

std::unique_ptr<DirectSolver> factorise_umfpack(const BlockMatrix &matrix) {
  auto solver = std::make_unique<LuFactors>(matrix);
  solver->factorise();
  return solver;
}
} // namespace fem_reference::linear_algebra
