#pragma once

#include "fem_reference/mesh/plane_mesh.h"

#include <array>
#include <span>
#include <vector>

namespace fem_reference::elasticity {
inline constexpr int max_degree = 4;
inline constexpr int max_nodes_1d = max_degree + 1;
inline constexpr int max_nodes = max_nodes_1d * max_nodes_1d;

/// Lagrange polynomials on [0, 1] with nodes at the Gauss-Lobatto points, as deal.II's FE_Q, or at given ones.
class LagrangeBasis {
public:
  using Values = std::array<double, max_nodes_1d>;

  explicit LagrangeBasis(int degree);
  explicit LagrangeBasis(std::span<const double> nodes);

  int degree() const { return degree_; }
  double node(int k) const { return nodes_[static_cast<std::size_t>(k)]; }

  /// All degree + 1 polynomials and their derivatives at one point.
  void evaluate(double x, Values &values, Values &derivatives) const;

private:
  void set_scale();

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

/// Quadrature on the unit square (4 vertices) or the triangle (0, 0), (1, 0), (0, 1) (3 vertices), exact for
/// polynomials of degree 2 n - 1, in each variable on the square. Gauss, and Witherden and Vincent (2015).
struct Quadrature2d {
  std::vector<mesh::Point> points;
  std::vector<double> weights;
};
Quadrature2d cell_quadrature(unsigned n_vertices, int n);

/// Qp on the unit square, nodes in lexicographic order (xi_1 fastest), or Pp on the triangle (0, 0), (1, 0),
/// (0, 1): corners, then the nodes inside sides 0, 1, 2 counter-clockwise, then those inside. On sides both have the
/// Gauss-Lobatto points, so that triangles and quadrilaterals of one degree fit together.
class ReferenceElement {
public:
  using Values = std::array<double, max_nodes>;

  ReferenceElement(unsigned n_vertices, int degree);

  unsigned n_vertices() const { return n_vertices_; }
  int degree() const { return line_.degree(); }
  unsigned n_nodes() const { return static_cast<unsigned>(nodes_.size()); }
  std::span<const mesh::Point> nodes() const { return nodes_; }
  mesh::Point centre() const { return n_vertices_ == 3 ? mesh::Point{1. / 3, 1. / 3} : mesh::Point{.5, .5}; }
  /// The one-dimensional basis on a side.
  const LagrangeBasis &line() const { return line_; }
  /// Nodes k = 0 ... degree of a side, counter-clockwise; side k begins at corner k.
  std::span<const unsigned> side(unsigned k) const { return sides_[k]; }
  unsigned corner(unsigned k) const { return sides_[k].front(); }
  /// Nodes on no side.
  std::span<const unsigned> inside() const { return inside_; }

  /// Shape functions and their derivatives along xi_1 and xi_2.
  void evaluate(mesh::Point xi, Values &values, Values &gradient_1, Values &gradient_2) const;

  /// Whether xi lies in the element within a tolerance.
  bool contains(mesh::Point xi, double tolerance) const;
  /// The point of side k at parameter t.
  mesh::Point on_side(unsigned k, double t) const;
  /// xi moved into the element enlarged by `margin` on all sides.
  mesh::Point limited(mesh::Point xi, double margin) const;

private:
  void make_quadrilateral();
  void make_triangle();
  void evaluate_triangle(mesh::Point xi, Values &values, Values &gradient_1, Values &gradient_2) const;

  unsigned n_vertices_;
  LagrangeBasis line_;
  std::vector<mesh::Point> nodes_;
  std::array<std::vector<unsigned>, 4> sides_;
  std::vector<unsigned> inside_;
  /// Triangle: N_a = sum_b coefficients_[b * n_nodes + a] B_b in the Bernstein polynomials B_b.
  std::vector<double> coefficients_;
};

/// Shape functions of an element at quadrature points:
/// values[q * n_nodes + a], gradients_i[q * n_nodes + a] = d N_a / d xi_i.
struct ShapeTable {
  ShapeTable(const ReferenceElement &element, const Quadrature2d &quadrature);

  int n_nodes;
  int n_points;
  std::vector<double> weights;
  std::vector<double> values;
  std::vector<double> gradients_1;
  std::vector<double> gradients_2;
};
} // namespace fem_reference::elasticity
