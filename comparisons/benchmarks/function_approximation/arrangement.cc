#include "comparisons/benchmarks/function_approximation/arrangement.h"

#include "comparisons/problems/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::benchmarks::function_approximation {

namespace {

/// Positions, volumes and spacing along one axis.
struct Axis {
  std::vector<double> positions;
  std::vector<double> volumes;
  std::vector<double> spacing;
};

Axis uniform_axis(int n) {
  Axis axis;
  for (int i = 0; i < n; ++i)
    axis.positions.push_back((i + 0.5) / n);
  axis.volumes.assign(axis.positions.size(), 1.0 / n);
  axis.spacing = axis.volumes;
  return axis;
}

Axis graded_axis(int n) {
  Axis axis;
  axis.positions.push_back(0);
  for (int i = 1; i < n; ++i)
    axis.positions.push_back(axis.positions.back() + 1 + 0.2 * (i - 1));
  const double length = axis.positions.back();
  for (double &x : axis.positions)
    x /= length;
  const std::size_t last = axis.positions.size() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    const double left = i == 0 ? 0 : axis.positions[i] - axis.positions[i - 1];
    const double right = i == last ? 0 : axis.positions[i + 1] - axis.positions[i];
    axis.volumes.push_back(0.5 * (left + right));
    // The larger of the two gaps: the support must reach two particles on the coarser side too.
    axis.spacing.push_back(std::max(left, right));
  }
  return axis;
}

} // namespace

template <int dim>
Arrangement<dim> arrange(const std::string &name, int n, double jitter, std::uint64_t seed) {
  if (n < 3)
    throw std::invalid_argument(fmt::format("{} particles along an axis; at least 3 are needed", n));
  if (name != "uniform" && name != "graded" && name != "jittered")
    throw std::invalid_argument(fmt::format("no arrangement '{}'; there are uniform, graded, jittered", name));
  const Axis axis = name == "graded" ? graded_axis(n) : uniform_axis(n);
  problems::Random random(seed);
  Arrangement<dim> result;
  std::array<std::size_t, dim> index{};
  const auto count = static_cast<std::size_t>(n);
  while (true) {
    std::array<double, dim> position{};
    double volume = 1;
    double spacing = 0;
    for (std::size_t k = 0; k < dim; ++k) {
      position[k] = axis.positions[index[k]];
      if (name == "jittered")
        position[k] += jitter * random.symmetric() * axis.spacing[index[k]];
      volume *= axis.volumes[index[k]];
      spacing = std::max(spacing, axis.spacing[index[k]]);
    }
    result.positions.push_back(position);
    result.volumes.push_back(volume);
    result.spacing.push_back(spacing);
    std::size_t k = 0;
    while (k < dim && ++index[k] == count)
      index[k++] = 0;
    if (k == dim)
      return result;
  }
}

template Arrangement<1> arrange<1>(const std::string &, int, double, std::uint64_t);
template Arrangement<2> arrange<2>(const std::string &, int, double, std::uint64_t);
template Arrangement<3> arrange<3>(const std::string &, int, double, std::uint64_t);

} // namespace comparisons::benchmarks::function_approximation
