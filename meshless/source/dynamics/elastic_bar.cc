#include "meshless/dynamics/elastic_bar.h"

#include "meshless/dynamics/violation.h"
#include "meshless/linear_algebra/diagonals.h"
#include "meshless/linear_algebra/eigenvalues.h"
#include "meshless/linear_algebra/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace meshless::dynamics {

using linear_algebra::Diagonals;
using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

namespace {

/// Steps between two checks; a factor of 1.5 in energy is far above what the pulse's own error makes (2 %) and far
/// below what an instability reaches in a few hundred steps.
constexpr std::int64_t check_interval = 200;
constexpr double most_energy = 1.5;

/// y = keep y + factor A x along lanes, `x` with margins; the number of diagonals is a constant for the common
/// stencils, `keep` is 1 and not there if nothing is damped.
template <int half_width, bool damped>
void add_product(const Diagonals &a, const double *x, double factor, double keep, double *y) {
  const std::size_t n = a.n_rows();
  std::array<const double *, 2 * half_width + 1> d;
  for (int k = -half_width; k <= half_width; ++k)
    d[static_cast<std::size_t>(k + half_width)] = a.diagonal(k);
  for (std::size_t i = 0; i < n; i += n_lanes) {
    Pack sum = load(d[0] + i) * load(x + i - half_width);
    for (int k = 1; k <= 2 * half_width; ++k)
      sum += load(d[static_cast<std::size_t>(k)] + i) * load(x + static_cast<std::ptrdiff_t>(i) + k - half_width);
    if constexpr (damped)
      store(keep * load(y + i) + factor * sum, y + i);
    else
      store(load(y + i) + factor * sum, y + i);
  }
}

void add_product_of_any_width(const Diagonals &a, const double *x, double factor, double keep, double *y) {
  const auto w = static_cast<std::ptrdiff_t>(a.half_width());
  for (std::size_t i = 0; i < a.n_rows(); i += n_lanes) {
    Pack sum = 0;
    for (std::ptrdiff_t k = -w; k <= w; ++k)
      sum += load(a.diagonal(k) + i) * load(x + static_cast<std::ptrdiff_t>(i) + k);
    store(keep * load(y + i) + factor * sum, y + i);
  }
}

template <bool damped>
void add_product(const Diagonals &a, const double *x, double factor, double keep, double *y) {
  switch (a.half_width()) {
  case 1:
    return add_product<1, damped>(a, x, factor, keep, y);
  case 2:
    return add_product<2, damped>(a, x, factor, keep, y);
  case 3:
    return add_product<3, damped>(a, x, factor, keep, y);
  case 4:
    return add_product<4, damped>(a, x, factor, keep, y);
  default:
    return add_product_of_any_width(a, x, factor, keep, y);
  }
}

} // namespace

class ElasticBar::Implementation {
public:
  explicit Implementation(const BarOptions &options)
      : options_(options), n_(options.positions.size()), spacing_(least_spacing(options)),
        c_(std::sqrt(options.youngs_modulus / options.density)), operators_(options.operators(options.positions)),
        second_(operators_.second, c_ * c_) {
    if (n_ < 5)
      throw std::invalid_argument(fmt::format("a bar needs five particles; found {}", n_));
    if (!(options.youngs_modulus > 0) || !(options.density > 0))
      throw std::invalid_argument("Young's modulus and density of a bar are positive");
    margin_ = Diagonals::margin(second_.half_width());
    displacement_.assign(n_ + 2 * margin_, 0.0);
    velocity_ = displacement_;
    if (options.viscosity)
      stressing_ = displacement_;
    limit_ = find_limit();
  }

