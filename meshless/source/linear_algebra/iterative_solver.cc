#include "meshless/linear_algebra/iterative_solver.h"

#include "block_rows.h"
#include "coarse_correction.h"
#include "incomplete_lu.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace meshless::linear_algebra {

namespace {

constexpr int max_starts = 8;
constexpr double wanted_backward_error = 1e-15;
constexpr double accepted_backward_error = 1e-13;
/// Iterations after which a system that converges has lowered its residual a hundredfold; in all it takes about 40.
constexpr int patience = 100;

using Vector = std::vector<double>;

double dot(const Vector &a, const Vector &b) {
  double sums[4] = {0, 0, 0, 0}; // one sum would wait for itself
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k)
      sums[k] += a[i + k] * b[i + k];
  for (; i < a.size(); ++i)
    sums[0] += a[i] * b[i];
  return sums[0] + sums[1] + (sums[2] + sums[3]);
}

/// One start of BiCGSTAB, preconditioned from the right; all vectors are allocated once.
class BiCgStab {
public:
  /// @param norm, norm_b of A and b, for the backward error
  BiCgStab(const BlockRows &matrix, CoarseCorrection &preconditioner, double norm, double norm_b)
      : matrix_(matrix), preconditioner_(preconditioner), norm_(norm), norm_b_(norm_b) {
    for (Vector *v : {&shadow_, &direction_, &image_, &half_, &half_image_, &preconditioned_})
      v->resize(2 * matrix.n_rows());
  }

  /// x += an approximate solution of A y = residual, which becomes what the recurrence says is left. Ends when that is
  /// the wanted backward error, or when there is no hope.
  /// @return iterations
  int run(Vector &x, Vector &residual) {
    const double first = std::sqrt(dot(residual, residual));
    shadow_ = residual;
    std::fill(direction_.begin(), direction_.end(), 0.0);
    std::fill(image_.begin(), image_.end(), 0.0);
    double rho = 1;
    double alpha = 1;
    double omega = 1;
    const std::size_t n = x.size();
    for (int k = 1; k < 3 * patience; ++k) {
      const double next_rho = dot(shadow_, residual);
      const double beta = k == 1 ? 0 : next_rho / rho * (alpha / omega);
      rho = next_rho;
      for (std::size_t i = 0; i < n; ++i)
        direction_[i] = residual[i] + beta * (direction_[i] - omega * image_[i]);
      preconditioner_.apply(direction_, preconditioned_);
      matrix_.multiply(preconditioned_, image_);
      alpha = rho / dot(shadow_, image_);
      if (!std::isfinite(alpha))
        return k;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * preconditioned_[i];
        half_[i] = residual[i] - alpha * image_[i];
      }
      preconditioner_.apply(half_, preconditioned_);
      matrix_.multiply(preconditioned_, half_image_);
      const double squared = dot(half_image_, half_image_);
      omega = squared > 0 ? dot(half_image_, half_) / squared : 0;
      double largest_x = 0;
      double largest_residual = 0;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += omega * preconditioned_[i];
        residual[i] = half_[i] - omega * half_image_[i];
        largest_x = std::max(largest_x, std::abs(x[i]));
        largest_residual = std::max(largest_residual, std::abs(residual[i]));
      }
      if (!(largest_residual > wanted_backward_error * (norm_ * largest_x + norm_b_)) || omega == 0)
        return k;
      if (k == patience && !(std::sqrt(dot(residual, residual)) < .01 * first))
        return k;
    }
    return 3 * patience;
  }

private:
  const BlockRows &matrix_;
  CoarseCorrection &preconditioner_;
  double norm_;
  double norm_b_;
  Vector shadow_;
  Vector direction_;
  Vector image_;
  Vector half_;
  Vector half_image_;
  Vector preconditioned_;
};

} // namespace

std::optional<IterativeResult> solve_iteratively(const SparseRows &matrix, std::span<const double> right_hand_side,
                                                 double drop) {
  if (matrix.n_rows() != matrix.n_columns() || matrix.n_rows() % 2 != 0)
    throw std::invalid_argument(
        fmt::format("a matrix of {} rows and {} columns has no blocks of 2 x 2", matrix.n_rows(), matrix.n_columns()));
  const auto order = reverse_cuthill_mckee(matrix);
  const BlockRows blocks(matrix, order);
  const IncompleteLu factors(blocks, drop);
  if (!factors.regular())
    return {};

  Vector b(right_hand_side.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      b[2 * k + d] = right_hand_side[2 * std::size_t{order[k]} + d];
  Vector x(b.size(), 0.0);
  Vector best = x;
  Vector residual = b;
  Vector image(b.size());
  const double norm = maximum_norm(matrix);
  const double norm_b = maximum_norm(b);
  CoarseCorrection preconditioner(blocks, factors);
  BiCgStab iteration(blocks, preconditioner, norm, norm_b);
  IterativeResult result;
  double least_error = norm_b > 0 ? 1 : 0;
  for (int start = 0; start < max_starts && least_error > wanted_backward_error; ++start) {
    result.iterations += iteration.run(x, residual);
    blocks.multiply(x, image);
    for (std::size_t i = 0; i < b.size(); ++i)
      residual[i] = b[i] - image[i];
    const double error = maximum_norm(residual) / (norm * maximum_norm(x) + norm_b);
    if (!(error < least_error)) // also if it is not a number
      break;
    const bool falls = error < .1 * least_error;
    least_error = error;
    best = x;
    if (!falls)
      break;
  }
  if (!(least_error < accepted_backward_error))
    return {};
  result.reciprocal_condition = factors.pivot_ratio();
  result.solution.resize(b.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      result.solution[2 * std::size_t{order[k]} + d] = best[2 * k + d];
  return result;
}

} // namespace meshless::linear_algebra
