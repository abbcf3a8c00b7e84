#include "discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

namespace fem_reference::gas {

namespace {

Conserved conserved_of(const Primitive &w, double gamma) {
  return {w.density, w.density * w.velocity, w.pressure / (gamma - 1) + 0.5 * w.density * w.velocity * w.velocity};
}

} // namespace

Discretisation::Discretisation(const Tube &tube, int degree)
    : element(static_cast<unsigned>(degree)), numbering(triangulation) {
  dealii::GridGenerator::subdivided_hyper_cube(triangulation, static_cast<unsigned>(tube.n_cells), tube.left,
                                               tube.right);
  numbering.distribute_dofs(element);
  const unsigned n_functions = element.n_dofs_per_cell();
  const dealii::QGauss<1> gauss(n_functions);
  dealii::FEValues<1> values(element, gauss,
                             dealii::update_values | dealii::update_gradients | dealii::update_quadrature_points |
                                 dealii::update_JxW_values);

  auto cell = numbering.begin_active();
  while (!cell->at_boundary(0))
    cell = cell->neighbor(0);
  ends.push_back(cell->vertex(0)[0]);
  std::vector<double> places;
  std::vector<Primitive> states;
  for (;; cell = cell->neighbor(1)) {
    values.reinit(cell);
    std::array<double, 2> mass{};
    places.clear();
    for (unsigned q = 0; q < gauss.size(); ++q) {
      places.push_back(values.quadrature_point(q)[0]);
      for (unsigned a = 0; a < n_functions; ++a)
        mass[a] += values.shape_value(a, q) * values.shape_value(a, q) * values.JxW(q);
    }
    states.resize(places.size());
    tube.initial(places, states);
    std::array<Conserved, 2> coefficients{};
    for (unsigned a = 0; a < n_functions; ++a)
      for (unsigned q = 0; q < gauss.size(); ++q)
        for (unsigned k = 0; k < 3; ++k)
          coefficients[a][k] +=
              values.shape_value(a, q) * values.JxW(q) / mass[a] * conserved_of(states[q], tube.gamma)[k];
    initial.push_back(coefficients);
    inverse_mass.push_back({1 / mass[0], n_functions > 1 ? 1 / mass[1] : 0});
    ends.push_back(cell->vertex(1)[0]);
    centres.push_back(cell->center()[0]);
    if (cell->at_boundary(1))
      break;
  }
  if (n_functions > 1)
    for (unsigned s = 0; s < 2; ++s) {
      traces[s] = element.shape_value(1, dealii::Point<1>(s));
      point_values[s] = values.shape_value(1, s);
      gradient_weights[s] = values.shape_grad(1, s)[0] * values.JxW(s);
    }
}

} // namespace fem_reference::gas
