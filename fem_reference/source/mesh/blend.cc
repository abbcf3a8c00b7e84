#include "topology.h"

namespace fem_reference::mesh {
namespace {
void add(Point &x, double factor, Point y) {
  x[0] += factor * y[0];
  x[1] += factor * y[1];
}

/// Coons' patch: the bilinear map and, linearly blended across, how far each side leaves its chord.
Point blend_quadrilateral(std::span<const Point> corners, std::span<const Curve *const> sides, Point xi) {
  const auto [s, t] = xi;
  Point x{};
  add(x, (1 - s) * (1 - t), corners[0]);
  add(x, s * (1 - t), corners[1]);
  add(x, s * t, corners[2]);
  add(x, (1 - s) * t, corners[3]);
  const std::array<double, 4> along = {s, t, 1 - s, 1 - t};
  const std::array<double, 4> weight = {1 - t, s, t, 1 - s};
  for (std::size_t k = 0; k < 4; ++k)
    if (sides[k] != nullptr && weight[k] != 0)
      add(x, weight[k], sides[k]->deviation(along[k]));
  return x;
}

/// Szabo and Babuska (1991), section 6.1: the deviation d(t) of the side between corners a and b enters as
/// lambda_a lambda_b d(t) / (t (1 - t)), t = (1 + lambda_b - lambda_a) / 2. Since d vanishes at both ends the
/// quotient is smooth, and derivatives of the map decrease as those of d: full order on curved cells.
Point blend_triangle(std::span<const Point> corners, std::span<const Curve *const> sides, Point xi) {
  const std::array<double, 3> lambda = {1 - xi[0] - xi[1], xi[0], xi[1]};
  Point x{};
  for (std::size_t k = 0; k < 3; ++k)
    add(x, lambda[k], corners[k]);
  for (std::size_t k = 0; k < 3; ++k) {
    const double a = lambda[k];
    const double b = lambda[(k + 1) % 3];
    if (sides[k] == nullptr || a * b == 0)
      continue;
    const double t = .5 * (1 + b - a);
    add(x, a * b / (t * (1 - t)), sides[k]->deviation(t));
  }
  return x;
}
} // namespace

Point blend(std::span<const Point> corners, std::span<const Curve *const> sides, Point xi) {
  return corners.size() == 3 ? blend_triangle(corners, sides, xi) : blend_quadrilateral(corners, sides, xi);
}
} // namespace fem_reference::mesh