  void step(double dt) {
    if (!(dt <= limit_ * (1 + 1e-12)))
      throw Violation(time_, -1, 0,
                      fmt::format("the time step {:.4g} s is {:.3g} times the largest stable one, {:.4g} s (CFL number "
                                  "{:.4g}, largest {:.4g})",
                                  dt, dt / limit_, limit_, c_ * dt / spacing_, c_ * limit_ / spacing_));
    if (options_.kernel_positions == KernelPositions::current)
      move_kernels();
    const double first_before = u(0);
    const double last_before = u(n_ - 1);
    accelerate(dt);
    drift(dt);
    const double before = time_;
    time_ += dt;
    ++steps_;
    set_end(0, options_.left_stress ? options_.left_stress(time_) : 0);
    set_end(n_ - 1, options_.right_stress ? options_.right_stress(time_) : 0);
    velocity_[margin_] = (u(0) - first_before) / dt;
    velocity_[margin_ + n_ - 1] = (u(n_ - 1) - last_before) / dt;
    if (options_.left_stress)
      work_ -= 0.5 * (options_.left_stress(before) + options_.left_stress(time_)) * (u(0) - first_before);
    if (options_.right_stress)
      work_ += 0.5 * (options_.right_stress(before) + options_.right_stress(time_)) * (u(n_ - 1) - last_before);
    most_work_ = std::max(most_work_, std::abs(work_));
    if (steps_ % check_interval == 0)
      check();
  }

  void check() const {
    double fastest = 0;
    std::size_t place = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      const double speed = std::abs(velocity_[margin_ + i]);
      if (!std::isfinite(speed) || !std::isfinite(u(i)))
        throw Violation(time_, static_cast<std::int64_t>(i), options_.positions[i], "a value is not finite");
      if (speed > fastest) {
        fastest = speed;
        place = i;
      }
    }
    if (energy() > most_energy * most_work_)
      throw Violation(time_, static_cast<std::int64_t>(place), options_.positions[place],
                      fmt::format("the energy {:.4g} J/m^2 is {:.3g} times the work put in: the scheme is unstable at "
                                  "any time step (this particle is the fastest, {:.3g} m/s)",
                                  energy(), energy() / most_work_, fastest));
  }

  double energy() const {
    double sum = 0;
    const std::vector<double> sigma = stress();
    for (std::size_t i = 0; i < n_; ++i) {
      const double v = velocity_[margin_ + i];
      const double weight = 0.5 * ((i > 0 ? options_.positions[i] - options_.positions[i - 1] : 0) +
                                   (i + 1 < n_ ? options_.positions[i + 1] - options_.positions[i] : 0));
      sum += 0.5 * weight * (options_.density * v * v + sigma[i] * sigma[i] / options_.youngs_modulus);
    }
    return sum;
  }

  std::vector<double> stress() const {
    std::vector<double> sigma(n_);
    operators_.first.multiply({&displacement_[margin_], n_}, sigma);
    for (double &s : sigma)
      s *= options_.youngs_modulus;
    return sigma;
  }

  double growth_rate() const {
    constexpr std::size_t most = 100;
    const std::size_t n = std::min(n_, most);
    const LineOperators part = options_.operators(std::span(options_.positions).first(n));
    const auto dense = [&](const linear_algebra::SparseRows &rows) {
      std::vector<double> matrix(n * n, 0.0);
      for (std::size_t i = 0; i < n; ++i)
        for (auto e = rows.offsets()[i]; e < rows.offsets()[i + 1]; ++e)
          matrix[i * n + static_cast<std::size_t>(rows.columns()[static_cast<std::size_t>(e)])] =
              rows.values()[static_cast<std::size_t>(e)];
      return matrix;
    };
    const auto first = dense(part.first);
    auto second = dense(part.second);
    const std::size_t last = n - 1;
    // The ends follow from D1 u = 0 in the first and last row.
    const double det = first[0] * first[last * n + last] - first[last] * first[last * n];
    const std::size_t inner = n - 2;
    std::vector<double> reduced(inner * inner);
    for (std::size_t i = 0; i < inner; ++i)
      for (std::size_t j = 0; j < inner; ++j) {
        const double a = -first[j + 1];
        const double b = -first[last * n + j + 1];
        const double left = (a * first[last * n + last] - b * first[last]) / det;
        const double right = (b * first[0] - a * first[last * n]) / det;
        const double *row = &second[(i + 1) * n];
        reduced[i * inner + j] = c_ * c_ * (row[j + 1] + row[0] * left + row[last] * right);
      }
    double fastest = 0;
    for (const auto &lambda : linear_algebra::eigenvalues(reduced, inner))
      fastest = std::max(fastest, std::abs(std::sqrt(-lambda).imag()));
    return fastest;
  }

  State state() {
    counters_ = {time_, static_cast<double>(steps_), work_, most_work_};
    return {{"displacement", {&displacement_[margin_], n_}},
            {"velocity", {&velocity_[margin_], n_}},
            {"time_steps_work", counters_}};
  }

  void adopt_state() {
    time_ = counters_[0];
    steps_ = static_cast<std::int64_t>(counters_[1]);
    work_ = counters_[2];
    most_work_ = counters_[3];
  }

  std::vector<effects::Usage> usage() const {
    std::vector<effects::Usage> all{{"elasticity", second_.bytes(), steps_}, {"inertia", 0, steps_}};
    if (options_.viscosity)
      all.push_back({"artificial_viscosity", stressing_.capacity() * sizeof(double), steps_});
    if (options_.damping)
      all.push_back({"damping", 0, steps_});
    return all;
  }

  std::size_t bytes() const {
    return second_.bytes() + (displacement_.capacity() + velocity_.capacity() + stressing_.capacity()) * sizeof(double);
  }

  const BarOptions &options() const { return options_; }
  std::span<const double> own(const std::vector<double> &field) const { return {&field[margin_], n_}; }
  const std::vector<double> &displacement() const { return displacement_; }
  const std::vector<double> &velocity() const { return velocity_; }
  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }
  double c() const { return c_; }
  double spacing() const { return spacing_; }
  double limit() const { return limit_; }
  double work() const { return work_; }
  std::int64_t nonzeros() const { return operators_.second.nonzeros(); }

