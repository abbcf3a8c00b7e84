#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace fem_reference::approximation {

/// Interpolation of a function on the unit interval, square or cube by Lagrange elements Q1 to Q4 with
/// equidistant nodes on a uniform grid of deal.II cells.
template <int dim>
class LagrangeInterpolant {
public:
  using Point = std::array<double, dim>;

  /// @param function value at a point
  /// @param degree 1 to 4
  /// @param n_cells cells along each axis, >= 1
  /// @throws std::invalid_argument outside of these ranges
  LagrangeInterpolant(const std::function<double(const Point &)> &function, int degree, int n_cells);
  ~LagrangeInterpolant();

  std::size_t n_dofs() const;

  /// Values of the interpolant, of its gradient and of its second derivatives (k, l), k <= l, in the
  /// order 11, 12, .., 22, ..; derivatives are those inside the cell that holds the point (of two the one of
  /// lower index). Spans may be empty for what is not wanted.
  void evaluate(std::span<const Point> points, std::span<double> values, std::span<Point> gradients,
                std::span<std::array<double, dim *(dim + 1) / 2>> hessians) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace fem_reference::approximation
