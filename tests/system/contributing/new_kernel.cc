// A new kernel: its class, its line of the table, its conditions by quadrature, and an SSPH estimate with it.

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/ssph.h"
#include "meshless/basis/taylor_projection.h"
#include "meshless/kernels/constructing.h"
#include "meshless/kernels/elementary.h"
#include "meshless/kernels/kernel_table.h"
#include "system/contributing/checks.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace meshless::kernels {

/// Wendland's C2 function of three dimensions, Wendland 1995, scaled to the support 2: with u = s / 2,
///   W(s) = G / h^dim (1 - u)^4 (1 + 4 u) for s <= 2, else 0.
/// W''' is continuous at the edge. Value, slope and curvature as in kernels/gauss.h.
class WendlandC2 {
public:
  static constexpr double support() { return 2; }

  /// 3 / 4, 7 / (4 pi), 21 / (16 pi).
  static constexpr double normalisation(int dim) {
    return dim == 1 ? .75 : (dim == 2 ? 1.75 : 21. / 16) / std::numbers::pi;
  }

  template <typename T>
  T value(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    const T squared = (1 - u) * (1 - u);
    return squared * squared * (1 + 4 * u);
  }

  template <typename T>
  T slope(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    return -5 * (1 - u) * (1 - u) * (1 - u);
  }

  template <typename T>
  T curvature(const T &s_squared) const {
    const T u = .5 * square_root(s_squared);
    return -5 * (1 - u) * (1 - u) * (1 - 4 * u);
  }
};

/// The line of the table in kernel_table.cc.
constexpr KernelDescription wendland_c2_line = {.name = "wendland_c2",
                                                .meaning = "(1 - s/2)^4 (1 + 2 s), Wendland 1995",
                                                .free_support = false,
                                                .parameter = "",
                                                .default_parameter = 0,
                                                .support = 2,
                                                .non_negative = true,
                                                .monotone = true,
                                                .edge_smoothness = 3,
                                                .kink = false,
                                                .gaussian = false};

} // namespace meshless::kernels

