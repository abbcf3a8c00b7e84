#include "direct_solvers.h"

#include "fem_reference/errors.h"

#include <array>

#include <fmt/format.h>
#include <suitesparse/umfpack.h>

namespace fem_reference::linear_algebra
{
namespace
{
struct FullMatrix
{
  std::vector<SuiteSparse_long> start;
  std::vector<SuiteSparse_long> rows;
  std::vector<double> values;
};

/// Both triangles, columns sorted: first the mirrored rows above the diagonal, then the stored part.
FullMatrix expand(const BlockMatrix &matrix)
{
  std::vector<int> lower_start;
  std::vector<int> lower_rows;
  matrix.scalar_pattern(lower_start, lower_rows);
  const auto n = static_cast<std::size_t>(matrix.n_rows());
  FullMatrix full;
  full.start.assign(n + 1, 0);
  for (std::size_t j = 0; j < n; ++j)
    for (int k = lower_start[j]; k < lower_start[j + 1]; ++k)
    {
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
    for (int k = lower_start[j]; k < lower_start[j + 1]; ++k)
    {
      const int i = lower_rows[k];
      const double value = matrix.values[k];
      full.rows[next[j]] = i;
      full.values[next[j]++] = value;
      if (i != static_cast<int>(j))
      {
        full.rows[next[i]] = static_cast<SuiteSparse_long>(j);
        full.values[next[i]++] = value;
      }
    }
  return full;
}

void check(SuiteSparse_long status, const char *step)
{
  if (status == UMFPACK_WARNING_singular_matrix)
    throw PivotFailure{-1, "UMFPACK found a zero pivot"};
  if (status == UMFPACK_ERROR_out_of_memory)
    throw SolveFailure(fmt::format("UMFPACK: out of memory in {}", step));
  if (status != UMFPACK_OK)
    throw SolveFailure(fmt::format("UMFPACK: error {} in {}", status, step));
}

/// UMFPACK's factor objects, freed in any case.
struct Factors
{
  Factors() = default;
  Factors(const Factors &) = delete;
  Factors &operator=(const Factors &) = delete;
  ~Factors()
  {
    umfpack_dl_free_symbolic(&symbolic);
    umfpack_dl_free_numeric(&numeric);
  }
  void *symbolic = nullptr;
  void *numeric = nullptr;
};
} // namespace

std::vector<double> solve_umfpack(const BlockMatrix &matrix, std::span<const double> right_hand_side)
{
  const FullMatrix full = expand(matrix);
  const SuiteSparse_long n = matrix.n_rows();
  const auto *start = full.start.data();
  const auto *rows = full.rows.data();
  const auto *values = full.values.data();
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  umfpack_dl_defaults(control.data());
  control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
  control[UMFPACK_ORDERING] = UMFPACK_ORDERING_AMD;
  control[UMFPACK_IRSTEP] = 0; // as Cholesky: no refinement

  Factors factors;
  check(umfpack_dl_symbolic(n, n, start, rows, values, &factors.symbolic, control.data(), info.data()),
        "ordering");
  check(umfpack_dl_numeric(
          start, rows, values, factors.symbolic, &factors.numeric, control.data(), info.data()),
        "factorisation");
  // The ratio is that of pivots, as in Cholesky after squaring.
  if (!(info[UMFPACK_RCOND] > 1e-14))
    throw PivotFailure{-1, fmt::format("the reciprocal condition number is about {:.1e}", info[UMFPACK_RCOND])};
  std::vector<double> solution(right_hand_side.size());
  check(umfpack_dl_solve(UMFPACK_A,
                         start,
                         rows,
                         values,
                         solution.data(),
                         right_hand_side.data(),
                         factors.numeric,
                         control.data(),
                         info.data()),
        "substitution");
  return solution;
}
} // namespace fem_reference::linear_algebra
