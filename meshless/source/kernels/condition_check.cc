#include "meshless/kernels/constructing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

namespace meshless::kernels {

namespace {

/// Points on [0, kappa] at which sign and slope are looked at, besides the roots found between them.
constexpr int n_samples = 4000;

/// Integral of f over [low, high], stopping at the breaks.
double integral(const std::function<double(double)> &f, double low, double high, const std::vector<double> &breaks) {
  const auto &gauss = linear_algebra::cached_gauss_legendre(40);
  std::vector<double> ends{low};
  for (const double b : breaks)
    if (b > low && b < high)
      ends.push_back(b);
  ends.push_back(high);
  double sum = 0;
  for (std::size_t piece = 1; piece < ends.size(); ++piece) {
    const int n_panels = 1 + static_cast<int>((ends[piece] - ends[piece - 1]) / 2);
    const double panel = (ends[piece] - ends[piece - 1]) / n_panels;
    for (int i = 0; i < n_panels; ++i)
      for (std::size_t q = 0; q < gauss.points.size(); ++q)
        sum += gauss.weights[q] * panel * f(ends[piece - 1] + panel * (i + gauss.points[q]));
  }
  return sum;
}

/// Derivative of f at s from inside [s - length, s] by the polynomial through seven points.
double backward_derivative(const std::function<double(double)> &f, double s, double length) {
  constexpr double weights[] = {49. / 20, -6, 15. / 2, -20. / 3, 15. / 4, -6. / 5, 1. / 6};
  const double step = length / 6;
  double sum = 0;
  for (int i = 0; i < 7; ++i)
    sum += weights[i] * f(s - i * step);
  return sum / step;
}

/// Where f changes its sign between a and b.
double root(const std::function<double(double)> &f, double a, double b) {
  const bool positive = f(a) > 0;
  for (int i = 0; i < 80; ++i) {
    const double middle = .5 * (a + b);
    ((f(middle) > 0) == positive ? a : b) = middle;
  }
  return .5 * (a + b);
}

/// Intervals of (0, kappa) where f > threshold.
std::vector<std::pair<double, double>> positive_intervals(const std::function<double(double)> &f, double support,
                                                          double threshold) {
  const auto above = [&](double s) { return f(s) - threshold; };
  std::vector<std::pair<double, double>> intervals;
  double last = 0;
  bool inside = false;
  for (int i = 1; i < n_samples; ++i) {
    const double s = support * i / n_samples;
    const bool now = above(s) > 0;
    if (now && !inside)
      intervals.emplace_back(i == 1 ? 0 : root(above, last, s), support);
    if (!now && inside)
      intervals.back().second = root(above, last, s);
    inside = now;
    last = s;
  }
  return intervals;
}

/// Smallest value of f near its smallest sample, by golden section.
std::pair<double, double> least(const std::function<double(double)> &f, double support) {
  double best = 0;
  for (int i = 1; i <= n_samples; ++i)
    if (const double s = support * i / n_samples; f(s) < f(best))
      best = s;
  double a = std::max(0., best - support / n_samples);
  double b = std::min(support, best + support / n_samples);
  const double golden = .5 * (std::sqrt(5.) - 1);
  for (int i = 0; i < 60; ++i) {
    const double c = b - golden * (b - a);
    const double d = a + golden * (b - a);
    (f(c) < f(d) ? b : a) = f(c) < f(d) ? d : c;
  }
  const double refined = .5 * (a + b);
  return f(refined) < f(best) ? std::pair{refined, f(refined)} : std::pair{best, f(best)};
}

double largest_asymmetry(const SmoothingFunction &function) {
  double largest = 0;
  for (int i = 1; i < 200; ++i) {
    const double s = function.support * i / 200;
    largest = std::max(largest, std::abs(function.value(s) - function.value(-s)));
  }
  return largest;
}

std::array<double, 5> moments_of(const SmoothingFunction &function, int dim) {
  std::array<double, 5> moments{};
  for (int k = 0; k < 5; ++k) {
    const auto term = [&](double s) { return std::pow(s, k + dim - 1) * function.value(s); };
    const double outward = integral(term, 0, function.support, function.breaks);
    double &moment = moments[static_cast<std::size_t>(k)];
    if (dim > 1)
      moment = k % 2 == 0 ? sphere_surface(dim) * outward : 0;
    else {
      const auto mirrored = [&](double s) { return std::pow(-s, k) * function.value(-s); };
      moment = outward + integral(mirrored, 0, function.support, function.breaks);
    }
  }
  return moments;
}

void check_input(const SmoothingFunction &function, int dim) {
  if (dim < 1 || dim > 3)
    throw std::invalid_argument(fmt::format("a smoothing function in {} dimensions; there are 1, 2 and 3", dim));
  if (!(function.support > 0 && std::isfinite(function.support)))
    throw std::invalid_argument(fmt::format("a smoothing function with the support {}", function.support));
  for (int i = 0; i <= 100; ++i)
    if (const double s = function.support * i / 100; !std::isfinite(function.value(s)))
      throw std::invalid_argument(fmt::format("the smoothing function is not finite at S = {}", s));
}

} // namespace

SmoothingFunction smoothing_function(const Kernel &kernel, int dim) {
  const double factor = normalisation_of(kernel, dim);
  const double support = support_of(kernel);
  const auto visit = [=](const auto &what) {
    return [=](double s) { return std::abs(s) > support ? 0 : factor * std::visit(what(s), kernel); };
  };
  return {.value = visit([](double s) { return [s](const auto &k) { return k.value(s * s); }; }),
          .slope = visit([](double s) { return [s](const auto &k) { return s * k.slope(s * s); }; }),
          .curvature = visit([](double s) { return [s](const auto &k) { return k.curvature(s * s); }; }),
          .support = support,
          .breaks = breaks_of(kernel)};
}

ConditionReport check_conditions(const SmoothingFunction &function, int dim, double tolerance) {
  check_input(function, dim);
  const double kappa = function.support;
  const auto slope = [&](double s) {
    return function.slope ? function.slope(s) : backward_derivative(function.value, s, std::min(s, .02 * kappa));
  };
  ConditionReport report;
  report.moments = moments_of(function, dim);
  report.centre = function.value(0);
  report.edge_value = function.value(kappa);
  report.edge_slope = slope(kappa);
  if (function.curvature)
    report.edge_curvature = function.curvature(kappa);
  const double unit = std::abs(report.centre);
  const double rounding = function.slope ? 1e-14 * unit : 1e-8 * unit / kappa;
  std::tie(report.least_value_at, report.least_value) = least(function.value, kappa);
  report.negative = positive_intervals([&](double s) { return -function.value(s); }, kappa, 1e-14 * unit);
  report.rising = positive_intervals(slope, kappa, rounding);
  const double steepest_rise = -least([&](double s) { return s > 0 ? -slope(s) : 0; }, kappa).second;
  const double asymmetry = dim == 1 ? largest_asymmetry(function) : 0;
  const auto add = [&](Condition condition, std::string statement, bool holds, double figure) {
    report.conditions.push_back({condition, std::move(statement), holds, figure});
  };
  const auto vanishes = [&](double figure, double scale) { return std::abs(figure) <= tolerance * scale; };
  const double edge_tolerance = function.slope ? 1 : std::max(1., 1e-8 / tolerance);
  add(Condition::normalised, "integral of W = 1", vanishes(report.moments[0] - 1, 1), report.moments[0]);
  add(Condition::first_moment, "first moment = 0", vanishes(report.moments[1], kappa), report.moments[1]);
  add(Condition::second_moment, "second moment = 0", vanishes(report.moments[2], kappa * kappa), report.moments[2]);
  add(Condition::third_moment, "third moment = 0", vanishes(report.moments[3], std::pow(kappa, 3)), report.moments[3]);
  add(Condition::edge_value, "W = 0 at the edge", vanishes(report.edge_value, unit), report.edge_value);
  add(Condition::edge_slope, "W' = 0 at the edge", vanishes(report.edge_slope, edge_tolerance * unit / kappa),
      report.edge_slope);
  add(Condition::symmetric, "W(-S) = W(S)", asymmetry <= 1e-14 * unit, asymmetry);
  add(Condition::non_negative, "W >= 0", report.negative.empty(), report.least_value);
  add(Condition::monotone, "W decreases", report.rising.empty(), steepest_rise);
  return report;
}

} // namespace meshless::kernels
