#include "comparisons/metrics/requested_quantities.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace comparisons::metrics {

namespace {

using problems::Point2;
using problems::RequestedQuantity;
using problems::Stress2;

std::vector<Stress2> stresses(const methods::Solution &solution, std::span<const Point2> points) {
  std::vector<double> flat(3 * points.size());
  solution.evaluate("stress", points, flat);
  std::vector<Stress2> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    result[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  return result;
}

/// Twice the energy density: sigma : C^-1 : sigma.
double energy_density(const Stress2 &s, const problems::Material &material) {
  const double e = material.youngs_modulus;
  const double nu = material.poisson_ratio;
  const double s33 = material.plane_strain ? nu * (s[0] + s[1]) : 0;
  return (s[0] * s[0] + s[1] * s[1] + s33 * s33 - 2 * nu * (s[0] * s[1] + s33 * (s[0] + s[1]))) / e +
         2 * (1 + nu) * s[2] * s[2] / e;
}

/// What the quantities need of the solution over the whole domain, computed once.
class Evaluation {
public:
  Evaluation(const methods::Solution &solution, const problems::PlaneProblem &problem,
             const problems::Quadrature &quadrature, const Equilibrium &equilibrium)
      : solution_(solution), regions_(problem.statement().regions), quadrature_(quadrature), equilibrium_(equilibrium) {
  }

  double value(const RequestedQuantity &quantity) {
    switch (quantity.kind) {
    case RequestedQuantity::Kind::displacement:
      return displacement(quantity);
    case RequestedQuantity::Kind::stress:
      return stress(quantity);
    case RequestedQuantity::Kind::largest_von_mises:
      return largest_von_mises();
    case RequestedQuantity::Kind::reaction: {
      const auto found = equilibrium_.boundary.find(quantity.id);
      return found == equilibrium_.boundary.end() ? 0 : found->second[static_cast<std::size_t>(quantity.component)];
    }
    case RequestedQuantity::Kind::strain_energy:
      return strain_energy();
    }
    return std::nan("");
  }

private:
  const problems::Material &material_at(std::size_t q) const {
    return regions_[quadrature_.regions.empty() ? 0 : static_cast<std::size_t>(quadrature_.regions[q])].material;
  }

  double displacement(const RequestedQuantity &quantity) const {
    std::array<double, 2> u{};
    solution_.evaluate("displacement", {&quantity.point, 1}, u);
    return quantity.component == 2 ? std::hypot(u[0], u[1]) : u[static_cast<std::size_t>(quantity.component)];
  }

  double stress(const RequestedQuantity &quantity) const {
    const auto s = stresses(solution_, {&quantity.point, 1}).front();
    if (quantity.component < 3)
      return s[static_cast<std::size_t>(quantity.component)];
    // The material at the point is that of the nearest point of the quadrature.
    const auto distance = [&](const Point2 &p) {
      return std::hypot(p[0] - quantity.point[0], p[1] - quantity.point[1]);
    };
    const auto nearest = std::ranges::min_element(quadrature_.points, {}, distance);
    return von_mises(s, material_at(static_cast<std::size_t>(nearest - quadrature_.points.begin())));
  }

  const std::vector<Stress2> &all() {
    if (stresses_.empty())
      stresses_ = stresses(solution_, quadrature_.points);
    return stresses_;
  }

  double largest_von_mises() {
    double largest = 0;
    for (std::size_t q = 0; q < all().size(); ++q)
      largest = std::max(largest, von_mises(all()[q], material_at(q)));
    return largest;
  }

  double strain_energy() {
    if (const auto own = solution_.own_strain_energy())
      return *own;
    double energy = 0;
    for (std::size_t q = 0; q < all().size(); ++q)
      energy += 0.5 * quadrature_.weights[q] * energy_density(all()[q], material_at(q));
    return energy;
  }

  const methods::Solution &solution_;
  const std::vector<problems::Region> &regions_;
  const problems::Quadrature &quadrature_;
  const Equilibrium &equilibrium_;
  std::vector<Stress2> stresses_;
};

} // namespace

double von_mises(const problems::Stress2 &s, const problems::Material &material) {
  const double s33 = material.plane_strain ? material.poisson_ratio * (s[0] + s[1]) : 0;
  return std::sqrt(0.5 * (std::pow(s[0] - s[1], 2) + std::pow(s[1] - s33, 2) + std::pow(s33 - s[0], 2)) +
                   3 * s[2] * s[2]);
}

std::map<std::string, double> requested_quantities(const methods::Solution &solution,
                                                   const problems::PlaneProblem &problem,
                                                   const problems::Quadrature &quadrature,
                                                   const Equilibrium &equilibrium) {
  Evaluation evaluation(solution, problem, quadrature, equilibrium);
  std::map<std::string, double> values;
  for (const auto &quantity : problem.quantities()) {
    const double value = evaluation.value(quantity) / quantity.scale;
    values[quantity.name] = value;
    if (quantity.reference)
      values[quantity.name + "_error"] = *quantity.reference != 0
                                             ? std::abs(value - *quantity.reference) / std::abs(*quantity.reference)
                                             : std::abs(value);
  }
  return values;
}

} // namespace comparisons::metrics
