#include "meshless/linear_algebra/sparse_lu.h"

#include <suitesparse/umfpack.h>

#include <fmt/format.h>

#include <cmath>

namespace meshless::linear_algebra {

namespace {

/// Frees UMFPACK's objects whatever happens.
struct Handles {
  void *symbolic = nullptr;
  void *numeric = nullptr;

  Handles() = default;
  Handles(const Handles &) = delete;
  Handles &operator=(const Handles &) = delete;
  ~Handles() {
    umfpack_dl_free_symbolic(&symbolic);
    umfpack_dl_free_numeric(&numeric);
  }
};

void check(long status, const char *step) {
  if (status == UMFPACK_WARNING_singular_matrix)
    throw SolveError("the system of equations is singular");
  if (status == UMFPACK_ERROR_out_of_memory)
    throw SolveError(fmt::format("out of memory in the {} of the sparse LU", step));
  if (status != UMFPACK_OK)
    throw SolveError(fmt::format("the {} of the sparse LU failed (UMFPACK status {})", step, status));
}

} // namespace

LuResult solve_lu(const SparseRows &matrix, std::span<const double> right_hand_side) {
  static_assert(sizeof(SuiteSparse_long) == sizeof(std::int64_t));
  // Compressed rows of A are compressed columns of A^T: factorise that and solve with its transpose.
  const auto *offsets = reinterpret_cast<const SuiteSparse_long *>(matrix.offsets().data());
  const auto *columns = reinterpret_cast<const SuiteSparse_long *>(matrix.columns().data());
  const double *values = matrix.values().data();
  const SuiteSparse_long n = matrix.n_rows();

  double control[UMFPACK_CONTROL];
  double info[UMFPACK_INFO];
  umfpack_dl_defaults(control);
  Handles handles;
  check(umfpack_dl_symbolic(n, n, offsets, columns, values, &handles.symbolic, control, info), "ordering");
  check(umfpack_dl_numeric(offsets, columns, values, handles.symbolic, &handles.numeric, control, info),
        "factorisation");
  LuResult result;
  result.reciprocal_condition = info[UMFPACK_RCOND];
  result.solution.resize(static_cast<std::size_t>(n));
  check(umfpack_dl_solve(UMFPACK_At, offsets, columns, values, result.solution.data(), right_hand_side.data(),
                         handles.numeric, control, info),
        "solution");
  for (std::size_t i = 0; i < result.solution.size(); ++i)
    if (!std::isfinite(result.solution[i]))
      throw SolveError(fmt::format("unknown {} of the solution is not finite", i));
  return result;
}

} // namespace meshless::linear_algebra
