#include "meshless/linear_algebra/krylov.h"

#include "krylov_iteration.h"
#include "names.h"

#include "meshless/linear_algebra/sparse_rows.h"

namespace meshless::linear_algebra {

namespace {

constexpr KrylovDescription table[] = {
    {Krylov::bicgstab, "bicgstab", "BiCGSTAB"},
    {Krylov::gmres, "gmres", "GMRES, started anew after 50 iterations"},
};

constexpr int max_starts = 8;

} // namespace

std::span<const KrylovDescription> krylov_table() { return table; }

const char *to_text(Krylov krylov) { return entry_of(krylov_table(), &KrylovDescription::krylov, krylov).name; }

Krylov krylov_of(std::string_view name) { return entry_named(krylov_table(), name, "Krylov method").krylov; }

double dot(std::span<const double> a, std::span<const double> b) {
  double sums[4] = {0, 0, 0, 0}; // one sum would wait for itself
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k)
      sums[k] += a[i + k] * b[i + k];
  for (; i < a.size(); ++i)
    sums[0] += a[i] * b[i];
  return sums[0] + sums[1] + (sums[2] + sums[3]);
}

KrylovResult solve_krylov(Krylov krylov, const LinearOperator &matrix, double norm,
                          const LinearOperator &preconditioner, std::span<const double> right_hand_side,
                          const KrylovTolerance &tolerance) {
  const std::size_t n = right_hand_side.size();
  const double norm_b = maximum_norm(right_hand_side);
  const KrylovSystem system{matrix, preconditioner, norm, norm_b, tolerance};
  const auto iteration = krylov == Krylov::gmres ? make_gmres(system, n) : make_bicgstab(system, n);
  std::vector<double> x(n, 0.0);
  std::vector<double> residual(right_hand_side.begin(), right_hand_side.end());
  std::vector<double> image(n);
  std::vector<double> loose(x);
  KrylovResult result;
  result.solution = x;
  result.backward_error = norm_b > 0 ? 1 : 0;
  for (int start = 0; start < max_starts && result.backward_error > tolerance.backward_error &&
                      result.iterations < tolerance.max_iterations;
       ++start) {
    result.n_restarts = start;
    result.iterations += iteration->run(x, residual, loose, tolerance.max_iterations - result.iterations);
    matrix(x, image);
    for (std::size_t i = 0; i < n; ++i)
      residual[i] = right_hand_side[i] - image[i];
    const double error = maximum_norm(residual) / (norm * maximum_norm(x) + norm_b);
    if (!(error < result.backward_error)) // also if it is not a number
      break;
    const bool falls = error < .1 * result.backward_error;
    result.backward_error = error;
    result.solution = x;
    if (!falls)
      break;
  }
  const bool ran_out = result.iterations >= tolerance.max_iterations;
  result.converged = result.backward_error < (ran_out ? 10 : 100) * tolerance.backward_error;
  matrix(loose, image);
  for (std::size_t i = 0; i < n; ++i)
    residual[i] = right_hand_side[i] - image[i];
  if (const double loose_error = maximum_norm(residual) / (norm * maximum_norm(loose) + norm_b); loose_error > 0)
    result.algebraic_error = relative_distance(loose, result.solution) * result.backward_error / loose_error;
  return result;
}

} // namespace meshless::linear_algebra