private:
  static double least_spacing(const BarOptions &options) {
    double least = INFINITY;
    for (std::size_t i = 1; i < options.positions.size(); ++i)
      least = std::min(least, options.positions[i] - options.positions[i - 1]);
    if (!(least > 0))
      throw std::invalid_argument("the particles of a bar do not stand in increasing order");
    return least;
  }

  double u(std::size_t i) const { return displacement_[margin_ + i]; }

  void accelerate(double dt) {
    const double *x = &displacement_[margin_];
    if (options_.viscosity) {
      // c^2 D2 u + b c D D2 v = c^2 D2 (u + b D / c v)
      const double delay = options_.viscosity->diffusivity(c_, spacing_) / (c_ * c_);
      const double *u = displacement_.data();
      const double *v = velocity_.data();
      double *sum = stressing_.data();
      for (std::size_t i = margin_; i < margin_ + n_; i += n_lanes) // beyond the last one there are margins
        store(load(u + i) + delay * load(v + i), sum + i);
      std::fill_n(sum + margin_ + n_, n_lanes, 0.0);
      x = sum + margin_;
    }
    double *v = &velocity_[margin_];
    if (options_.damping)
      add_product<true>(second_, x, dt, 1 - dt * options_.damping->rate, v);
    else
      add_product<false>(second_, x, dt, 1, v);
  }

  void drift(double dt) {
    double *u = displacement_.data();
    const double *v = velocity_.data();
    for (std::size_t i = margin_; i < margin_ + n_; i += n_lanes) // velocities in the margins are zero
      store(load(u + i) + dt * load(v + i), u + i);
  }

  /// Displacement of an end from its row of D1 and the stress there, (6.30).
  void set_end(std::size_t i, double sigma) {
    double sum = 0;
    double own = 0;
    const auto begin = static_cast<std::size_t>(operators_.first.offsets()[i]);
    const auto end = static_cast<std::size_t>(operators_.first.offsets()[i + 1]);
    for (std::size_t e = begin; e < end; ++e) {
      const auto j = static_cast<std::size_t>(operators_.first.columns()[e]);
      if (j == i)
        own = operators_.first.values()[e];
      else
        sum += operators_.first.values()[e] * u(j);
    }
    displacement_[margin_ + i] = (sigma / options_.youngs_modulus - sum) / own;
  }

  void move_kernels() {
    std::vector<double> places(n_);
    for (std::size_t i = 0; i < n_; ++i) {
      places[i] = options_.positions[i] + u(i);
      if (i > 0 && !(places[i] > places[i - 1]))
        throw Violation(time_, static_cast<std::int64_t>(i), places[i], "particles cross");
    }
    operators_ = options_.operators(places);
    Diagonals moved(operators_.second, c_ * c_);
    if (Diagonals::margin(moved.half_width()) > margin_)
      throw Violation(time_, -1, 0, "the particles have moved so close that a support holds many more of them");
    second_ = std::move(moved);
  }

  /// Largest eigenvalue of -c^2 D2 with free ends by power iteration from a vector that is largest where neighbours
  /// move against each other, and the step that follows.
  double find_limit() {
    std::vector<double> x = displacement_;
    std::vector<double> y(x.size());
    for (std::size_t i = 0; i < n_; ++i)
      x[margin_ + i] = (i % 2 == 0 ? 1 : -1) * (1 + 0.1 * std::sin(0.1 * static_cast<double>(i)));
    double squared = 0;
    constexpr int rounds = 400; // the ratio of norms settles like 1 / rounds where eigenvalues lie dense
    for (int round = 0; round < rounds; ++round) {
      std::swap(x, displacement_);
      set_end(0, 0);
      set_end(n_ - 1, 0);
      std::swap(x, displacement_);
      std::fill(y.begin(), y.end(), 0.0);
      add_product<false>(second_, &x[margin_], -1, 1, &y[margin_]);
      double norm_x = 0;
      double norm_y = 0;
      for (std::size_t i = 1; i + 1 < n_; ++i) {
        norm_x += x[margin_ + i] * x[margin_ + i];
        norm_y += y[margin_ + i] * y[margin_ + i];
      }
      squared = std::sqrt(norm_y / norm_x);
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = i > margin_ && i + 1 < margin_ + n_ ? y[i] / std::sqrt(norm_y) : 0;
    }
    const double delay = options_.viscosity ? options_.viscosity->diffusivity(c_, spacing_) / (c_ * c_) : 0;
    const double half = (options_.damping ? options_.damping->rate / squared : 0) + delay;
    return -half + std::sqrt(half * half + 4 / squared);
  }

  BarOptions options_;
  std::size_t n_;
  double spacing_;
  double c_;
  LineOperators operators_;
  Diagonals second_; ///< c^2 D2
  std::size_t margin_ = 0;
  std::vector<double> displacement_, velocity_;
  std::vector<double> stressing_; ///< of artificial viscosity
  double limit_ = 0;
  double time_ = 0;
  std::int64_t steps_ = 0;
  double work_ = 0;
  double most_work_ = 0;
  std::array<double, 4> counters_{};
};

