#include "fem_reference/gas/discontinuous_galerkin.h"

#include "discretisation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fem_reference::gas {

namespace {

double minmod(double a, double b, double c) {
  if (a > 0 && b > 0 && c > 0)
    return std::min({a, b, c});
  if (a < 0 && b < 0 && c < 0)
    return std::max({a, b, c});
  return 0;
}

Conserved sum(const Conserved &a, double factor, const Conserved &b) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

} // namespace

DiscontinuousGalerkin::DiscontinuousGalerkin(const Tube &tube, int degree)
    : degree_(degree), gamma_(tube.gamma), boundaries_(tube.boundaries) {
  if (degree != 0 && degree != 1)
    throw std::invalid_argument(fmt::format("degree {}; 0 and 1 are allowed", degree));
  if (tube.n_cells < 1 || !(tube.right > tube.left) || !(tube.gamma > 1))
    throw std::invalid_argument("a tube needs a cell, a length and gamma > 1");
  const Discretisation discretisation(tube, degree);
  ends_ = discretisation.ends;
  centres_ = discretisation.centres;
  inverse_mass_ = discretisation.inverse_mass;
  traces_ = discretisation.traces;
  point_values_ = discretisation.point_values;
  gradient_weights_ = discretisation.gradient_weights;
  width_ = ends_[1] - ends_[0];
  for (const auto &coefficients : discretisation.initial) {
    mean_.push_back(coefficients[0]);
    if (degree == 1)
      slope_.push_back(coefficients[1]);
  }
  mean_rate_.resize(mean_.size());
  mean_stage_.resize(mean_.size());
  slope_rate_.resize(slope_.size());
  slope_stage_.resize(slope_.size());
  fluxes_.resize(mean_.size() + 1);
  require_gas();
  if (degree == 1)
    limit(mean_, slope_);
}

Primitive DiscontinuousGalerkin::primitive(const Conserved &u) const {
  const double v = u[1] / u[0];
  return {u[0], v, (gamma_ - 1) * (u[2] - 0.5 * u[1] * v)};
}

Conserved DiscontinuousGalerkin::flux(const Conserved &u) const {
  const Primitive w = primitive(u);
  return {u[1], u[1] * w.velocity + w.pressure, (u[2] + w.pressure) * w.velocity};
}

bool DiscontinuousGalerkin::is_gas(const Conserved &u) const {
  return u[0] > 0 && primitive(u).pressure > 0 && std::isfinite(u[0]) && std::isfinite(u[2]);
}

/// Wave speeds by Einfeldt's means, the contact's from the jump conditions.
Conserved DiscontinuousGalerkin::hllc(const Conserved &left, const Conserved &right) const {
  const Primitive l = primitive(left);
  const Primitive r = primitive(right);
  const double cl = std::sqrt(gamma_ * l.pressure / l.density);
  const double cr = std::sqrt(gamma_ * r.pressure / r.density);
  const double wl = std::sqrt(l.density);
  const double wr = std::sqrt(r.density);
  const double v = (wl * l.velocity + wr * r.velocity) / (wl + wr);
  const double jump = r.velocity - l.velocity;
  const double c =
      std::sqrt((wl * cl * cl + wr * cr * cr) / (wl + wr) + 0.5 * wl * wr / ((wl + wr) * (wl + wr)) * jump * jump);
  const double sl = std::min(l.velocity - cl, v - c);
  const double sr = std::max(r.velocity + cr, v + c);
  if (sl >= 0)
    return flux(left);
  if (sr <= 0)
    return flux(right);
  const double ml = l.density * (sl - l.velocity);
  const double mr = r.density * (sr - r.velocity);
  const double star = (r.pressure - l.pressure + ml * l.velocity - mr * r.velocity) / (ml - mr);
  const auto beside = [&](const Conserved &u, const Primitive &w, double s, double m) {
    const double density = m / (s - star);
    const Conserved inner{density, density * star,
                          density * (u[2] / w.density + (star - w.velocity) * (star + w.pressure / m))};
    const Conserved f = flux(u);
    return Conserved{f[0] + s * (inner[0] - u[0]), f[1] + s * (inner[1] - u[1]), f[2] + s * (inner[2] - u[2])};
  };
  return star >= 0 ? beside(left, l, sl, ml) : beside(right, r, sr, mr);
}

Conserved DiscontinuousGalerkin::outside(const Conserved &inside, Boundary boundary) const {
  return boundary == Boundary::wall ? Conserved{inside[0], -inside[1], inside[2]} : inside;
}

double DiscontinuousGalerkin::stable_step() const {
  double fastest = 0;
  for (const auto &u : mean_) {
    const Primitive w = primitive(u);
    fastest = std::max(fastest, std::abs(w.velocity) + std::sqrt(gamma_ * w.pressure / w.density));
  }
  return width_ / fastest / (2 * degree_ + 1);
}

