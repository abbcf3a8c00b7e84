#include "fem_reference/approximation/lagrange_interpolant.h"

#include <deal.II/fe/fe_q.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace fem_reference::approximation {

template <int dim>
struct LagrangeInterpolant<dim>::Implementation {
  Implementation(int p, int n) : element(equidistant(p)), degree(p), n_cells(n) {}

  static dealii::QIterated<1> equidistant(int p) { return {dealii::QTrapezoid<1>(), static_cast<unsigned>(p)}; }

  dealii::FE_Q<dim> element;
  int degree;
  int n_cells;
  /// Nodal values on the tensor grid of degree * n_cells + 1 nodes an axis, first axis fastest.
  std::vector<double> values;
};

namespace {

/// Index of a node on the tensor grid.
template <int dim>
std::size_t node_index(const std::array<int, dim> &node, int n_nodes) {
  std::size_t index = 0;
  for (int k = dim - 1; k >= 0; --k)
    index = index * static_cast<std::size_t>(n_nodes) + static_cast<std::size_t>(node[static_cast<std::size_t>(k)]);
  return index;
}

} // namespace

template <int dim>
LagrangeInterpolant<dim>::LagrangeInterpolant(const std::function<double(const Point &)> &function, int degree,
                                              int n_cells) {
  if (degree < 1 || degree > 4)
    throw std::invalid_argument(fmt::format("no element Q{}; there are Q1 to Q4", degree));
  if (n_cells < 1)
    throw std::invalid_argument("an interpolant needs at least one cell");
  implementation_ = std::make_unique<Implementation>(degree, n_cells);
  const int n_nodes = degree * n_cells + 1;
  std::size_t n_total = 1;
  for (int k = 0; k < dim; ++k)
    n_total *= static_cast<std::size_t>(n_nodes);
  auto &values = implementation_->values;
  values.resize(n_total);
  for (std::size_t i = 0; i < n_total; ++i) {
    Point point{};
    std::size_t rest = i;
    for (std::size_t k = 0; k < dim; ++k) {
      point[k] = static_cast<double>(rest % static_cast<std::size_t>(n_nodes)) / (n_nodes - 1);
      rest /= static_cast<std::size_t>(n_nodes);
    }
    values[i] = function(point);
  }
}

template <int dim>
LagrangeInterpolant<dim>::~LagrangeInterpolant() = default;

template <int dim>
std::size_t LagrangeInterpolant<dim>::n_dofs() const {
  return implementation_->values.size();
}

template <int dim>
void LagrangeInterpolant<dim>::evaluate(std::span<const Point> points, std::span<double> values,
                                        std::span<Point> gradients,
                                        std::span<std::array<double, dim *(dim + 1) / 2>> hessians) const {
  const auto &data = *implementation_;
  const int n_nodes = data.degree * data.n_cells + 1;
  const auto &nodes = data.element.get_unit_support_points();
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<int, dim> cell{};
    dealii::Point<dim> unit;
    for (unsigned k = 0; k < dim; ++k) {
      const double position = points[i][k] * data.n_cells;
      cell[k] = std::clamp(static_cast<int>(std::ceil(position)) - 1, 0, data.n_cells - 1);
      unit[k] = position - cell[k];
    }
    if (!values.empty())
      values[i] = 0;
    if (!gradients.empty())
      gradients[i] = {};
    if (!hessians.empty())
      hessians[i] = {};
    for (unsigned j = 0; j < data.element.n_dofs_per_cell(); ++j) {
      std::array<int, dim> node{};
      for (unsigned k = 0; k < dim; ++k)
        node[k] = cell[k] * data.degree + static_cast<int>(std::lround(nodes[j][k] * data.degree));
      const double coefficient = data.values[node_index<dim>(node, n_nodes)];
      if (!values.empty())
        values[i] += coefficient * data.element.shape_value(j, unit);
      if (!gradients.empty()) {
        const auto gradient = data.element.shape_grad(j, unit);
        for (unsigned k = 0; k < dim; ++k)
          gradients[i][k] += coefficient * gradient[k] * data.n_cells;
      }
      if (!hessians.empty()) {
        const auto hessian = data.element.shape_grad_grad(j, unit);
        std::size_t kl = 0;
        for (unsigned k = 0; k < dim; ++k)
          for (unsigned l = k; l < dim; ++l)
            hessians[i][kl++] += coefficient * hessian[k][l] * data.n_cells * data.n_cells;
      }
    }
  }
}

template class LagrangeInterpolant<1>;
template class LagrangeInterpolant<2>;
template class LagrangeInterpolant<3>;

} // namespace fem_reference::approximation