namespace {

using namespace meshless;

/// The kernel as the conditions of Liu, Liu & Lam 2003 see it.
template <typename K>
kernels::SmoothingFunction smoothing_function_of(const K &kernel, int dim) {
  const double factor = kernel.normalisation(dim);
  return {.value = [=](double s) { return factor * kernel.value(s * s); },
          .slope = [=](double s) { return factor * s * kernel.slope(s * s); },
          .curvature = [=](double s) { return factor * kernel.curvature(s * s); },
          .support = kernel.support()};
}

void check_class(contributing::Checks &checks) {
  const kernels::WendlandC2 kernel;
  using kernels::Condition;
  for (int dim = 1; dim <= 3; ++dim) {
    const auto report = kernels::check_conditions(smoothing_function_of(kernel, dim), dim);
    // Gauss quadrature is exact for polynomials: rounding remains.
    checks.near(fmt::format("integral in {}D", dim), report.moments[0], 1, 1e-13);
    for (const auto condition : {Condition::symmetric, Condition::edge_value, Condition::edge_slope})
      checks.holds(report[condition].statement, report[condition].holds);
    checks.holds("non-negative as the table says",
                 report[Condition::non_negative].holds == kernels::wendland_c2_line.non_negative);
    checks.holds("monotone as the table says", report[Condition::monotone].holds == kernels::wendland_c2_line.monotone);
  }
  // Central differences: e^2 / 6 times a derivative below 100, and rounding 1e-16 / e.
  const double e = 1e-5;
  const auto value = [&](double s) { return kernel.value(s * s); };
  const auto derivative = [&](double s) { return s * kernel.slope(s * s); };
  for (const double s : {0.1, 0.7, 1.3, 1.9}) {
    checks.near("slope", derivative(s), (value(s + e) - value(s - e)) / (2 * e), 1e-8);
    checks.near("curvature", kernel.curvature(s * s), (derivative(s + e) - derivative(s - e)) / (2 * e), 1e-8);
    // The same in every SIMD lane; the compiler may contract products differently.
    const linear_algebra::Pack pack(s * s);
    checks.near("value in a SIMD lane", kernel.value(pack)[0], value(s), 1e-15);
    checks.near("slope in a SIMD lane", kernel.slope(pack)[0], kernel.slope(s * s), 5e-15);
    checks.near("curvature in a SIMD lane", kernel.curvature(pack)[0], kernel.curvature(s * s), 5e-15);
  }
}

/// Value and first derivative of f at x by SSPH of second order on a line, Batra & Zhang 2008, (2.11), and the sums of
/// the absolute shape functions. The library does the same for every kernel of its table.
struct Estimate {
  double value = 0, slope = 0, value_sum = 0, slope_sum = 0;
};

template <typename K, typename F>
Estimate estimate(const K &kernel, const std::vector<double> &places, double h, double x, const F &f) {
  std::vector<double> near;
  for (const double place : places)
    if (std::abs(place - x) < kernel.support() * h)
      near.push_back(place);
  basis::TaylorProjection projection;
  projection.resize(3, near.size());
  for (std::size_t j = 0; j < near.size(); ++j) {
    const double s = (near[j] - x) / h;
    const double terms[] = {1, s, s * s};
    for (std::size_t i = 0; i < 3; ++i) {
      projection.terms(j)[i] = terms[i];
      projection.tests(j)[i] = terms[i] * kernel.value(s * s);
    }
  }
  projection.factorise();
  std::vector<double> value(near.size()), slope(near.size());
  projection.shape_functions(0, 1, value);
  projection.shape_functions(1, 1 / h, slope);
  Estimate result;
  for (std::size_t j = 0; j < near.size(); ++j) {
    result.value += value[j] * f(near[j]);
    result.slope += slope[j] * f(near[j]);
    result.value_sum += std::abs(value[j]);
    result.slope_sum += std::abs(slope[j]);
  }
  return result;
}

void check_estimate(contributing::Checks &checks) {
  const double h = 0.05;
  std::vector<double> places;
  std::vector<cloud::Point<1>> positions;
  for (int i = 0; i <= 20; ++i) {
    places.push_back(0.05 * i + 0.01 * std::sin(5.0 * i));
    positions.push_back({places.back()});
  }
  const kernels::WendlandC2 wendland;
  const auto sine = [](double x) { return std::sin(x); };
  const auto quadratic = [](double x) { return 3 * x * x - x + 2; };
  // Quadratics are exact, so that only Taylor's remainder of the sine within the support, |x - x_j|^3 / 6, is left.
  const double remainder = std::pow(wendland.support() * h, 3) / 6;
  for (const double x : {0.0, 0.33, 0.5}) {
    const auto exact = estimate(wendland, places, h, x, quadratic);
    checks.near("f of a quadratic", exact.value, quadratic(x), 1e-13 * exact.value_sum);
    checks.near("df/dx of a quadratic", exact.slope, 6 * x - 1, 1e-13 * exact.slope_sum);
    const auto found = estimate(wendland, places, h, x, sine);
    checks.near("f of the sine", found.value, std::sin(x), remainder * found.value_sum);
    checks.near("df/dx of the sine", found.slope, std::cos(x), remainder * found.slope_sum);
  }

  // That this is the library's SSPH is shown with a kernel of the table.
  const cloud::Particles<1> particles(positions, std::vector<double>(positions.size(), h));
  const auto ssph = basis::make_ssph<1>(2, kernels::CubicSpline());
  const cloud::CandidateSearch<1> search(particles, ssph->support());
  const std::vector<cloud::Point<1>> point{{0.33}};
  basis::GroupedEvaluation<1>(*ssph, search).visit(point, {.gradient = true}, [&](const auto &group) {
    double slope = 0;
    for (std::size_t j = 0; j < group.n_neighbours(0); ++j)
      slope += group.values.gradient(0, j)[0] * sine(particles.position(group.neighbour(j, 0))[0]);
    const auto by_hand = estimate(kernels::CubicSpline(), places, h, 0.33, sine);
    // Rounding times the condition of a small moment matrix.
    checks.near("the library's SSPH", slope, by_hand.slope, 1e-13 * by_hand.slope_sum);
  });
}

} // namespace

int main() {
  contributing::Checks checks;
  check_class(checks);
  check_estimate(checks);
  return checks.exit_code();
}
