#include "reference_element.h"

#include <algorithm>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

namespace fem_reference::elasticity {
LagrangeBasis::LagrangeBasis(int degree) : degree_(degree) {
  const dealii::QGaussLobatto<1> points(static_cast<unsigned>(degree) + 1);
  for (int k = 0; k <= degree; ++k)
    nodes_[static_cast<std::size_t>(k)] = points.point(static_cast<unsigned>(k))[0];
  set_scale();
}

LagrangeBasis::LagrangeBasis(std::span<const double> nodes) : degree_(static_cast<int>(nodes.size()) - 1) {
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
  set_scale();
}

void LagrangeBasis::set_scale() {
  for (int k = 0; k <= degree_; ++k) {
    double product = 1;
    for (int l = 0; l <= degree_; ++l)
      if (l != k)
        product *= node(k) - node(l);
    scale_[static_cast<std::size_t>(k)] = 1 / product;
  }
}

void LagrangeBasis::evaluate(double x, Values &values, Values &derivatives) const {
  for (int k = 0; k <= degree_; ++k) {
    double value = scale_[static_cast<std::size_t>(k)];
    double derivative = 0;
    for (int l = 0; l <= degree_; ++l)
      if (l != k) {
        derivative = derivative * (x - node(l)) + value;
        value *= x - node(l);
      }
    values[static_cast<std::size_t>(k)] = value;
    derivatives[static_cast<std::size_t>(k)] = derivative;
  }
}

Quadrature1d gauss_quadrature(int n_points) {
  const dealii::QGauss<1> gauss(static_cast<unsigned>(n_points));
  Quadrature1d quadrature;
  for (unsigned q = 0; q < gauss.size(); ++q) {
    quadrature.points.push_back(gauss.point(q)[0]);
    quadrature.weights.push_back(gauss.weight(q));
  }
  return quadrature;
}

Quadrature2d cell_quadrature(unsigned n_vertices, int n) {
  const auto n_1d = static_cast<unsigned>(n);
  const dealii::Quadrature<2> rule = n_vertices == 3 ? dealii::Quadrature<2>(dealii::QWitherdenVincentSimplex<2>(n_1d))
                                                     : dealii::Quadrature<2>(dealii::QGauss<2>(n_1d));
  Quadrature2d quadrature;
  for (unsigned q = 0; q < rule.size(); ++q) {
    quadrature.points.push_back({rule.point(q)[0], rule.point(q)[1]});
    quadrature.weights.push_back(rule.weight(q));
  }
  return quadrature;
}

ReferenceElement::ReferenceElement(unsigned n_vertices, int degree) : n_vertices_(n_vertices), line_(degree) {
  if (n_vertices == 3)
    make_triangle();
  else
    make_quadrilateral();
}

void ReferenceElement::make_quadrilateral() {
  const auto p = static_cast<unsigned>(degree());
  for (unsigned j = 0; j <= p; ++j)
    for (unsigned i = 0; i <= p; ++i) {
      if (i > 0 && i < p && j > 0 && j < p)
        inside_.push_back(n_nodes());
      nodes_.push_back({line_.node(static_cast<int>(i)), line_.node(static_cast<int>(j))});
    }
  for (unsigned k = 0; k <= p; ++k) {
    sides_[0].push_back(k);
    sides_[1].push_back(k * (p + 1) + p);
    sides_[2].push_back(p * (p + 1) + p - k);
    sides_[3].push_back((p - k) * (p + 1));
  }
}

namespace {
constexpr std::array<mesh::Point, 3> triangle_corners = {{{0, 0}, {1, 0}, {0, 1}}};

constexpr std::array<double, max_degree + 1> factorial = {1, 1, 2, 6, 24};

/// x^0 ... x^p
std::array<double, max_degree + 1> powers(double x) {
  std::array<double, max_degree + 1> result{};
  result[0] = 1;
  for (std::size_t k = 1; k < result.size(); ++k)
    result[k] = x * result[k - 1];
  return result;
}

/// Bernstein polynomials p! / (i! j! k!) l0^i l1^j l2^k and their derivatives by x = l1 and y = l2. They are well
/// conditioned, unlike monomials, and cost the shape functions no digits.
void bernstein(int p, mesh::Point xi, ReferenceElement::Values &values, ReferenceElement::Values &gradient_1,
               ReferenceElement::Values &gradient_2) {
  const auto l0 = powers(1 - xi[0] - xi[1]);
  const auto l1 = powers(xi[0]);
  const auto l2 = powers(xi[1]);
  std::size_t b = 0;
  for (int k = 0; k <= p; ++k)
    for (int j = 0; j + k <= p; ++j, ++b) {
      const int i = p - j - k;
      const double scale = factorial[p] / (factorial[i] * factorial[j] * factorial[k]);
      const double along_0 = i > 0 ? scale * i * l0[i - 1] * l1[j] * l2[k] : 0;
      values[b] = scale * l0[i] * l1[j] * l2[k];
      gradient_1[b] = (j > 0 ? scale * j * l0[i] * l1[j - 1] * l2[k] : 0) - along_0;
      gradient_2[b] = (k > 0 ? scale * k * l0[i] * l1[j] * l2[k - 1] : 0) - along_0;
    }
}
} // namespace

void ReferenceElement::make_triangle() {
  const int p = degree();
  nodes_.assign(triangle_corners.begin(), triangle_corners.end());
  for (unsigned k = 0; k < 3; ++k) {
    sides_[k].push_back(k);
    for (int l = 1; l < p; ++l) {
      sides_[k].push_back(n_nodes());
      nodes_.push_back(on_side(k, line_.node(l)));
    }
    sides_[k].push_back((k + 1) % 3);
  }
  for (int j = 1; j < p; ++j)
    for (int i = 1; i + j < p; ++i) {
      inside_.push_back(n_nodes());
      nodes_.push_back({static_cast<double>(i) / p, static_cast<double>(j) / p});
    }
  const unsigned n = n_nodes();
  dealii::FullMatrix<double> matrix(n); // row a: the Bernstein polynomials at node a
  Values values, unused_1, unused_2;
  for (unsigned a = 0; a < n; ++a) {
    bernstein(p, nodes_[a], values, unused_1, unused_2);
    for (unsigned b = 0; b < n; ++b)
      matrix(a, b) = values[b];
  }
  matrix.gauss_jordan();
  for (unsigned b = 0; b < n; ++b)
    for (unsigned a = 0; a < n; ++a)
      coefficients_.push_back(matrix(b, a));
}

void ReferenceElement::evaluate_triangle(mesh::Point xi, Values &values, Values &gradient_1, Values &gradient_2) const {
  Values b0, b1, b2;
  bernstein(degree(), xi, b0, b1, b2);
  const unsigned n = n_nodes();
  for (unsigned a = 0; a < n; ++a)
    values[a] = gradient_1[a] = gradient_2[a] = 0;
  for (unsigned b = 0; b < n; ++b)
    for (unsigned a = 0; a < n; ++a) {
      const double coefficient = coefficients_[b * n + a];
      values[a] += coefficient * b0[b];
      gradient_1[a] += coefficient * b1[b];
      gradient_2[a] += coefficient * b2[b];
    }
}

void ReferenceElement::evaluate(mesh::Point xi, Values &values, Values &gradient_1, Values &gradient_2) const {
  if (n_vertices_ == 3)
    return evaluate_triangle(xi, values, gradient_1, gradient_2);
  std::array<LagrangeBasis::Values, 2> shape;
  std::array<LagrangeBasis::Values, 2> slope;
  for (std::size_t d = 0; d < 2; ++d)
    line_.evaluate(xi[d], shape[d], slope[d]);
  const auto n = static_cast<std::size_t>(degree()) + 1;
  std::size_t a = 0;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i, ++a) {
      values[a] = shape[0][i] * shape[1][j];
      gradient_1[a] = slope[0][i] * shape[1][j];
      gradient_2[a] = shape[0][i] * slope[1][j];
    }
}

