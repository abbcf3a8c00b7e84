#include "meshless/linear_algebra/sparse_lu.h"

#include <suitesparse/umfpack.h>

#include <fmt/format.h>

#include <cmath>

namespace meshless::linear_algebra {

namespace {

void check(long status, const char *step) {
  if (status == UMFPACK_WARNING_singular_matrix)
    throw SolveError("the system of equations is singular");
  if (status == UMFPACK_ERROR_out_of_memory)
    throw SolveError(fmt::format("out of memory in the {} of the sparse LU", step));
  if (status != UMFPACK_OK)
    throw SolveError(fmt::format("the {} of the sparse LU failed (UMFPACK status {})", step, status));
}

} // namespace

/// Frees UMFPACK's objects whatever happens.
struct SparseLu::Handles {
  void *symbolic = nullptr;
  void *numeric = nullptr;
  std::vector<SuiteSparse_long> columns; ///< of the matrix, in the width of its offsets, as UMFPACK wants both
  double reciprocal_condition = 0;
  std::size_t bytes = 0;

  Handles() = default;
  Handles(const Handles &) = delete;
  Handles &operator=(const Handles &) = delete;
  ~Handles() {
    umfpack_dl_free_symbolic(&symbolic);
    umfpack_dl_free_numeric(&numeric);
  }
};

SparseLu::SparseLu(const SparseRows &matrix, Ordering ordering)
    : matrix_(matrix), handles_(std::make_unique<Handles>()) {
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));
  // Compressed rows of A are compressed columns of A^T: factorise that and solve with its transpose.
  const auto *offsets = reinterpret_cast<const SuiteSparse_long *>(matrix.offsets().data());
  handles_->columns.assign(matrix.columns().begin(), matrix.columns().end());
  const auto *columns = handles_->columns.data();
  const double *values = matrix.values().data();
  const SuiteSparse_long n = matrix.n_rows();

  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];
  umfpack_dl_defaults(control);
  if (ordering == Ordering::rcm) {
    const auto order = order_of(matrix, ordering, 1);
    const std::vector<SuiteSparse_long> given(order.begin(), order.end());
    check(umfpack_dl_qsymbolic(n, n, offsets, columns, values, given.data(), &handles_->symbolic, control, info),
          "ordering");
  } else {
    control[UMFPACK_ORDERING] = ordering == Ordering::metis ? UMFPACK_ORDERING_METIS
                                : ordering == Ordering::amd ? UMFPACK_ORDERING_AMD
                                                            : UMFPACK_ORDERING_NONE;
    check(umfpack_dl_symbolic(n, n, offsets, columns, values, &handles_->symbolic, control, info), "ordering");
  }
  check(umfpack_dl_numeric(offsets, columns, values, handles_->symbolic, &handles_->numeric, control, info),
        "factorisation");
  handles_->reciprocal_condition = info[UMFPACK_RCOND];
  handles_->bytes = static_cast<std::size_t>(info[UMFPACK_NUMERIC_SIZE] * info[UMFPACK_SIZE_OF_UNIT]);
}

SparseLu::~SparseLu() = default;

double SparseLu::reciprocal_condition() const { return handles_->reciprocal_condition; }

std::size_t SparseLu::bytes() const { return handles_->bytes; }

void SparseLu::solve(std::span<const double> right_hand_side, std::span<double> solution, Refinement refinement) const {
  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];
  umfpack_dl_defaults(control);
  if (refinement == Refinement::none)
    control[UMFPACK_IRSTEP] = 0;
  check(umfpack_dl_solve(UMFPACK_At, reinterpret_cast<const SuiteSparse_long *>(matrix_.offsets().data()),
                         handles_->columns.data(), matrix_.values().data(), solution.data(), right_hand_side.data(),
                         handles_->numeric, control, info),
        "solution");
  for (std::size_t i = 0; i < solution.size(); ++i)
    if (!std::isfinite(solution[i]))
      throw SolveError(fmt::format("unknown {} of the solution is not finite", i));
}

LuResult solve_lu(const SparseRows &matrix, std::span<const double> right_hand_side, Ordering ordering) {
  return solve_lu(SparseLu(matrix, ordering), matrix, right_hand_side);
}

LuResult solve_lu(const SparseLu &lu, const SparseRows &matrix, std::span<const double> right_hand_side) {
  LuResult result;
  result.reciprocal_condition = lu.reciprocal_condition();
  result.solution.resize(static_cast<std::size_t>(matrix.n_rows()));
  std::vector<double> unrefined(result.solution.size());
  lu.solve(right_hand_side, unrefined, SparseLu::Refinement::none);
  lu.solve(right_hand_side, result.solution);
  if (const double loose_error = backward_error(matrix, unrefined, right_hand_side); loose_error > 0)
    result.algebraic_error = relative_distance(unrefined, result.solution) *
                             backward_error(matrix, result.solution, right_hand_side) / loose_error;
  return result;
}

} // namespace meshless::linear_algebra