ElasticBar::ElasticBar(const BarOptions &options) : implementation_(std::make_unique<Implementation>(options)) {}
ElasticBar::~ElasticBar() = default;
ElasticBar::ElasticBar(ElasticBar &&) noexcept = default;

std::int64_t ElasticBar::n_particles() const { return static_cast<std::int64_t>(displacement().size()); }
double ElasticBar::time() const { return implementation_->time(); }
std::int64_t ElasticBar::steps() const { return implementation_->steps(); }
double ElasticBar::wave_speed() const { return implementation_->c(); }
double ElasticBar::spacing() const { return implementation_->spacing(); }
double ElasticBar::growth_rate() const { return implementation_->growth_rate(); }
double ElasticBar::stable_step() const { return implementation_->limit(); }
void ElasticBar::step(double time_step) { implementation_->step(time_step); }
void ElasticBar::check() const { implementation_->check(); }
std::span<const double> ElasticBar::displacement() const {
  return implementation_->own(implementation_->displacement());
}
std::span<const double> ElasticBar::velocity() const { return implementation_->own(implementation_->velocity()); }
std::vector<double> ElasticBar::stress() const { return implementation_->stress(); }
double ElasticBar::energy() const { return implementation_->energy(); }
double ElasticBar::work() const { return implementation_->work(); }
State ElasticBar::state() { return implementation_->state(); }
void ElasticBar::adopt_state() { implementation_->adopt_state(); }
std::vector<effects::Usage> ElasticBar::usage() const { return implementation_->usage(); }
std::size_t ElasticBar::bytes() const { return implementation_->bytes(); }
std::int64_t ElasticBar::nonzeros() const { return implementation_->nonzeros(); }

} // namespace meshless::dynamics
