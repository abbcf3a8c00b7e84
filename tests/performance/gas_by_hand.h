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
/// the particles does all that can be done there; the only options are constants of the program; nothing is watched.
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
      rate_[i] = power(i) / m_[i];
  }

  void step(double dt) {
    const double half = 0.5 * dt;
    for (std::size_t i = 0; i < n_; ++i) {
      x_[i] += half * v_[i];
      pv_[i] = v_[i] + half * a_[i];
      pe_[i] = e_[i] + half * rate_[i];
    }
    start_pairs();
    forces();
    for (std::size_t i = 0; i < n_; ++i) {
      a_[i] = f_[i] / m_[i];
      pv_[i] = v_[i] + half * a_[i];
      v_[i] += dt * a_[i];
    }
    work();
    for (std::size_t i = 0; i < n_; ++i) {
      rate_[i] = power(i) / m_[i];
      e_[i] += dt * rate_[i];
      x_[i] += half * v_[i];
      h_[i] = eta_ * m_[i] / rho_[i];
    }
  }

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

  static Pack get(const Array &from, std::size_t i) { return meshless::linear_algebra::load(&from[i]); }
  static void put(const Pack &value, double *to) { meshless::linear_algebra::store(value, to); }

  double power(std::size_t i) const {
    double sum = p_[i] * w_[i];
    if constexpr (viscous)
      sum += q_[i];
    if constexpr (conducting)
      sum += heat_[i];
    return sum;
  }

  /// Ranges of the pairs, and the density.
  void start_pairs() {
    using namespace meshless;
    double least = 1e300;
    for (std::size_t j = n_; j-- > 0;)
      least_[j] = least = std::min(least, x_[j] - h_[j]);
    for (std::size_t i = 0; i < n_; ++i)
      rho_[i] = m_[i] * norm / h_[i];
    std::size_t k = 1;
    std::size_t pairs = 0;
    double to_j[block];
    for (std::size_t b = 0; b * block < n_; ++b) {
      const std::size_t begin = b * block;
      const std::size_t end = std::min(begin + block, n_);
      const auto any = [&](std::size_t offset) {
        for (std::size_t i = begin; i < end; i += lanes)
          if (any_of(get(least_, i + offset) < get(x_, i) + get(h_, i)))
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
          const Pack dx = get(x_, i) - get(x_, i + d);
          const Pack inverse = 1 / Pack(0.5 * (get(h_, i) + get(h_, i + d)));
          const Pack s = dx * dx * inverse * inverse;
          const Pack w = kernels::select(s < Pack(edge), Pack(norm * inverse * kernel.value(s)), Pack(0));
          put(get(rho_, i) + get(m_, i + d) * w, &rho_[i]);
          put(get(m_, i) * w, &to_j[l]);
        }
        for (std::size_t l = 0; l < block; l += lanes)
          put(get(rho_, begin + d + l) + linear_algebra::load(to_j + l), &rho_[begin + d + l]);
      }
  }

  void forces() {
    using namespace meshless;
    for (std::size_t i = 0; i < n_; i += lanes) {
      const Pack e = get(pe_, i);
      put((gamma_ - 1) * e / get(rho_, i), &p_[i]); // p / rho^2
      if constexpr (viscous)
        put(kernels::square_root(Pack(gamma_ * (gamma_ - 1) * e)), &c_[i]);
      put(0, &f_[i]);
      put(0, &w_[i]);
      if constexpr (viscous)
        put(0, &q_[i]);
      if constexpr (conducting)
        put(0, &heat_[i]);
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
          const Pack dx = get(x_, i) - get(x_, j);
          const Pack h = 0.5 * (get(h_, i) + get(h_, j));
          const Pack inverse = 1 / h;
          const Pack s = dx * dx * inverse * inverse;
          const Pack slope = kernels::select(
              s < Pack(edge),
              Pack(get(m_, i) * get(m_, j) * (norm * (inverse * inverse * inverse)) * kernel.slope(s) * dx), Pack(0));
          put(slope, pair + l);
          Pack f = slope * (get(p_, i) + get(p_, j));
          if constexpr (viscous) {
            const Pack dv = get(pv_, i) - get(pv_, j);
            const Pack c = 0.5 * (get(c_, i) + get(c_, j));
            const Pack rho = 0.5 * (get(rho_, i) + get(rho_, j));
            const Pack nearing = dx * dv;
            const Pack softened = dx * dx + epsilon * h * h;
            const Pack mu = h * nearing / softened;
            const Pack q =
                slope * kernels::select(nearing < Pack(0), Pack(mu * (beta * mu - alpha * c) / rho), Pack(0));
            put(q, viscous_pair + l);
            f += q;
            if constexpr (conducting) {
              const Pack flux =
                  2 * Pack(h * (g1 * c + g2 * abs(dv))) / rho * (get(pe_, i) - get(pe_, j)) * dx / softened;
              const Pack lost = slope * kernels::select(nearing < Pack(0), flux, Pack(0));
              put(lost, &heat[l]);
              put(get(heat_, i) + lost, &heat_[i]);
            }
          }
          put(f, &force[l]);
          put(get(f_, i) - f, &f_[i]);
        }
        for (std::size_t l = 0; l < block; l += lanes) {
          put(get(f_, begin + d + l) + linear_algebra::load(force + l), &f_[begin + d + l]);
        }
        if constexpr (conducting)
          for (std::size_t l = 0; l < block; l += lanes)
            put(get(heat_, begin + d + l) - linear_algebra::load(heat + l), &heat_[begin + d + l]);
      }
  }

  void work() {
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
          const Pack dv = get(pv_, i) - get(pv_, i + d);
          const Pack w = linear_algebra::load(pair + l) * dv;
          put(w, &to_j[l]);
          put(get(w_, i) + w, &w_[i]);
          if constexpr (viscous) {
            const Pack q = 0.5 * linear_algebra::load(viscous_pair + l) * dv;
            put(q, &viscous_to_j[l]);
            put(get(q_, i) + q, &q_[i]);
          }
        }
        for (std::size_t l = 0; l < block; l += lanes)
          put(get(w_, begin + d + l) + linear_algebra::load(to_j + l), &w_[begin + d + l]);
        if constexpr (viscous)
          for (std::size_t l = 0; l < block; l += lanes)
            put(get(q_, begin + d + l) + linear_algebra::load(viscous_to_j + l), &q_[begin + d + l]);
      }
  }

  std::size_t n_;
  double eta_, gamma_;
  Array x_, v_, e_, m_, h_, rho_, p_, c_, f_, a_, w_, q_, heat_, rate_, pv_, pe_, least_;
  Array gradient_, viscous_;
  std::vector<std::size_t> widths_;
};

} // namespace performance
