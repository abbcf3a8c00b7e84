#pragma once

#include "meshless/effects/usage.h"
#include "meshless/linear_algebra/diagonals.h"
#include "meshless/linear_algebra/pack.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

/// The loops of a step of `ElasticBar`, composed at compile time: what an absent effect would need is not in the code.
namespace meshless::dynamics {

/// The displacement of an end from its row of D1 and the stress there, (6.30), with the row divided by its own entry:
///   u_i = factor sigma + sum_k coefficient_k u_{begin + k}, the coefficient of u_i itself 0.
struct EndRow {
  double factor = 0; ///< m/Pa
  std::size_t begin = 0;
  std::vector<double> coefficients;

  EndRow() = default;
  EndRow(const linear_algebra::SparseRows &first, std::size_t i, double modulus) {
    const auto entries = std::pair{first.offsets()[i], first.offsets()[i + 1]};
    const auto columns = first.columns().subspan(static_cast<std::size_t>(entries.first),
                                                 static_cast<std::size_t>(entries.second - entries.first));
    if (std::find(columns.begin(), columns.end(), static_cast<std::int64_t>(i)) == columns.end())
      throw std::invalid_argument(
          fmt::format("the row of D1 at the end particle {} has no entry of its own, so that no "
                      "stress can be prescribed there",
                      i + 1));
    const auto [least, largest] = std::minmax_element(columns.begin(), columns.end());
    begin = static_cast<std::size_t>(*least);
    coefficients.assign(static_cast<std::size_t>(*largest - *least) + 1, 0.0);
    for (std::size_t e = 0; e < columns.size(); ++e)
      coefficients[static_cast<std::size_t>(columns[e]) - begin] =
          first.values()[static_cast<std::size_t>(entries.first) + e];
    double &own = coefficients[i - begin];
    const double inverse = 1 / own;
    own = 0;
    factor = inverse / modulus;
    for (double &c : coefficients)
      c *= -inverse;
  }

  double displacement(double sigma, const double *u) const {
    double sum = factor * sigma;
    for (std::size_t k = 0; k < coefficients.size();
         ++k) // not a sum that compilers would spread over lanes for 3 terms
      sum = std::fma(coefficients[k], u[begin + k], sum);
    return sum;
  }
};

/// What a step reads and writes; vectors start at particle 0 and have margins of `Diagonals::margin`.
struct BarArrays {
  const linear_algebra::Diagonals *rows = nullptr; ///< c^2 D2
  std::array<EndRow, 2> ends;
  double *displacement = nullptr;
  double *velocity = nullptr;
  double *stressing = nullptr; ///< u + delay v, of viscosity
  double delay = 0;            ///< b D / c, of viscosity
  double damping = 0;          ///< 1/s
};

struct BarTime {
  double length = 0;                        ///< of the step, s
  double left_stress = 0, right_stress = 0; ///< at its end, Pa
};

/// Half width of a stencil that is none of the common ones.
inline constexpr int any_width = 0;

/// f.operator()<half_width>() with a constant for the common stencils.
template <typename F>
auto with_half_width(std::size_t half_width, const F &f) {
  switch (half_width) {
  case 1:
    return f.template operator()<1>();
  case 2:
    return f.template operator()<2>();
  case 3:
    return f.template operator()<3>();
  case 4:
    return f.template operator()<4>();
  default:
    return f.template operator()<any_width>();
  }
}

/// Products with the rows of a band matrix along lanes. The diagonals' places are values of its own: a store into a
/// vector could be one into the matrix for all that the compiler knows, and it would read them anew for every pack.
template <int half_width>
class RowProducts {
public:
  explicit RowProducts(const linear_algebra::Diagonals &rows) {
    for (int k = -half_width; k <= half_width; ++k)
      diagonals_[static_cast<std::size_t>(k + half_width)] = rows.diagonal(k);
  }

  /// sum_k d_k[i] x[i + k]
  linear_algebra::Pack operator()(const double *x, std::size_t i) const {
    using linear_algebra::load;
    linear_algebra::Pack sum = load(diagonals_[0] + i) * load(x + i - half_width);
    for (std::size_t k = 1; k <= 2 * half_width; ++k)
      sum += load(diagonals_[k] + i) * load(x + i + k - half_width);
    return sum;
  }

private:
  std::array<const double *, 2 * half_width + 1> diagonals_;
};

template <>
class RowProducts<any_width> {
public:
  explicit RowProducts(const linear_algebra::Diagonals &rows)
      : half_width_(static_cast<std::ptrdiff_t>(rows.half_width())), first_(rows.diagonal(-half_width_)),
        stride_(half_width_ > 0 ? rows.diagonal(0) - rows.diagonal(-1) : 0) {}

