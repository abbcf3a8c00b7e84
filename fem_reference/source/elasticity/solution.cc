#include "solution.h"

#include <cmath>

#include <fmt/format.h>

namespace fem_reference::elasticity {
const PointLocation &PlaneSolution::Implementation::location() const {
  std::call_once(location_built_, [this] { location_.emplace(discretisation); });
  return *location_;
}

const RecoveredStress &PlaneSolution::Implementation::recovered() const {
  std::call_once(recovered_built_, [this] { recovered_.emplace(discretisation, materials, values, cell_pressure); });
  return *recovered_;
}

const InternalForces &PlaneSolution::Implementation::internal() const {
  std::call_once(internal_built_,
                 [this] { internal_ = internal_forces(discretisation, materials, values, cell_pressure); });
  return internal_;
}

template <typename Function>
void PlaneSolution::Implementation::for_each_point(std::span<const Point> points, const Function &function) const {
  const auto &where = location();
  std::size_t outside = 0;
  ReferenceElement::Values shape, slope_1, slope_2;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto found = where.locate({points[k][0] - discretisation.origin[0], points[k][1] - discretisation.origin[1]});
    outside += found.outside ? 1 : 0;
    discretisation.element_of(found.cell).evaluate(found.xi, shape, slope_1, slope_2);
    function(k, found.cell, shape, slope_1, slope_2);
  }
  points_outside = outside;
}

void PlaneSolution::Implementation::subtract_thermal(std::span<const Point> points,
                                                     std::span<std::array<double, 3>> stress) const {
  if (!thermal_strain)
    return;
  std::vector<double> free(points.size());
  thermal_strain(points, free);
  for_each_point(points, [&](std::size_t k, std::size_t cell, const auto &, const auto &, const auto &) {
    for (std::size_t d = 0; d < 2; ++d)
      stress[k][d] -= material_of(cell).thermal_modulus() * free[k];
  });
}

namespace {
using Shape = ReferenceElement::Values;

void check_same_size(std::size_t n_points, std::size_t n_values) {
  if (n_points != n_values)
    throw InvalidInput(fmt::format("evaluation: {} points but room for {} values", n_points, n_values));
}
} // namespace

PlaneSolution::PlaneSolution(std::shared_ptr<const Implementation> implementation)
    : implementation_(std::move(implementation)) {}

std::size_t PlaneSolution::n_cells() const { return implementation_->discretisation.n_cells; }

std::size_t PlaneSolution::n_dofs() const { return implementation_->n_dofs; }

std::size_t PlaneSolution::nonzeros() const { return implementation_->nonzeros; }

const Seconds &PlaneSolution::seconds() const { return implementation_->seconds; }

double PlaneSolution::relative_residual() const { return implementation_->relative_residual; }

double PlaneSolution::backward_error() const { return implementation_->backward_error; }

std::optional<double> PlaneSolution::algebraic_error() const { return implementation_->algebraic_error; }

int PlaneSolution::iterations() const { return implementation_->iterations; }

std::size_t PlaneSolution::contradicted_values() const { return implementation_->essential.contradicted; }

std::size_t PlaneSolution::points_outside() const { return implementation_->points_outside; }

void PlaneSolution::displacement(std::span<const Point> points, std::span<Vector> values) const {
  check_same_size(points.size(), values.size());
  const double *u = implementation_->values.data();
  implementation_->for_each_point(
      points, [&](std::size_t k, std::size_t cell, const Shape &shape, const Shape &, const Shape &) {
        const auto nodes = implementation_->discretisation.nodes_of(cell);
        Vector sum{};
        for (std::size_t a = 0; a < nodes.size(); ++a)
          for (std::size_t d = 0; d < 2; ++d)
            sum[d] += shape[a] * u[2 * std::size_t{nodes[a]} + d];
        values[k] = sum;
      });
}

void PlaneSolution::stress(std::span<const Point> points, std::span<std::array<double, 3>> values) const {
  check_same_size(points.size(), values.size());
  implementation_->for_each_point(
      points, [&](std::size_t k, std::size_t cell, const Shape &shape, const Shape &slope_1, const Shape &slope_2) {
        values[k] = cell_stress(
            implementation_->discretisation, implementation_->material_of(cell), implementation_->values, cell, slope_1,
            slope_2, pressure_in_cell(implementation_->discretisation, implementation_->cell_pressure, cell, shape));
      });
  implementation_->subtract_thermal(points, values);
}

bool PlaneSolution::has_pressure() const { return !implementation_->cell_pressure.empty(); }

void PlaneSolution::pressure(std::span<const Point> points, std::span<double> values) const {
  check_same_size(points.size(), values.size());
  if (!has_pressure())
    throw InvalidInput("evaluation: only Taylor-Hood elements have a pressure of their own");
  implementation_->for_each_point(
      points, [&](std::size_t k, std::size_t cell, const Shape &shape, const Shape &, const Shape &) {
        values[k] = *pressure_in_cell(implementation_->discretisation, implementation_->cell_pressure, cell, shape);
      });
}

void PlaneSolution::recovered_stress(std::span<const Point> points, std::span<std::array<double, 3>> values) const {
  check_same_size(points.size(), values.size());
  const auto &recovered = implementation_->recovered();
  implementation_->for_each_point(
      points, [&](std::size_t k, std::size_t cell, const Shape &shape, const Shape &, const Shape &) {
        const std::size_t n_nodes = implementation_->discretisation.nodes_of(cell).size();
        std::array<double, 3> sum{};
        for (std::size_t a = 0; a < n_nodes; ++a)
          for (std::size_t d = 0; d < 3; ++d)
            sum[d] += shape[a] * recovered.at(cell, a)[d];
        values[k] = sum;
      });
  implementation_->subtract_thermal(points, values);
}

std::map<int, Vector> PlaneSolution::reactions() const {
  const auto &essential = implementation_->essential;
  const auto &internal = implementation_->internal();
  std::map<int, Vector> result;
  for (std::size_t i = 0; i < essential.prescribed.size(); ++i)
    if (essential.prescribed[i] != 0)
      result[essential.ids[i]][i % 2] += internal.forces[i] - implementation_->loads.nodal[i];
  return result;
}

const std::map<int, Vector> &PlaneSolution::applied_tractions() const { return implementation_->loads.tractions; }

Vector PlaneSolution::applied_body_force() const { return implementation_->loads.body_force; }

double PlaneSolution::load_magnitude() const { return implementation_->loads.magnitude; }

double PlaneSolution::strain_energy() const { return implementation_->internal().energy; }
} // namespace fem_reference::elasticity
