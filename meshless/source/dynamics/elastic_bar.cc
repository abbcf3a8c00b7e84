#include "meshless/dynamics/elastic_bar.h"

#include "bar_step.h"

#include "meshless/dynamics/violation.h"
#include "meshless/linear_algebra/diagonals.h"
#include "meshless/linear_algebra/eigenvalues.h"
#include "meshless/linear_algebra/floating_point_traps.h"
#include "meshless/linear_algebra/pack.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace meshless::dynamics {

using linear_algebra::Diagonals;
using linear_algebra::FloatingPointTraps;
using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

namespace {

/// Steps between two checks; a factor of 1.5 in energy is far above what the pulse's own error makes (2 %) and far
/// below what an instability reaches in a few hundred steps.
constexpr std::int64_t check_interval = 200;
constexpr double most_energy = 1.5;

} // namespace

class ElasticBar::Implementation {
public:
  explicit Implementation(const BarOptions &options)
      : options_(options), n_(options.positions.size()), spacing_(least_spacing(options)),
        c_(std::sqrt(options.youngs_modulus / options.density)), operators_(options.operators(options.positions)),
        first_(operators_.first, options.youngs_modulus), second_(operators_.second, c_ * c_) {
    if (n_ < 5)
      throw std::invalid_argument(fmt::format("a bar needs five particles; found {}", n_));
    if (!(options.youngs_modulus > 0) || !(options.density > 0))
      throw std::invalid_argument("Young's modulus and density of a bar are positive");
    margin_ = Diagonals::margin(std::max(first_.half_width(), second_.half_width()));
    displacement_.assign(n_ + 2 * margin_, 0.0);
    velocity_ = displacement_;
    if (options.viscosity)
      stressing_ = displacement_;
    weights_ = displacement_;
    for (std::size_t i = 0; i < n_; ++i)
      weights_[margin_ + i] = 0.25 * ((i > 0 ? options.positions[i] - options.positions[i - 1] : 0) +
                                      (i + 1 < n_ ? options.positions[i + 1] - options.positions[i] : 0));
    prepare_rows();
    left_stress_ = stress_of(options_.left_stress);
    right_stress_ = stress_of(options_.right_stress);
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
    const double left_before = left_stress_;
    const double right_before = right_stress_;
    time_ += dt;
    ++steps_;
    left_stress_ = stress_of(options_.left_stress); // before the loop, which hides how long it takes
    right_stress_ = stress_of(options_.right_stress);
    {
      const FloatingPointTraps traps; // energy is checked long before it overflows
      step_(arrays_, {.length = dt, .left_stress = left_stress_, .right_stress = right_stress_});
    }
    const double *u = &displacement_[margin_];
    work_ += 0.5 * ((right_before + right_stress_) * (u[n_ - 1] - last_before) -
                    (left_before + left_stress_) * (u[0] - first_before));
    most_work_ = std::max(most_work_, std::abs(work_));
    if (steps_ % check_interval == 0)
      check();
  }

  /// A sum of squares is not finite if a value is not.
  void check() const {
    const double sum = energy();
    if (sum <= most_energy * most_work_)
      return;
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
    throw Violation(time_, static_cast<std::int64_t>(place), options_.positions[place],
                    fmt::format("the energy {:.4g} J/m^2 is {:.3g} times the work put in: the scheme is unstable at "
                                "any time step (this particle is the fastest, {:.3g} m/s)",
                                sum, sum / most_work_, fastest));
  }

  double energy() const {
    const double *u = &displacement_[margin_];
    const double *v = &velocity_[margin_];
    const double *weights = &weights_[margin_]; // zero beyond the last particle
    return with_half_width(first_.half_width(), [&]<int half_width>() {
      const RowProducts<half_width> product(first_);
      Pack sum = 0;
      for (std::size_t i = 0; i < n_; i += n_lanes) {
        const Pack sigma = product(u, i);
        const Pack speed = load(v + i);
        sum += load(weights + i) * (options_.density * speed * speed + (1 / options_.youngs_modulus) * sigma * sigma);
      }
      return reduce(sum);
    });
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
    left_stress_ = stress_of(options_.left_stress);
    right_stress_ = stress_of(options_.right_stress);
  }