  linear_algebra::Pack operator()(const double *x, std::size_t i) const {
    using linear_algebra::load;
    const double *d = first_ + i;
    const double *at = x + i - half_width_;
    linear_algebra::Pack sum = load(d) * load(at);
    for (std::ptrdiff_t k = 1; k <= 2 * half_width_; ++k)
      sum += load(d + k * stride_) * load(at + k);
    return sum;
  }

private:
  std::ptrdiff_t half_width_;
  const double *first_;
  std::ptrdiff_t stride_;
};

/// v += dt (c^2 D2 (u + delay v) - damping v), then u += dt v: in one pass, or in two with viscosity or wide stencils.
/// Displacements follow the velocities by one pack, so that all rows that reach back have read the old ones.
template <int half_width, typename Viscosity, typename Damping>
void advance_bar(const BarArrays &bar, const BarTime &time) {
  const double dt = time.length;
  using namespace linear_algebra;
  constexpr bool viscous = effects::is_present<Viscosity>;
  const std::size_t n = bar.rows->n_rows();
  double *u = bar.displacement;
  double *v = bar.velocity;
  const double *x = u;
  const RowProducts<half_width> product(*bar.rows);
  if constexpr (viscous) {
    double *sum = bar.stressing;
    const double delay = bar.delay;
    for (std::size_t i = 0; i < n; i += n_lanes) // beyond the last one there are margins
      store(load(u + i) + delay * load(v + i), sum + i);
    x = sum;
  }
  [[maybe_unused]] const double keep = 1 - dt * bar.damping;
  const auto kick = [=](std::size_t i) {
    const Pack a = product(x, i);
    Pack after;
    if constexpr (effects::is_present<Damping>)
      after = keep * load(v + i) + dt * a;
    else
      after = load(v + i) + dt * a;
    store(after, v + i);
    return after;
  };
  const auto drift = [=](std::size_t i, const Pack &velocity) { store(load(u + i) + dt * velocity, u + i); };
  const double per_step = 1 / dt;
  const auto set_end = [=](std::size_t i, double before, double now) {
    u[i] = now;
    v[i] = (now - before) * per_step;
  };
  const double first = u[0];
  const double last = u[n - 1];
  const auto set_left = [&] { set_end(0, first, bar.ends[0].displacement(time.left_stress, u)); };
  // The left end as soon as its row is known and no other row reads the old value: the next step begins with it, and a
  // processor that has to wait for a single value that was written just before stands still.
  const std::size_t early =
      padded(std::max(bar.ends[0].coefficients.size(), bar.rows->half_width() + 1)) + std::size_t{n_lanes};
  std::size_t i = 0;
  if constexpr (viscous || half_width == any_width || half_width > n_lanes) {
    const auto go = [&](std::size_t end) {
      for (; i < end; i += n_lanes) {
        const Pack after = kick(i);
        if constexpr (viscous) // rows read another vector
          drift(i, after);
      }
    };
    if (viscous && early < n) {
      go(early);
      set_left();
    }
    go(n);
    for (i = 0; !viscous && i < n; i += n_lanes)
      drift(i, load(v + i));
    if (!viscous || early >= n)
      set_left();
  } else {
    Pack before = kick(0);
    i = n_lanes;
    const auto go = [&](std::size_t end) {
#pragma GCC unroll 2 // two packs in turn, so that none is copied to `before`
      for (; i < end; i += n_lanes) {
        const Pack now = kick(i);
        drift(i - n_lanes, before);
        before = now;
      }
    };
    if (early < n) {
      go(early);
      set_left();
    }
    go(n);
    drift(i - n_lanes, before);
    if (early >= n)
      set_left();
  }
  set_end(n - 1, last, bar.ends[1].displacement(time.right_stress, u));
}

using BarStep = void (*)(const BarArrays &, const BarTime &);

/// The step for a half width and the effects that are present.
template <typename Viscosity, typename Damping>
BarStep bar_step_for(std::size_t half_width) {
  return with_half_width(half_width, []<int w>() -> BarStep { return advance_bar<w, Viscosity, Damping>; });
}

} // namespace meshless::dynamics
