#pragma once

#include "pair_ranges.h"

#include "meshless/basis/basis_options.h"
#include "meshless/effects/usage.h"
#include "meshless/kernels/elementary.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <cstddef>

/// The loops over the pairs of a line of particles. A block of particles i is taken with one k after the other; the
/// pairs (i, i + k) lie side by side in all arrays. What a pair gives to j = i + k is added in a second loop, because
/// there it may lie in the same vector as what another pair reads. Kernel, effects and the arrays' addresses are taken
/// by value: behind a reference they would be read again after every store. `flatten` has the compiler inline what the
/// loops call, as it would not in a function of this size.
namespace meshless::hydrodynamics {

/// Arrays with one value a particle; of those for an effect that is absent there is none.
struct Fields {
  const double *position = nullptr;
  const double *smoothing_length = nullptr;
  const double *mass = nullptr;
  const double *velocity = nullptr;
  const double *energy = nullptr;
  const double *sound_speed = nullptr;
  const double *pressure_term = nullptr; ///< p / rho^2, or p
  double *density = nullptr;
  double *force = nullptr;         ///< N/m^2
  double *compression = nullptr;   ///< sum_j m_i m_j (v_i - v_j) W'_ij
  double *viscous_work = nullptr;  ///< W/m^2
  double *heat = nullptr;          ///< W/m^2
  double *pair_gradient = nullptr; ///< m_i m_j W'_ij, or that / (rho_i rho_j)
  double *pair_viscous = nullptr;  ///< m_i m_j W'_ij Pi_ij
};

namespace internal {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;
using BlockArray = std::array<double, block_size>;

/// to[i] += sign from[i] over a block.
template <int sign>
inline void accumulate(const BlockArray &from, double *to) {
  for (std::size_t i = 0; i < block_size; i += n_lanes)
    store(sign > 0 ? Pack(load(to + i) + load(&from[i])) : Pack(load(to + i) - load(&from[i])), to + i);
}

/// Geometry of n_lanes pairs.
struct Pairs {
  Pack dx; ///< x_i - x_j < 0
  Pack h;  ///< mean
  Pack inverse_h;
  Pack s_squared;
  Pack::mask_type inside;