/// M_kk du_k/dt = integral of phi_k,x f - [phi_k F].
void DiscontinuousGalerkin::rates(const Cells &mean, const Cells &slope) {
  const std::size_t n = mean.size();
  const auto at_end = [&](std::size_t i, std::size_t side) {
    return degree_ == 1 ? sum(mean[i], traces_[side], slope[i]) : mean[i];
  };
  fluxes_[0] = hllc(outside(at_end(0, 0), boundaries_[0]), at_end(0, 0));
  for (std::size_t i = 1; i < n; ++i)
    fluxes_[i] = hllc(at_end(i - 1, 1), at_end(i, 0));
  fluxes_[n] = hllc(at_end(n - 1, 1), outside(at_end(n - 1, 1), boundaries_[1]));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      mean_rate_[i][k] = inverse_mass_[i][0] * (fluxes_[i][k] - fluxes_[i + 1][k]);
    if (degree_ == 0)
      continue;
    const Conserved before = flux(sum(mean[i], point_values_[0], slope[i]));
    const Conserved after = flux(sum(mean[i], point_values_[1], slope[i]));
    for (std::size_t k = 0; k < 3; ++k)
      slope_rate_[i][k] = inverse_mass_[i][1] * (gradient_weights_[0] * before[k] + gradient_weights_[1] * after[k] +
                                                 traces_[0] * fluxes_[i][k] - traces_[1] * fluxes_[i + 1][k]);
  }
}

void DiscontinuousGalerkin::limit(const Cells &mean, Cells &slope) {
  const std::size_t n = mean.size();
  // Up to three quarters of the difference of two means is reached at a cell's end.
  const double share = 0.75 / traces_[1];
  for (std::size_t i = 0; i < n; ++i) {
    const Conserved before = i > 0 ? mean[i - 1] : outside(mean[i], boundaries_[0]);
    const Conserved after = i + 1 < n ? mean[i + 1] : outside(mean[i], boundaries_[1]);
    for (std::size_t k = 0; k < 3; ++k)
      slope[i][k] = minmod(slope[i][k], share * (mean[i][k] - before[k]), share * (after[k] - mean[i][k]));
    // Where a trace would be no gas the slopes shrink until it is one.
    for (int halving = 0;
         halving < 60 && !(is_gas(sum(mean[i], traces_[1], slope[i])) && is_gas(sum(mean[i], traces_[0], slope[i])));
         ++halving) {
      n_shrunk_slopes_ += halving == 0;
      for (double &s : slope[i])
        s *= 0.5;
    }
  }
}

void DiscontinuousGalerkin::step(double dt) {
  const std::size_t n = mean_.size();
  rates(mean_, slope_);
  if (degree_ == 0) {
    for (std::size_t i = 0; i < n; ++i)
      mean_[i] = sum(mean_[i], dt, mean_rate_[i]);
  } else {
    for (std::size_t i = 0; i < n; ++i) {
      mean_stage_[i] = sum(mean_[i], dt, mean_rate_[i]);
      slope_stage_[i] = sum(slope_[i], dt, slope_rate_[i]);
    }
    limit(mean_stage_, slope_stage_);
    rates(mean_stage_, slope_stage_);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        mean_[i][k] = 0.5 * (mean_[i][k] + mean_stage_[i][k] + dt * mean_rate_[i][k]);
        slope_[i][k] = 0.5 * (slope_[i][k] + slope_stage_[i][k] + dt * slope_rate_[i][k]);
      }
    limit(mean_, slope_);
  }
  time_ += dt;
  require_gas();
}

void DiscontinuousGalerkin::require_gas() const {
  for (std::size_t i = 0; i < mean_.size(); ++i)
    if (!is_gas(mean_[i]))
      throw std::runtime_error(
          fmt::format("at t = {:.6g} s, cell {} at x = {:.6g} m: density {:.4g} kg/m^3 or pressure "
                      "{:.4g} Pa is not positive",
                      time_, i + 1, centres_[i], mean_[i][0], primitive(mean_[i]).pressure));
}

void DiscontinuousGalerkin::evaluate(std::span<const double> places, std::span<Primitive> states) const {
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto behind = std::upper_bound(ends_.begin() + 1, ends_.end() - 1, places[p]) - ends_.begin();
    const auto i = static_cast<std::size_t>(behind - 1);
    const double part = (places[p] - ends_[i]) / (ends_[i + 1] - ends_[i]);
    const double linear = traces_[0] + part * (traces_[1] - traces_[0]);
    states[p] = primitive(degree_ == 1 ? sum(mean_[i], linear, slope_[i]) : mean_[i]);
  }
}

std::vector<std::pair<std::string, std::span<double>>> DiscontinuousGalerkin::state() {
  counters_ = {time_, static_cast<double>(n_shrunk_slopes_)};
  std::vector<std::pair<std::string, std::span<double>>> all{{"time_and_shrunk_slopes", counters_}};
  all.emplace_back("mean", std::span(mean_.front().data(), 3 * mean_.size()));
  if (degree_ == 1)
    all.emplace_back("slope", std::span(slope_.front().data(), 3 * slope_.size()));
  return all;
}

Conserved DiscontinuousGalerkin::totals() const {
  Conserved total{};
  for (std::size_t i = 0; i < mean_.size(); ++i)
    total = sum(total, ends_[i + 1] - ends_[i], mean_[i]);
  return total;
}

} // namespace fem_reference::gas
