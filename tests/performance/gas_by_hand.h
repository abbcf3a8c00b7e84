#pragma once

#include "meshless/hydrodynamics/gas_flow.h"
#include "meshless/kernels/cubic_spline.h"
#include "meshless/linear_algebra/aligned_vector.h"
#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace performance {

/// One step of an ideal gas with the cubic spline, summation density, h = eta m / rho and free ends, written by hand:
/// pressure and inertia, with further_effects = 1 Monaghan's viscosity, with 2 heat conduction too. Every loop over
/// the particles does all that can be done there; the only options are constants of the program; but for the step's
/// limit nothing is watched.
///
/// The pairs (i, i + k) of blocks of particles, as in PairRanges, which is the fastest arrangement that is known here.
template <int further_effects>
class GasByHand {
public:
  GasByHand(const meshless::hydrodynamics::GasParticles &particles, const meshless::hydrodynamics::GasFlow &flow,
            double eta, double gamma)
      : n_(particles.mass.size()), eta_(eta), gamma_(gamma) {
    const std::size_t all = n_ + reach + 2 * block;
    const double far = 1e6 * (particles.position.back() - particles.position.front());
    const auto fill = [&](Array &to, auto &&from, double elsewhere) {
      to.assign(all, elsewhere);
      std::copy(from.begin(), from.end(), to.begin());
    };
    fill(x_, particles.position, particles.position.back() + far);
    fill(v_, particles.velocity, 0);
    fill(e_, particles.energy, 1);
    fill(m_, particles.mass, 0);
    fill(h_, flow.smoothing_length(), 1e-3 * far);
    for (Array *zero : {&rho_, &p_, &c_, &f_, &a_, &w_, &q_, &heat_, &rate_, &pv_, &pe_})
      zero->assign(all, 0);
    rho_.assign(all, 1);
    least_.assign(all, 1e300);
    widths_.resize(n_ / block + 1);
    pv_ = v_;
    pe_ = e_;
    start_pairs();
    forces();
    for (std::size_t i = 0; i < n_; ++i)
      a_[i] = f_[i] / m_[i];
    work();
    for (std::size_t i = 0; i < n_; ++i)
      rate_[i] = power(places(), i) / m_[i];
  }

  [[gnu::noinline]] void step(double dt) {
    const Places at = places();
    const double half = 0.5 * dt;
    for (std::size_t i = 0; i < n_; ++i) {
      at.x[i] += half * at.v[i];
      at.pv[i] = at.v[i] + half * at.a[i];
      at.pe[i] = at.e[i] + half * at.rate[i];
    }
    start_pairs();
    forces();
    for (std::size_t i = 0; i < n_; ++i) {
      at.a[i] = at.f[i] / at.m[i];
      at.pv[i] = at.v[i] + half * at.a[i];
      at.v[i] += dt * at.a[i];
    }
    work();
    for (std::size_t i = 0; i < n_; ++i) {
      at.rate[i] = power(at, i) / at.m[i];
      at.e[i] += dt * at.rate[i];
      at.x[i] += half * at.v[i];
      at.h[i] = eta_ * at.m[i] / at.rho[i];
    }
    find_limit();
  }

  /// Of the particles but the first and the last.
  double stable_step() const { return limit_; }

  double position(std::size_t i) const { return x_[i]; }
  double energy(std::size_t i) const { return e_[i]; }

private:
  using Array = meshless::linear_algebra::AlignedVector;
  using Pack = meshless::linear_algebra::Pack;
  static constexpr std::size_t lanes = meshless::linear_algebra::n_lanes;
  static constexpr std::size_t block = 64;
  static constexpr std::size_t reach = 512;
  static constexpr bool viscous = further_effects >= 1;
  static constexpr bool conducting = further_effects >= 2;
  static constexpr meshless::kernels::CubicSpline kernel{};
  static constexpr double norm = 2.0 / 3;
  static constexpr double edge = 4 * (1 - 1e-12);
  static constexpr double alpha = 1, beta = 1, g1 = 0.1, g2 = 1, epsilon = 0.01;

  /// Addresses of the arrays, so that no store makes them to be read again.
  struct Places {
    double *x, *v, *e, *m, *h, *rho, *p, *c, *f, *a, *w, *q, *heat, *rate, *pv, *pe, *least;
  };
  Places places() {
    return {x_.data(),    v_.data(),    e_.data(),  m_.data(),  h_.data(),    rho_.data(),
            p_.data(),    c_.data(),    f_.data(),  a_.data(),  w_.data(),    q_.data(),
            heat_.data(), rate_.data(), pv_.data(), pe_.data(), least_.data()};
  }

