#include "reference_element.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

namespace fem_reference::elasticity {
LagrangeBasis::LagrangeBasis(int degree) : degree_(degree) {
  const dealii::QGaussLobatto<1> points(static_cast<unsigned>(degree) + 1);
  for (int k = 0; k <= degree; ++k)
    nodes_[static_cast<std::size_t>(k)] = points.point(static_cast<unsigned>(k))[0];
  for (int k = 0; k <= degree; ++k) {
    double product = 1;
    for (int l = 0; l <= degree; ++l)
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

ShapeTable::ShapeTable(int degree, int n_points_1d) {
  const dealii::FE_Q<2> fe(static_cast<unsigned>(degree));
  const dealii::QGauss<2> quadrature(static_cast<unsigned>(n_points_1d));
  const auto hierarchic = dealii::FETools::lexicographic_to_hierarchic_numbering<2>(static_cast<unsigned>(degree));
  n_nodes = static_cast<int>(fe.n_dofs_per_cell());
  n_points = static_cast<int>(quadrature.size());
  for (unsigned q = 0; q < quadrature.size(); ++q) {
    weights.push_back(quadrature.weight(q));
    for (unsigned a = 0; a < fe.n_dofs_per_cell(); ++a) {
      const auto gradient = fe.shape_grad(hierarchic[a], quadrature.point(q));
      values.push_back(fe.shape_value(hierarchic[a], quadrature.point(q)));
      gradients_1.push_back(gradient[0]);
      gradients_2.push_back(gradient[1]);
    }
  }
}
} // namespace fem_reference::elasticity