bool ReferenceElement::contains(mesh::Point xi, double tolerance) const {
  if (!(xi[0] >= -tolerance && xi[1] >= -tolerance))
    return false;
  return n_vertices_ == 3 ? xi[0] + xi[1] <= 1 + tolerance : xi[0] <= 1 + tolerance && xi[1] <= 1 + tolerance;
}

mesh::Point ReferenceElement::on_side(unsigned k, double t) const {
  if (n_vertices_ == 4)
    return std::array<mesh::Point, 4>{{{t, 0}, {1, t}, {1 - t, 1}, {0, 1 - t}}}[k];
  const auto &a = triangle_corners[k];
  const auto &b = triangle_corners[(k + 1) % 3];
  return {(1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1]};
}

mesh::Point ReferenceElement::limited(mesh::Point xi, double margin) const {
  for (auto &coordinate : xi)
    coordinate = std::clamp(coordinate, -margin, 1 + margin);
  const double excess = xi[0] + xi[1] - 1 - margin;
  if (n_vertices_ == 3 && excess > 0)
    for (auto &coordinate : xi)
      coordinate = std::max(-margin, coordinate - .5 * excess);
  return xi;
}

ShapeTable::ShapeTable(const ReferenceElement &element, const Quadrature2d &quadrature)
    : n_nodes(static_cast<int>(element.n_nodes())), n_points(static_cast<int>(quadrature.points.size())),
      weights(quadrature.weights) {
  ReferenceElement::Values value, gradient_1, gradient_2;
  for (const auto &point : quadrature.points) {
    element.evaluate(point, value, gradient_1, gradient_2);
    for (unsigned a = 0; a < element.n_nodes(); ++a) {
      values.push_back(value[a]);
      gradients_1.push_back(gradient_1[a]);
      gradients_2.push_back(gradient_2[a]);
    }
  }
}
} // namespace fem_reference::elasticity
