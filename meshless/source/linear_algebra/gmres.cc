#include "krylov_iteration.h"

#include <algorithm>
#include <cmath>

namespace meshless::linear_algebra {

namespace {

using Vector = std::vector<double>;

constexpr std::size_t cycle_length = 50;
constexpr std::size_t look_every = 10;

double largest(std::span<const double> x) {
  double result = 0;
  for (const double value : x)
    result = std::max(result, std::abs(value));
  return result;
}

/// GMRES(50), preconditioned from the right, modified Gram-Schmidt, Givens rotations.
class Gmres final : public KrylovIteration {
public:
  Gmres(const KrylovSystem &system, std::size_t n)
      : system_(system), sum_(n), preconditioned_(n), basis_(1, Vector(n)) {
    for (Vector *v : {&cosines_, &sines_, &right_})
      v->resize(cycle_length + 1);
  }

  int run(Vector &x, Vector &residual, Vector &loose, int most) override {
    int iterations = 0;
    while (iterations < most) {
      const double first = std::sqrt(dot(residual, residual));
      if (!(first > 0) || !std::isfinite(first))
        return iterations;
      const auto steps = std::min(cycle_length, static_cast<std::size_t>(most - iterations));
      const std::size_t k = cycle(x, residual, loose, first, steps);
      iterations += static_cast<int>(k);
      const double left = std::abs(right_[k]);
      const bool done = left <= target(system_.tolerance.backward_error, x, residual, first);
      const bool stalls = !(left < .9 * first);
      if (done || stalls)
        return iterations;
      // The residual that the basis says is left costs one product less than the true one, and is less accurate; the
      // next cycle needs the true one.
      system_.matrix(update_, sum_);
      for (std::size_t i = 0; i < residual.size(); ++i)
        residual[i] -= sum_[i];
    }
    return iterations;
  }

private:
  /// |residual|_2 at which the backward error is about `error`, if the residual is spread as the one given.
  double target(double error, const Vector &x, const Vector &residual, double norm_of_residual) const {
    return error * (system_.norm * largest(x) + system_.norm_b) * norm_of_residual / largest(residual);
  }

  double &entry(std::size_t row, std::size_t column) { return hessenberg_[column * (cycle_length + 1) + row]; }

  /// At most `steps` iterations; x += the correction.
  std::size_t cycle(Vector &x, const Vector &residual, Vector &loose, double first, std::size_t steps) {
    hessenberg_.assign((cycle_length + 1) * cycle_length, 0.0);
    std::fill(right_.begin(), right_.end(), 0.0);
    right_[0] = first;
    for (std::size_t i = 0; i < residual.size(); ++i)
      basis_[0][i] = residual[i] / first;
    double wanted = target(system_.tolerance.backward_error, x, residual, first);
    double above = target(system_.loose(), x, residual, first);
    std::size_t k_loose = 0;
    std::size_t k = 0;
    while (k < steps && std::abs(right_[k]) > wanted) {
      if (k > 0 && k % look_every == 0) { // how large x becomes is part of the backward error
        trial_ = x;
        add_correction(k, trial_);
        wanted = target(system_.tolerance.backward_error, trial_, residual, first);
        above = target(system_.loose(), trial_, residual, first);
      }
      if (std::abs(right_[k]) > above)
        k_loose = k;
      const bool breakdown = !extend(k);
      ++k;
      if (breakdown)
        break;
    }
    if (first > above) {
      loose = x;
      add_correction(k_loose, loose);
    }
    add_correction(k, x);
    return k;
  }

  /// One Arnoldi step, and the rotation of its column. False if the space cannot grow.
  bool extend(std::size_t k) {
    if (basis_.size() < k + 2)
      basis_.emplace_back(sum_.size());
    Vector &next = basis_[k + 1];
    system_.preconditioner(basis_[k], preconditioned_);
    system_.matrix(preconditioned_, next);
    for (std::size_t j = 0; j <= k; ++j) {
      const double h = dot(next, basis_[j]);
      entry(j, k) = h;
      for (std::size_t i = 0; i < next.size(); ++i)
        next[i] -= h * basis_[j][i];
    }
    const double length = std::sqrt(dot(next, next));
    for (std::size_t j = 0; j < k; ++j) {
      const double a = entry(j, k);
      const double b = entry(j + 1, k);
      entry(j, k) = cosines_[j] * a + sines_[j] * b;
      entry(j + 1, k) = cosines_[j] * b - sines_[j] * a;
    }
    const double radius = std::hypot(entry(k, k), length);
    cosines_[k] = radius > 0 ? entry(k, k) / radius : 1;
    sines_[k] = radius > 0 ? length / radius : 0;
    entry(k, k) = radius;
    right_[k + 1] = -sines_[k] * right_[k];
    right_[k] *= cosines_[k];
    if (!(length > 0) || !std::isfinite(length))
      return false;
    for (double &value : next)
      value /= length;
    return true;
  }

  /// x += M^-1 V y with the first k columns; leaves the correction in update_.
  void add_correction(std::size_t k, Vector &x) {
    Vector y(right_.begin(), right_.begin() + static_cast<std::ptrdiff_t>(k));
    // right_[k - 1] of a shorter basis has not been rotated further: the entries before k are the same for both.
    for (std::size_t i = k; i-- > 0;) {
      for (std::size_t j = i + 1; j < k; ++j)
        y[i] -= entry(i, j) * y[j];
      y[i] = entry(i, i) != 0 ? y[i] / entry(i, i) : 0;
    }
    std::fill(sum_.begin(), sum_.end(), 0.0);
    for (std::size_t j = 0; j < k; ++j)
      for (std::size_t i = 0; i < sum_.size(); ++i)
        sum_[i] += y[j] * basis_[j][i];
    update_.resize(sum_.size());
    system_.preconditioner(sum_, update_);
    for (std::size_t i = 0; i < x.size(); ++i)
      x[i] += update_[i];
  }

  const KrylovSystem &system_;
  Vector sum_;
  Vector preconditioned_;
  Vector update_;
  Vector trial_;
  std::vector<Vector> basis_;
  Vector hessenberg_; ///< by columns
  Vector cosines_;
  Vector sines_;
  Vector right_;
};

} // namespace

std::unique_ptr<KrylovIteration> make_gmres(const KrylovSystem &system, std::size_t n) {
  return std::make_unique<Gmres>(system, n);
}

} // namespace meshless::linear_algebra
