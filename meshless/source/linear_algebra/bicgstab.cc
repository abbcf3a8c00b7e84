#include "krylov_iteration.h"

#include <algorithm>
#include <cmath>

namespace meshless::linear_algebra {

namespace {

using Vector = std::vector<double>;

/// All vectors are allocated once.
class BiCgStab final : public KrylovIteration {
public:
  BiCgStab(const KrylovSystem &system, std::size_t n) : system_(system) {
    for (Vector *v : {&shadow_, &direction_, &image_, &half_, &half_image_, &preconditioned_})
      v->resize(n);
  }

  int run(Vector &x, Vector &residual, Vector &loose, int most) override {
    const double first = std::sqrt(dot(residual, residual));
    // Iterations after which a system that converges has lowered its residual a hundredfold.
    const int patience = std::max(1, system_.tolerance.max_iterations / 3);
    shadow_ = residual;
    std::fill(direction_.begin(), direction_.end(), 0.0);
    std::fill(image_.begin(), image_.end(), 0.0);
    double rho = 1;
    double alpha = 1;
    double omega = 1;
    double error = 1;
    const std::size_t n = x.size();
    for (int k = 1; k <= most; ++k) {
      if (error > system_.loose())
        loose = x;
      const double next_rho = dot(shadow_, residual);
      const double beta = k == 1 ? 0 : next_rho / rho * (alpha / omega);
      rho = next_rho;
      for (std::size_t i = 0; i < n; ++i)
        direction_[i] = residual[i] + beta * (direction_[i] - omega * image_[i]);
      system_.preconditioner(direction_, preconditioned_);
      system_.matrix(preconditioned_, image_);
      alpha = rho / dot(shadow_, image_);
      if (!std::isfinite(alpha))
        return k;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * preconditioned_[i];
        half_[i] = residual[i] - alpha * image_[i];
      }
      system_.preconditioner(half_, preconditioned_);
      system_.matrix(preconditioned_, half_image_);
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
      error = largest_residual / (system_.norm * largest_x + system_.norm_b);
      if (!(error > system_.tolerance.backward_error) || omega == 0)
        return k;
      if (k == patience && !(std::sqrt(dot(residual, residual)) < .01 * first))
        return k;
    }
    return most;
  }

private:
  const KrylovSystem &system_;
  Vector shadow_;
  Vector direction_;
  Vector image_;
  Vector half_;
  Vector half_image_;
  Vector preconditioned_;
};

} // namespace

std::unique_ptr<KrylovIteration> make_bicgstab(const KrylovSystem &system, std::size_t n) {
  return std::make_unique<BiCgStab>(system, n);
}

} // namespace meshless::linear_algebra
