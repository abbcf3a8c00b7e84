#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace meshless::linear_algebra {

enum class Krylov {
  bicgstab, ///< van der Vorst 1992
  gmres,    ///< Saad, Schultz 1986, started anew after 50 iterations
};

struct KrylovDescription {
  Krylov krylov;
  const char *name;
  const char *meaning;
};

/// Every Krylov method by its name.
std::span<const KrylovDescription> krylov_table();
const char *to_text(Krylov krylov);
/// @throws std::invalid_argument for an unknown name, listing those there are
Krylov krylov_of(std::string_view name);

/// y = operator x; x and y do not overlap.
using LinearOperator = std::function<void(std::span<const double> x, std::span<double> y)>;

/// When an iteration ends: the same for every method and preconditioner.
struct KrylovTolerance {
  /// Wanted |b - A x| / (|A| |x| + |b|) in the maximum norm. What is a hundred times larger is accepted, since rounding
  /// keeps some systems from more; ten times where iterations have run out, which more might have helped.
  double backward_error = 1e-15;
  int max_iterations = 300;
};

struct KrylovResult {
  std::vector<double> solution; ///< the best there was
  bool converged = false;
  int iterations = 0;
  /// Starts anew from the true residual, since the backward error of the solution was not yet the wanted one.
  int n_restarts = 0;
  double backward_error = 0; ///< of the solution, from its true residual
  /// Estimate of the solution's error |x - x*|_2 / |x|_2 by tightening: |x - x'|_2 / |x|_2 times the ratio of both
  /// backward errors, where x' is the last iterate whose backward error was more than a hundred times the wanted one.
  double algebraic_error = 0;
};

/// Solves A x = b from x = 0, preconditioned from the right. The iteration starts anew from the true residual until the
/// backward error is the wanted one, or does not fall tenfold.
/// @param norm |A| in the maximum norm
KrylovResult solve_krylov(Krylov krylov, const LinearOperator &matrix, double norm,
                          const LinearOperator &preconditioner, std::span<const double> right_hand_side,
                          const KrylovTolerance &tolerance = {});

} // namespace meshless::linear_algebra
