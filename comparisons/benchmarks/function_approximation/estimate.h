#pragma once

#include "comparisons/scene/expression.h"

#include <array>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace comparisons::benchmarks::function_approximation {

using scene::Expression;

/// Function, gradient and second derivatives (k <= l) at points.
template <int dim>
struct Values {
  static constexpr int n_hessian = dim * (dim + 1) / 2;
  std::vector<double> value;
  std::vector<std::array<double, dim>> gradient;
  std::vector<std::array<double, n_hessian>> hessian;

  void resize(std::size_t n) {
    value.assign(n, 0);
    gradient.assign(n, {});
    hessian.assign(n, {});
  }
};

/// Points with weights of a sum or quadrature.
template <int dim>
struct WeightedPoints {
  std::vector<std::array<double, dim>> points;
  std::vector<double> weights;
};

/// Gauss rule on [begin, end]^dim: n_cells cells an axis, five points each (three in 3D).
template <int dim>
WeightedPoints<dim> quadrature(double begin, double end, int n_cells);

/// The expression and its derivatives at points.
template <int dim>
Values<dim> exact_values(const Expression &function, std::span<const std::array<double, dim>> points);

/// Adds sqrt(sum w e^2) of function, gradient and second derivatives as l2, h1, h2 with the suffix; mixed
/// derivatives count twice, as in the tensor norm.
template <int dim>
void add_errors(const Values<dim> &computed, const Values<dim> &exact, std::span<const double> weights,
                const std::string &suffix, std::map<std::string, double> &errors);

} // namespace comparisons::benchmarks::function_approximation
