#include "recovery.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include <deal.II/lac/full_matrix.h>

namespace fem_reference::elasticity {
namespace {
/// From the stress at sampling points of an element to that at its nodes.
struct Extrapolation {
  explicit Extrapolation(const ReferenceElement &element);

  std::vector<ReferenceElement::Values> shape;   ///< the displacement's shape functions at the points
  std::vector<ReferenceElement::Values> slope_1; ///< of the displacement's shape functions at the points
  std::vector<ReferenceElement::Values> slope_2;
  dealii::FullMatrix<double> matrix; ///< nodes x points
};

/// Degree p - 1: fit c minimises sum_q w_q (sum_b c_b B_b(x_q) - s_q)^2. The basis B is that of elements of that
/// degree, and a constant for p = 1.
Extrapolation::Extrapolation(const ReferenceElement &element) {
  const int p = element.degree();
  const auto points = cell_quadrature(element.n_vertices(), element.n_vertices() == 4 ? p : p + 1);
  const auto n_points = static_cast<unsigned>(points.points.size());
  const ReferenceElement fitted(element.n_vertices(), std::max(p - 1, 1));
  const unsigned n = p == 1 ? 1 : fitted.n_nodes();
  const auto basis = [&](mesh::Point xi) {
    ReferenceElement::Values values{}, unused_1, unused_2;
    if (p == 1)
      values[0] = 1;
    else
      fitted.evaluate(xi, values, unused_1, unused_2);
    return values;
  };
  dealii::FullMatrix<double> normal(n), moments(n, n_points), at_nodes(element.n_nodes(), n);
  for (unsigned q = 0; q < n_points; ++q) {
    const auto b = basis(points.points[q]);
    for (unsigned i = 0; i < n; ++i) {
      moments(i, q) = points.weights[q] * b[i];
      for (unsigned j = 0; j < n; ++j)
        normal(i, j) += points.weights[q] * b[i] * b[j];
    }
    element.evaluate(points.points[q], shape.emplace_back(), slope_1.emplace_back(), slope_2.emplace_back());
  }
  for (unsigned a = 0; a < element.n_nodes(); ++a) {
    const auto b = basis(element.nodes()[a]);
    for (unsigned i = 0; i < n; ++i)
      at_nodes(a, i) = b[i];
  }
  normal.gauss_jordan();
  dealii::FullMatrix<double> fit(n, n_points);
  normal.mmult(fit, moments);
  matrix.reinit(element.n_nodes(), n_points);
  at_nodes.mmult(matrix, fit);
}
} // namespace

std::array<double, 3> cell_stress(const Discretisation &discretisation, const Material &material,
                                  std::span<const double> displacement, std::size_t cell,
                                  const ReferenceElement::Values &slope_1, const ReferenceElement::Values &slope_2,
                                  std::optional<double> pressure) {
  using mesh::Point;
  const auto nodes = discretisation.nodes_of(cell);
  std::array<Point, 2> dx{}; // dx[c][d] = d x_d / d xi_c
  std::array<Point, 2> du{};
  for (std::size_t a = 0; a < nodes.size(); ++a)
    for (std::size_t d = 0; d < 2; ++d) {
      const double x = discretisation.positions[nodes[a]][d];
      const double u = displacement[2 * std::size_t{nodes[a]} + d];
      dx[0][d] += slope_1[a] * x;
      dx[1][d] += slope_2[a] * x;
      du[0][d] += slope_1[a] * u;
      du[1][d] += slope_2[a] * u;
    }
  const double inverse = 1 / (dx[0][0] * dx[1][1] - dx[0][1] * dx[1][0]);
  const auto along_1 = [&](std::size_t d) { return (dx[1][1] * du[0][d] - dx[0][1] * du[1][d]) * inverse; };
  const auto along_2 = [&](std::size_t d) { return (dx[0][0] * du[1][d] - dx[1][0] * du[0][d]) * inverse; };
  const double e11 = along_1(0);
  const double e22 = along_2(1);
  const double trace = pressure ? *pressure : material.lambda() * (e11 + e22);
  return {trace + 2 * material.mu() * e11, trace + 2 * material.mu() * e22, material.mu() * (along_2(0) + along_1(1))};
}

std::optional<double> pressure_in_cell(const Discretisation &discretisation, std::span<const double> cell_pressure,
                                       std::size_t cell, const ReferenceElement::Values &shape) {
  if (cell_pressure.empty())
    return {};
  double sum = 0;
  for (std::size_t a = 0; a < discretisation.nodes_of(cell).size(); ++a)
    sum += shape[a] * cell_pressure[discretisation.cell_start[cell] + a];
  return sum;
}

RecoveredStress::RecoveredStress(const Discretisation &discretisation, std::span<const Material> materials,
                                 std::span<const double> displacement, std::span<const double> cell_pressure)
    : discretisation_(discretisation), value_of_(discretisation.cell_nodes.size()) {
  number_values();
  std::vector<unsigned> count(values_.size(), 0);
  const std::array<Extrapolation, 2> extrapolations = {Extrapolation(discretisation.elements[0]),
                                                       Extrapolation(discretisation.elements[1])};
  std::vector<std::array<double, 3>> samples;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const auto &extrapolation = extrapolations[discretisation.n_vertices[c] - 3U];
    const auto &material = materials[static_cast<std::size_t>(discretisation.regions[c])];
    samples.clear();
    for (std::size_t q = 0; q < extrapolation.slope_1.size(); ++q)
      samples.push_back(cell_stress(discretisation, material, displacement, c, extrapolation.slope_1[q],
                                    extrapolation.slope_2[q],
                                    pressure_in_cell(discretisation, cell_pressure, c, extrapolation.shape[q])));
    for (unsigned a = 0; a < extrapolation.matrix.m(); ++a) {
      const unsigned value = value_of_[discretisation.cell_start[c] + a];
      ++count[value];
      for (unsigned q = 0; q < samples.size(); ++q)
        for (std::size_t d = 0; d < 3; ++d)
          values_[value][d] += extrapolation.matrix(a, q) * samples[q][d];
    }
  }
  for (std::size_t v = 0; v < values_.size(); ++v)
    for (auto &component : values_[v])
      component /= count[v];
}

/// One value for each region that a node belongs to: regions one after another, nodes as they are met.
void RecoveredStress::number_values() {
  std::vector<std::size_t> order(discretisation_.n_cells);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto &regions = discretisation_.regions;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return regions[i] < regions[j]; });
  std::vector<int> last_region(discretisation_.n_nodes(), -1);
  std::vector<unsigned> last_value(discretisation_.n_nodes());
  unsigned n_values = 0;
  for (const std::size_t c : order) {
    const auto nodes = discretisation_.nodes_of(c);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (last_region[nodes[a]] != regions[c]) {
        last_region[nodes[a]] = regions[c];
        last_value[nodes[a]] = n_values++;
      }
      value_of_[discretisation_.cell_start[c] + a] = last_value[nodes[a]];
    }
  }
  values_.assign(n_values, {});
}
} // namespace fem_reference::elasticity
