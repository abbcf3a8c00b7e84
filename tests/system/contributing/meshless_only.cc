// The meshless library alone: a function and its derivative from scattered values by SSPH, errors below Taylor's bound.
#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/ssph.h"
#include <cmath>
#include <fmt/format.h>

int main() {
  using namespace meshless;
  std::vector<cloud::Point<2>> positions; // 21 x 21 on the unit square, moved by up to 0.02
  for (double a = 0; a < 1.01; a += 0.05)
    for (double b = 0; b < 1.01; b += 0.05)
      positions.push_back({a + 0.02 * std::sin(9 * b), b + 0.02 * std::sin(7 * a)});
  const double h = 0.05;
  const cloud::Particles<2> particles(positions, std::vector<double>(positions.size(), h));
  const auto ssph = basis::make_ssph<2>(2, kernels::Gauss(3)); // order 2, support 3 h
  const cloud::CandidateSearch<2> search(particles, ssph->support());

  const auto f = [](const cloud::Point<2> &x) { return std::sin(x[0] + x[1]); };
  // Quadratics are exact; what remains of f within the support is at most |third derivative| (3 h)^3 / 6.
  const double remainder = std::pow(std::sqrt(2.0) * 3 * h, 3) / 6;
  const std::vector<cloud::Point<2>> points{{0.5, 0.5}, {0.31, 0.77}, {0.02, 0.02}};
  bool within_bounds = true;
  basis::GroupedEvaluation<2>(*ssph, search).visit(points, {.value = true, .gradient = true}, [&](const auto &group) {
    for (std::size_t i = 0; i < group.points.size(); ++i) {
      const auto &x = points[group.points[i]];
      double value = 0, slope = 0, value_sum = 0, slope_sum = 0; // the sums are of |shape functions|
      for (std::size_t j = 0; j < group.n_neighbours(i); ++j) {
        const double phi = group.values.value(j)[i], phi_1 = group.values.gradient(0, j)[i];
        const double f_j = f(particles.position(group.neighbour(j, i)));
        value += phi * f_j, slope += phi_1 * f_j;
        value_sum += std::abs(phi), slope_sum += std::abs(phi_1);
      }
      const double error = std::abs(value - f(x)), slope_error = std::abs(slope - std::cos(x[0] + x[1]));
      fmt::print("({}, {}): error of f {:.1e} <= {:.1e}, of df/dx1 {:.1e} <= {:.1e}\n", x[0], x[1], error,
                 value_sum * remainder, slope_error, slope_sum * remainder);
      within_bounds = within_bounds && error <= value_sum * remainder && slope_error <= slope_sum * remainder;
    }
  });
  return within_bounds ? 0 : 1;
}
