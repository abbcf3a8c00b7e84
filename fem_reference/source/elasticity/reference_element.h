#pragma once

#include <array>
#include <vector>

namespace fem_reference::elasticity {
inline constexpr int max_degree = 4;
inline constexpr int max_nodes_1d = max_degree + 1;

/// Lagrange polynomials on [0, 1] with nodes at the Gauss-Lobatto points, as deal.II's FE_Q.
class LagrangeBasis {
public:
  using Values = std::array<double, max_nodes_1d>;

  explicit LagrangeBasis(int degree);

  int degree() const { return degree_; }
  double node(int k) const { return nodes_[static_cast<std::size_t>(k)]; }

  /// All degree + 1 polynomials and their derivatives at one point.
  void evaluate(double x, Values &values, Values &derivatives) const;

private:
  int degree_;
  Values nodes_{};
  Values scale_{}; // 1 / prod_{l != k} (x_k - x_l)
};

/// Gauss quadrature on [0, 1].
struct Quadrature1d {
  std::vector<double> points;
  std::vector<double> weights;
};
Quadrature1d gauss_quadrature(int n_points);

/// Shape functions of Qp, nodes in lexicographic order, at the points of a tensor Gauss quadrature:
/// values[q * n_nodes + a], gradients_i[q * n_nodes + a] = d N_a / d xi_i.
struct ShapeTable {
  ShapeTable(int degree, int n_points_1d);

  int n_nodes;
  int n_points;
  std::vector<double> weights;
  std::vector<double> values;
  std::vector<double> gradients_1;
  std::vector<double> gradients_2;
};
} // namespace fem_reference::elasticity