  static Pack get(const double *from, std::size_t i) { return meshless::linear_algebra::load(from + i); }
  static void put(const Pack &value, double *to) { meshless::linear_algebra::store(value, to); }

  static double power(const Places &at, std::size_t i) {
    double sum = at.p[i] * at.w[i];
    if constexpr (viscous)
      sum += at.q[i];
    if constexpr (conducting)
      sum += at.heat[i];
    return sum;
  }

  /// min h / (c + 0.6 (alpha c + beta h dv / dx)): the step after this one is chosen by it in every scene.
  [[gnu::flatten]] void find_limit() {
    const Places at = places();
    Pack largest = 0;
    for (std::size_t i = 1; i + lanes < n_; i += lanes) {
      const Pack h = get(at.h, i);
      Pack inverse = (viscous ? 1 + 0.6 * alpha : 1) * get(at.c, i) / h;
      if constexpr (viscous) {
        const Pack before = (get(at.v, i - 1) - get(at.v, i)) / (get(at.x, i) - get(at.x, i - 1));
        const Pack after = (get(at.v, i) - get(at.v, i + 1)) / (get(at.x, i + 1) - get(at.x, i));
        inverse += 0.6 * beta * max(max(before, after), Pack(0));
      }
      largest = max(largest, inverse);
    }
    limit_ = 1 / std::experimental::hmax(largest);
  }

  /// Ranges of the pairs, and the density.
  [[gnu::flatten]] void start_pairs() {
    const Places at = places();
    using namespace meshless;
    double least = 1e300;
    for (std::size_t j = n_; j-- > 0;)
      at.least[j] = least = std::min(least, at.x[j] - at.h[j]);
    for (std::size_t i = 0; i < n_; ++i)
      at.rho[i] = at.m[i] * norm / at.h[i];
    std::size_t k = 1;
    std::size_t pairs = 0;
    double to_j[block];
    for (std::size_t b = 0; b * block < n_; ++b) {
      const std::size_t begin = b * block;
      const std::size_t end = std::min(begin + block, n_);
      const auto any = [&](std::size_t offset) {
        for (std::size_t i = begin; i < end; i += lanes)
          if (any_of(get(at.least, i + offset) < get(at.x, i) + get(at.h, i)))
            return true;
        return false;
      };
      while (k > 1 && !any(k))
        --k;
      while (any(k))
        ++k;
      widths_[b] = k;
      pairs += (k - 1) * block;
    }
    if (gradient_.size() < pairs) {
      gradient_.resize(pairs + pairs / 4);
      if constexpr (viscous)
        viscous_.resize(gradient_.size());
    }
    for (std::size_t b = 0; b * block < n_; ++b)
      for (std::size_t d = 1; d < widths_[b]; ++d) {
        const std::size_t begin = b * block;
        for (std::size_t l = 0; l < block; l += lanes) {
          const std::size_t i = begin + l;
          const Pack dx = get(at.x, i) - get(at.x, i + d);
          const Pack inverse = 1 / Pack(0.5 * (get(at.h, i) + get(at.h, i + d)));
          const Pack s = dx * dx * inverse * inverse;
          const Pack w = kernels::select(s < Pack(edge), Pack(norm * inverse * kernel.value(s)), Pack(0));
          put(get(at.rho, i) + get(at.m, i + d) * w, at.rho + i);
          put(get(at.m, i) * w, &to_j[l]);
        }
        for (std::size_t l = 0; l < block; l += lanes)
          put(get(at.rho, begin + d + l) + linear_algebra::load(to_j + l), at.rho + begin + d + l);
      }
  }

