#include "comparisons/problems/rectangle_grid.h"

#include "comparisons/problems/random.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <cmath>

namespace comparisons::problems {

RectangleGrid::RectangleGrid(const Point2 &lower, const Point2 &upper, std::array<int, 2> n, double jitter,
                             std::uint64_t seed)
    : lower_(lower), upper_(upper), n_(n) {
  Random random(seed);
  const std::array<double, 2> step{(upper[0] - lower[0]) / (n[0] - 1), (upper[1] - lower[1]) / (n[1] - 1)};
  points_.reserve(static_cast<std::size_t>(n[0]) * static_cast<std::size_t>(n[1]));
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j) {
      const std::array<int, 2> ij{i, j};
      Point2 point{};
      std::array<double, 2> move{random.symmetric() * jitter, random.symmetric() * jitter};
      const bool on_edge_1 = i == 0 || i == n[0] - 1;
      const bool on_edge_2 = j == 0 || j == n[1] - 1;
      if (on_edge_1)
        move[0] = 0;
      if (on_edge_2)
        move[1] = 0;
      if (on_edge_1 && on_edge_2)
        move = {0, 0};
      for (std::size_t k = 0; k < 2; ++k)
        // The last point is the corner itself, to the last bit.
        point[k] = ij[k] == n[k] - 1 ? upper[k] : lower[k] + step[k] * (ij[k] + move[k]);
      points_.push_back(point);
    }
}

double RectangleGrid::spacing() const {
  return std::min((upper_[0] - lower_[0]) / (n_[0] - 1), (upper_[1] - lower_[1]) / (n_[1] - 1));
}

Cloud RectangleGrid::cloud() const { return {points_, std::vector<double>(points_.size(), spacing()), {}, true}; }

Mesh RectangleGrid::mesh() const {
  Mesh mesh;
  mesh.vertices = points_;
  const auto vertex = [&](int i, int j) { return static_cast<unsigned>(index(i, j)); };
  for (int i = 0; i + 1 < n_[0]; ++i)
    for (int j = 0; j + 1 < n_[1]; ++j)
      mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
  for (int j = 0; j + 1 < n_[1]; ++j) {
    mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    mesh.boundary.push_back({{vertex(n_[0] - 1, j), vertex(n_[0] - 1, j + 1)}, 1});
  }
  for (int i = 0; i + 1 < n_[0]; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 2});
    mesh.boundary.push_back({{vertex(i, n_[1] - 1), vertex(i + 1, n_[1] - 1)}, 3});
  }
  return mesh;
}

Quadrature RectangleGrid::quadrature() const {
  // Five points a direction integrate the squared error of cubic elements exactly; no method uses
  // this rule for itself.
  const auto gauss = meshless::linear_algebra::gauss_legendre(5);
  const int longer = std::max(n_[0], n_[1]) - 1;
  const int parts = (24 + longer - 1) / longer;
  const int nx = (n_[0] - 1) * parts;
  const int ny = (n_[1] - 1) * parts;
  const double dx = (upper_[0] - lower_[0]) / nx;
  const double dy = (upper_[1] - lower_[1]) / ny;
  Quadrature quadrature;
  const std::size_t n = static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny) * 25;
  quadrature.points.reserve(n);
  quadrature.weights.reserve(n);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = 0; b < 5; ++b) {
          quadrature.points.push_back({lower_[0] + dx * (i + gauss.points[a]), lower_[1] + dy * (j + gauss.points[b])});
          quadrature.weights.push_back(dx * dy * gauss.weights[a] * gauss.weights[b]);
        }
  return quadrature;
}

std::vector<BoundaryPiece> rectangle_boundary(const Point2 &lower, const Point2 &upper) {
  const Point2 south_east{upper[0], lower[1]};
  const Point2 north_west{lower[0], upper[1]};
  return {{lower, south_east, 2, "bottom"},
          {south_east, upper, 1, "right"},
          {upper, north_west, 3, "top"},
          {north_west, lower, 0, "left"}};
}

std::vector<Corner> rectangle_corners(const Point2 &lower, const Point2 &upper) {
  return {{"NE", upper}, {"SE", {upper[0], lower[1]}}, {"SW", lower}, {"NW", {lower[0], upper[1]}}};
}

} // namespace comparisons::problems
