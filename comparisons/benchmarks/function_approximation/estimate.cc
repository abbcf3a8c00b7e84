#include "comparisons/benchmarks/function_approximation/estimate.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::function_approximation {

template <int dim>
WeightedPoints<dim> quadrature(double begin, double end, int n_cells) {
  const auto gauss = meshless::linear_algebra::gauss_legendre(dim == 3 ? 3 : 5);
  std::vector<double> positions;
  std::vector<double> weights;
  for (int c = 0; c < n_cells; ++c)
    for (std::size_t q = 0; q < gauss.points.size(); ++q) {
      positions.push_back(begin + (end - begin) * (c + gauss.points[q]) / n_cells);
      weights.push_back((end - begin) * gauss.weights[q] / n_cells);
    }
  WeightedPoints<dim> rule;
  std::array<std::size_t, dim> index{};
  while (true) {
    std::array<double, dim> point{};
    double weight = 1;
    for (std::size_t k = 0; k < dim; ++k) {
      point[k] = positions[index[k]];
      weight *= weights[index[k]];
    }
    rule.points.push_back(point);
    rule.weights.push_back(weight);
    std::size_t k = 0;
    while (k < dim && ++index[k] == positions.size())
      index[k++] = 0;
    if (k == dim)
      return rule;
  }
}

template <int dim>
Values<dim> exact_values(const Expression &function, std::span<const std::array<double, dim>> points) {
  Values<dim> values;
  values.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::array<double, 3> point{};
    std::copy(points[i].begin(), points[i].end(), point.begin());
    values.value[i] = function.value(point);
    std::size_t kl = 0;
    for (int k = 0; k < dim; ++k) {
      values.gradient[i][static_cast<std::size_t>(k)] = function.first(point, k);
      for (int l = k; l < dim; ++l)
        values.hessian[i][kl++] = function.second(point, k, l);
    }
  }
  return values;
}

template <int dim>
void add_errors(const Values<dim> &computed, const Values<dim> &exact, std::span<const double> weights,
                const std::string &suffix, std::map<std::string, double> &errors) {
  double l2 = 0;
  double h1 = 0;
  double h2 = 0;
  const auto square = [](double a, double b) { return (a - b) * (a - b); };
  for (std::size_t i = 0; i < weights.size(); ++i) {
    l2 += weights[i] * square(computed.value[i], exact.value[i]);
    std::size_t kl = 0;
    for (std::size_t k = 0; k < dim; ++k) {
      h1 += weights[i] * square(computed.gradient[i][k], exact.gradient[i][k]);
      for (std::size_t l = k; l < dim; ++l, ++kl)
        h2 += (k == l ? 1 : 2) * weights[i] * square(computed.hessian[i][kl], exact.hessian[i][kl]);
    }
  }
  errors["l2" + suffix] = std::sqrt(l2);
  errors["h1" + suffix] = std::sqrt(h1);
  errors["h2" + suffix] = std::sqrt(h2);
}

#define INSTANTIATE(dim)                                                                                               \
  template WeightedPoints<dim> quadrature<dim>(double, double, int);                                                   \
  template Values<dim> exact_values<dim>(const Expression &, std::span<const std::array<double, dim>>);                \
  template void add_errors<dim>(const Values<dim> &, const Values<dim> &, std::span<const double>,                     \
                                const std::string &, std::map<std::string, double> &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace comparisons::benchmarks::function_approximation