  std::vector<effects::Usage> usage() const {
    std::vector<effects::Usage> all{{"elasticity", first_.bytes() + second_.bytes(), steps_}, {"inertia", 0, steps_}};
    if (options_.viscosity)
      all.push_back({"artificial_viscosity", stressing_.capacity() * sizeof(double), steps_});
    if (options_.damping)
      all.push_back({"damping", 0, steps_});
    return all;
  }

  std::size_t bytes() const {
    return first_.bytes() + second_.bytes() +
           (displacement_.capacity() + velocity_.capacity() + stressing_.capacity() + weights_.capacity()) *
               sizeof(double);
  }

  const BarOptions &options() const { return options_; }
  std::span<const double> own(const linear_algebra::AlignedVector &field) const { return {&field[margin_], n_}; }
  const linear_algebra::AlignedVector &displacement() const { return displacement_; }
  const linear_algebra::AlignedVector &velocity() const { return velocity_; }
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

  double stress_of(const std::function<double(double)> &end) const { return end ? end(time_) : 0; }

  /// What follows from the operators.
  void prepare_rows() {
    const FloatingPointTraps traps; // the end rows are divided by their own entry
    using effects::Absent;
    const std::size_t w = second_.half_width();
    if (options_.viscosity)
      step_ = options_.damping ? bar_step_for<effects::LinearViscosity, effects::Damping>(w)
                               : bar_step_for<effects::LinearViscosity, Absent>(w);
    else
      step_ = options_.damping ? bar_step_for<Absent, effects::Damping>(w) : bar_step_for<Absent, Absent>(w);
    arrays_ = {.rows = &second_,
               .ends = {EndRow(operators_.first, 0, options_.youngs_modulus),
                        EndRow(operators_.first, n_ - 1, options_.youngs_modulus)},
               .displacement = &displacement_[margin_],
               .velocity = &velocity_[margin_]};
    if (options_.viscosity) { // c^2 D2 u + b c D D2 v = c^2 D2 (u + b D / c v)
      arrays_.stressing = &stressing_[margin_];
      arrays_.delay = options_.viscosity->diffusivity(c_, spacing_) / (c_ * c_);
    }
    if (options_.damping)
      arrays_.damping = options_.damping->rate;
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
    Diagonals moved_first(operators_.first, options_.youngs_modulus);
    if (Diagonals::margin(std::max(moved.half_width(), moved_first.half_width())) > margin_)
      throw Violation(time_, -1, 0, "the particles have moved so close that a support holds many more of them");
    second_ = std::move(moved);
    first_ = std::move(moved_first);
    prepare_rows();
  }

  /// Largest eigenvalue of -c^2 D2 with free ends by power iteration from a vector that is largest where neighbours
  /// move against each other, and the step that follows.
  double find_limit() {
    const FloatingPointTraps traps;
    linear_algebra::AlignedVector x = displacement_;
    linear_algebra::AlignedVector y(x.size());
    for (std::size_t i = 0; i < n_; ++i)
      x[margin_ + i] = (i % 2 == 0 ? 1 : -1) * (1 + 0.1 * std::sin(0.1 * static_cast<double>(i)));
    const RowProducts<any_width> product(second_);
    double squared = 0;
    constexpr int rounds = 400; // the ratio of norms settles like 1 / rounds where eigenvalues lie dense
    for (int round = 0; round < rounds; ++round) {
      x[margin_] = arrays_.ends[0].displacement(0, &x[margin_]);
      x[margin_ + n_ - 1] = arrays_.ends[1].displacement(0, &x[margin_]);
      for (std::size_t i = 0; i < n_; i += n_lanes)
        store(-product(&x[margin_], i), &y[margin_ + i]);
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
    const double half = arrays_.damping / squared + arrays_.delay;
    return -half + std::sqrt(half * half + 4 / squared);
  }

  BarOptions options_;
  std::size_t n_;
  double spacing_;
  double c_;
  LineOperators operators_;
  Diagonals first_;  ///< E D1
  Diagonals second_; ///< c^2 D2
  BarArrays arrays_;
  BarStep step_ = nullptr;
  std::size_t margin_ = 0;
  linear_algebra::AlignedVector displacement_, velocity_;
  linear_algebra::AlignedVector stressing_; ///< of artificial viscosity
  linear_algebra::AlignedVector weights_;   ///< half of a particle's length, m
  double limit_ = 0;
  double time_ = 0;
  std::int64_t steps_ = 0;
  double left_stress_ = 0; ///< at the present time
  double right_stress_ = 0;
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
