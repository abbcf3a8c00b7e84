#pragma once

#include "meshless/cloud/particles.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

/// Clouds of particles for the tests of meshless, the same on every machine.
namespace sample_clouds {

using meshless::cloud::Point;

/// Uniform on [0, 1); the distributions of the standard library differ between implementations.
class Uniform {
public:
  explicit Uniform(std::uint64_t seed) : engine_(seed) {}
  double operator()() { return std::ldexp(static_cast<double>(engine_() >> 11), -53); }
  double between(double low, double high) { return low + (high - low) * (*this)(); }

private:
  std::mt19937_64 engine_;
};

template <int dim>
std::vector<Point<dim>> random_points(std::size_t n, const Point<dim> &low, const Point<dim> &high,
                                      std::uint64_t seed) {
  Uniform random(seed);
  std::vector<Point<dim>> points(n);
  for (auto &x : points)
    for (int k = 0; k < dim; ++k)
      x[k] = random.between(low[k], high[k]);
  return points;
}

/// n[0] x n[1] x ... particles on the box, its faces included; the first axis varies slowest.
template <int dim>
std::vector<Point<dim>> grid(const std::array<int, dim> &n, const Point<dim> &low, const Point<dim> &high) {
  std::vector<Point<dim>> points(1, Point<dim>{});
  for (int k = 0; k < dim; ++k) {
    std::vector<Point<dim>> longer;
    for (auto x : points)
      for (int i = 0; i < n[k]; ++i) {
        x[k] = i == n[k] - 1 ? high[k] : low[k] + (high[k] - low[k]) * i / (n[k] - 1);
        longer.push_back(x);
      }
    points = std::move(longer);
  }
  return points;
}

/// A grid whose particles are moved by up to `fraction` of the spacing along every axis. Particles
/// of a face stay on it, those of a corner where they are.
template <int dim>
std::vector<Point<dim>> jittered_grid(const std::array<int, dim> &n, const Point<dim> &low, const Point<dim> &high,
                                      double fraction, std::uint64_t seed) {
  Uniform random(seed);
  auto points = grid<dim>(n, low, high);
  for (auto &x : points)
    for (int k = 0; k < dim; ++k) {
      const double shift = fraction * (high[k] - low[k]) / (n[k] - 1) * random.between(-1, 1);
      if (x[k] != low[k] && x[k] != high[k])
        x[k] += shift;
    }
  return points;
}

/// A grid of the unit box whose spacing doubles from one end to the other: x -> x (2 + x) / 3.
template <int dim>
std::vector<Point<dim>> graded_grid(const std::array<int, dim> &n) {
  Point<dim> low{};
  Point<dim> high;
  high.fill(1);
  auto points = grid<dim>(n, low, high);
  for (auto &x : points)
    for (int k = 0; k < dim; ++k)
      x[k] = x[k] * (2 + x[k]) / 3;
  return points;
}

/// A cloud with h = factor times the mean distance of the four nearest (two in one dimension).
template <int dim>
meshless::cloud::Particles<dim> with_mean_lengths(std::vector<Point<dim>> points, double factor = 1) {
  auto h = meshless::cloud::smoothing_lengths_by_mean<dim>(points, dim == 1 ? 2 : 4, factor);
  return {std::move(points), std::move(h)};
}

} // namespace sample_clouds