  Pairs(const Fields &fields, std::size_t i, std::size_t j, double limit)
      : dx(load(fields.position + i) - load(fields.position + j)),
        h(0.5 * (load(fields.smoothing_length + i) + load(fields.smoothing_length + j))), inverse_h(1 / h),
        s_squared(dx * dx * inverse_h * inverse_h), inside(s_squared < Pack(limit)) {}
};

} // namespace internal

/// density += sum_j m_j W_ij over the pairs; the particle's own share is not in it.
template <typename Kernel>
[[gnu::flatten]] void sum_density(const Kernel kernel, const PairRanges &ranges, const Fields fields) {
  using namespace internal;
  const double limit = basis::edge_limit(kernel.support(), basis::EdgeRule::excluded);
  const double g = kernel.normalisation(1);
  BlockArray to_j;
  for (std::size_t block = 0; block < ranges.n_blocks(); ++block)
    for (std::size_t k = 1; k <= ranges.width(block); ++k) {
      const std::size_t begin = ranges.begin(block);
      for (std::size_t l = 0; l < block_size; l += n_lanes) {
        const std::size_t i = begin + l;
        const Pairs pairs(fields, i, i + k, limit);
        const Pack w =
            kernels::select(pairs.inside, Pack(g * pairs.inverse_h * kernel.value(pairs.s_squared)), Pack(0));
        store(load(fields.density + i) + load(fields.mass + i + k) * w, fields.density + i);
        store(load(fields.mass + i) * w, &to_j[l]);
      }
      accumulate<1>(to_j, fields.density + begin + k);
    }
}

/// Forces of all pairs, and what the energy pass needs of each.
///
/// With `continuity` the pair's force is m_i m_j (p_i + p_j) / (rho_i rho_j) W'_ij, which belongs to the density
///   d rho_i / dt = rho_i sum_j (m_j / rho_j) (v_i - v_j) W'_ij
/// and bears jumps of the density; `pair_gradient` is then m_i m_j / (rho_i rho_j) W'_ij and `pressure_term` p.
template <bool continuity, typename Kernel, typename Viscosity, typename Conduction>
[[gnu::flatten]] void add_forces(const Kernel kernel, const Viscosity viscosity, const Conduction conduction,
                                 const PairRanges &ranges, const Fields fields) {
  using namespace internal;
  constexpr bool viscous = effects::is_present<Viscosity>;
  constexpr bool conducting = effects::is_present<Conduction>;
  const double limit = basis::edge_limit(kernel.support(), basis::EdgeRule::excluded);
  const double g = kernel.normalisation(1);
  BlockArray force;
  [[maybe_unused]] BlockArray heat;
  for (std::size_t block = 0; block < ranges.n_blocks(); ++block)
    for (std::size_t k = 1; k <= ranges.width(block); ++k) {
      const std::size_t begin = ranges.begin(block);
      const std::size_t pair = ranges.offset(block) + (k - 1) * block_size;
      for (std::size_t l = 0; l < block_size; l += n_lanes) {
        const std::size_t i = begin + l;
        const std::size_t j = i + k;
        const Pairs pairs(fields, i, j, limit);
        const Pack masses = load(fields.mass + i) * load(fields.mass + j);
        const Pack cubed = pairs.inverse_h * pairs.inverse_h * pairs.inverse_h;
        const Pack gradient = kernels::select(
            pairs.inside, Pack(masses * (g * cubed) * kernel.slope(pairs.s_squared) * pairs.dx), Pack(0));
        const Pack weighted = [&] {
          if constexpr (continuity)
            return Pack(gradient / (load(fields.density + i) * load(fields.density + j)));
          else
            return gradient;
        }();
        store(weighted, fields.pair_gradient + pair + l);
        Pack f = weighted * (load(fields.pressure_term + i) + load(fields.pressure_term + j));
        if constexpr (viscous || conducting) {
          const Pack dv = load(fields.velocity + i) - load(fields.velocity + j);
          const Pack c = 0.5 * (load(fields.sound_speed + i) + load(fields.sound_speed + j));
          const Pack rho = 0.5 * (load(fields.density + i) + load(fields.density + j));
          if constexpr (viscous) {
            const Pack q = gradient * viscosity.pressure(pairs.dx, dv, pairs.h, c, rho);
            store(q, fields.pair_viscous + pair + l);
            f += q;
          }
          if constexpr (conducting) {
            const Pack de = load(fields.energy + i) - load(fields.energy + j);
            const Pack power = gradient * conduction.flux(pairs.dx, dv, de, pairs.h, c, rho);
            store(power, &heat[l]);
            store(load(fields.heat + i) + power, fields.heat + i);
          }
        }
        store(f, &force[l]);
        store(load(fields.force + i) - f, fields.force + i);
      }
      accumulate<1>(force, fields.force + begin + k);
      if constexpr (conducting)
        accumulate<-1>(heat, fields.heat + begin + k);
    }
}

/// The work of the pairs' forces along `velocity`: with dv = v_i - v_j
///   compression_i += m_i m_j W'_ij dv,  viscous_work_i += m_i m_j W'_ij Pi_ij dv / 2,  and the same to j.
template <bool viscous>
[[gnu::flatten]] void add_work(const PairRanges &ranges, const Fields fields) {
  using namespace internal;
  BlockArray work;
  [[maybe_unused]] BlockArray viscous_work;
  for (std::size_t block = 0; block < ranges.n_blocks(); ++block)
    for (std::size_t k = 1; k <= ranges.width(block); ++k) {
      const std::size_t begin = ranges.begin(block);
      const std::size_t pair = ranges.offset(block) + (k - 1) * block_size;
      for (std::size_t l = 0; l < block_size; l += n_lanes) {
        const std::size_t i = begin + l;
        const Pack dv = load(fields.velocity + i) - load(fields.velocity + i + k);
        const Pack w = load(fields.pair_gradient + pair + l) * dv;
        store(w, &work[l]);
        store(load(fields.compression + i) + w, fields.compression + i);
        if constexpr (viscous) {
          const Pack q = 0.5 * load(fields.pair_viscous + pair + l) * dv;
          store(q, &viscous_work[l]);
          store(load(fields.viscous_work + i) + q, fields.viscous_work + i);
        }
      }
      accumulate<1>(work, fields.compression + begin + k);
      if constexpr (viscous)
        accumulate<1>(viscous_work, fields.viscous_work + begin + k);
    }
}

} // namespace meshless::hydrodynamics