  [[gnu::flatten]] void forces() {
    const Places at = places();
    using namespace meshless;
    for (std::size_t i = 0; i < n_; i += lanes) {
      const Pack e = get(at.pe, i);
      put((gamma_ - 1) * e / get(at.rho, i), at.p + i); // p / rho^2
      put(kernels::square_root(Pack(gamma_ * (gamma_ - 1) * e)), at.c + i);
      put(0, at.f + i);
      put(0, at.w + i);
      if constexpr (viscous)
        put(0, at.q + i);
      if constexpr (conducting)
        put(0, at.heat + i);
    }
    double force[block];
    [[maybe_unused]] double heat[block];
    double *pair = gradient_.data();
    double *viscous_pair = viscous_.data();
    for (std::size_t b = 0; b * block < n_; ++b)
      for (std::size_t d = 1; d < widths_[b]; ++d, pair += block, viscous_pair += block) {
        const std::size_t begin = b * block;
        for (std::size_t l = 0; l < block; l += lanes) {
          const std::size_t i = begin + l;
          const std::size_t j = i + d;
          const Pack dx = get(at.x, i) - get(at.x, j);
          const Pack h = 0.5 * (get(at.h, i) + get(at.h, j));
          const Pack inverse = 1 / h;
          const Pack s = dx * dx * inverse * inverse;
          const Pack slope = kernels::select(
              s < Pack(edge),
              Pack(get(at.m, i) * get(at.m, j) * (norm * (inverse * inverse * inverse)) * kernel.slope(s) * dx),
              Pack(0));
          put(slope, pair + l);
          Pack f = slope * (get(at.p, i) + get(at.p, j));
          if constexpr (viscous) {
            const Pack dv = get(at.pv, i) - get(at.pv, j);
            const Pack c = 0.5 * (get(at.c, i) + get(at.c, j));
            const Pack rho = 0.5 * (get(at.rho, i) + get(at.rho, j));
            const Pack nearing = dx * dv;
            const Pack softened = dx * dx + epsilon * h * h;
            const Pack mu = h * nearing / softened;
            const Pack q =
                slope * kernels::select(nearing < Pack(0), Pack(mu * (beta * mu - alpha * c) / rho), Pack(0));
            put(q, viscous_pair + l);
            f += q;
            if constexpr (conducting) {
              const Pack flux =
                  2 * Pack(h * (g1 * c + g2 * abs(dv))) / rho * (get(at.pe, i) - get(at.pe, j)) * dx / softened;
              const Pack lost = slope * kernels::select(nearing < Pack(0), flux, Pack(0));
              put(lost, &heat[l]);
              put(get(at.heat, i) + lost, at.heat + i);
            }
          }
          put(f, &force[l]);
          put(get(at.f, i) - f, at.f + i);
        }
        for (std::size_t l = 0; l < block; l += lanes) {
          put(get(at.f, begin + d + l) + linear_algebra::load(force + l), at.f + begin + d + l);
        }
        if constexpr (conducting)
          for (std::size_t l = 0; l < block; l += lanes)
            put(get(at.heat, begin + d + l) - linear_algebra::load(heat + l), at.heat + begin + d + l);
      }
  }

  [[gnu::flatten]] void work() {
    const Places at = places();
    using namespace meshless;
    double to_j[block];
    [[maybe_unused]] double viscous_to_j[block];
    const double *pair = gradient_.data();
    const double *viscous_pair = viscous_.data();
    for (std::size_t b = 0; b * block < n_; ++b)
      for (std::size_t d = 1; d < widths_[b]; ++d, pair += block, viscous_pair += block) {
        const std::size_t begin = b * block;
        for (std::size_t l = 0; l < block; l += lanes) {
          const std::size_t i = begin + l;
          const Pack dv = get(at.pv, i) - get(at.pv, i + d);
          const Pack w = linear_algebra::load(pair + l) * dv;
          put(w, &to_j[l]);
          put(get(at.w, i) + w, at.w + i);
          if constexpr (viscous) {
            const Pack q = 0.5 * linear_algebra::load(viscous_pair + l) * dv;
            put(q, &viscous_to_j[l]);
            put(get(at.q, i) + q, at.q + i);
          }
        }
        for (std::size_t l = 0; l < block; l += lanes)
          put(get(at.w, begin + d + l) + linear_algebra::load(to_j + l), at.w + begin + d + l);
        if constexpr (viscous)
          for (std::size_t l = 0; l < block; l += lanes)
            put(get(at.q, begin + d + l) + linear_algebra::load(viscous_to_j + l), at.q + begin + d + l);
      }
  }

  std::size_t n_;
  double eta_, gamma_;
  double limit_ = 0;
  Array x_, v_, e_, m_, h_, rho_, p_, c_, f_, a_, w_, q_, heat_, rate_, pv_, pe_, least_;
  Array gradient_, viscous_;
  std::vector<std::size_t> widths_;
};

} // namespace performance
