#include "comparisons/metrics/requested_quantities.h"

#include "comparisons/metrics/energy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace comparisons::metrics {

namespace {

using problems::Point2;
using problems::RequestedQuantity;
using problems::Stress2;
using Kind = RequestedQuantity::Kind;

/// In plane strain sigma_33 = nu (sigma_11 + sigma_22).
double von_mises(const Stress2 &s, const problems::Material &material) {
  const double s33 = material.plane_strain ? material.poisson_ratio * (s[0] + s[1]) : 0;
  const double squares = (s[0] - s[1]) * (s[0] - s[1]) + (s[1] - s33) * (s[1] - s33) + (s33 - s[0]) * (s33 - s[0]);
  return std::sqrt(0.5 * squares + 3 * s[2] * s[2]);
}

class Evaluation {
public:
  Evaluation(const methods::Solution &solution, const problems::PlaneProblem &problem,
             const problems::Quadrature &quadrature, const Equilibrium &equilibrium,
             std::map<std::string, double> &quantities)
      : solution_(solution), problem_(problem), quadrature_(quadrature), equilibrium_(equilibrium),
        quantities_(quantities) {
    const auto fields = solution.fields();
    recovered_ = std::find(fields.begin(), fields.end(), "recovered_stress") != fields.end();
  }

  void add(const RequestedQuantity &request) {
    switch (request.kind) {
    case Kind::displacement:
      return put(request, request.name, displacement(request));
    case Kind::stress:
      put(request, request.name, stress(request, "stress"));
      if (recovered_)
        put(request, request.name + "_recovered", stress(request, "recovered_stress"));
      return;
    case Kind::largest_von_mises:
      return put(request, request.name, largest_von_mises());
    case Kind::reaction:
      return put(request, request.name, reaction(request));
    case Kind::strain_energy:
      return put(request, request.name, strain_energy());
    }
  }

private:
  void put(const RequestedQuantity &request, const std::string &name, double value) {
    value /= request.scale;
    if (!std::isfinite(value))
      throw std::runtime_error(fmt::format("the quantity {} is not finite", name));
    quantities_[name] = value;
    if (request.reference) {
      const double difference = std::abs(value - *request.reference);
      quantities_[name + "_error"] = *request.reference == 0 ? difference : difference / std::abs(*request.reference);
    }
  }

  double displacement(const RequestedQuantity &request) const {
    std::vector<double> u(2);
    solution_.evaluate("displacement", std::span(&request.point, 1), u);
    return request.component == 2 ? std::hypot(u[0], u[1]) : u.at(static_cast<std::size_t>(request.component));
  }

  double stress(const RequestedQuantity &request, const char *field) const {
    Stress2 s{};
    solution_.evaluate(field, std::span(&request.point, 1), s);
    return request.component == 3 ? von_mises(s, material_near(request.point))
                                  : s.at(static_cast<std::size_t>(request.component));
  }

  /// Stress at the points of the quadrature, once for all that need it.
  const std::vector<double> &stresses() {
    if (stresses_.empty()) {
      stresses_.resize(3 * quadrature_.points.size());
      solution_.evaluate("stress", quadrature_.points, stresses_);
    }
    return stresses_;
  }

  const problems::Material &material_at(std::size_t q) const {
    const auto region = quadrature_.regions.empty() ? 0 : static_cast<std::size_t>(quadrature_.regions[q]);
    return problem_.statement().regions[region].material;
  }

  /// That of the nearest point of the quadrature.
  const problems::Material &material_near(const Point2 &x) const {
    const auto distance = [&](const Point2 &p) { return std::hypot(p[0] - x[0], p[1] - x[1]); };
    const auto nearest = std::ranges::min_element(quadrature_.points, {}, distance);
    return material_at(static_cast<std::size_t>(nearest - quadrature_.points.begin()));
  }

  double largest_von_mises() {
    const auto &s = stresses();
    double largest = 0;
    for (std::size_t q = 0; q < quadrature_.points.size(); ++q)
      largest = std::max(largest, von_mises({s[3 * q], s[3 * q + 1], s[3 * q + 2]}, material_at(q)));
    return largest;
  }

  double strain_energy() {
    if (const auto own = solution_.own_strain_energy())
      return *own;
    const auto &s = stresses();
    double energy = 0;
    for (std::size_t q = 0; q < quadrature_.points.size(); ++q)
      energy +=
          0.5 * quadrature_.weights[q] * twice_energy_density({s[3 * q], s[3 * q + 1], s[3 * q + 2]}, material_at(q));
    return energy;
  }

  double reaction(const RequestedQuantity &request) {
    const auto force = equilibrium_.boundary.find(request.id);
    if (force == equilibrium_.boundary.end())
      throw std::runtime_error(fmt::format("the quantity {} asks for the force on boundary {}, which has no condition",
                                           request.name, request.id));
    return force->second.at(static_cast<std::size_t>(request.component));
  }

  const methods::Solution &solution_;
  const problems::PlaneProblem &problem_;
  const problems::Quadrature &quadrature_;
  const Equilibrium &equilibrium_;
  std::map<std::string, double> &quantities_;
  bool recovered_ = false;
  std::vector<double> stresses_;
};

} // namespace

void add_requested_quantities(const methods::Solution &solution, const problems::PlaneProblem &problem,
                              const problems::Quadrature &quadrature, const Equilibrium &equilibrium,
                              std::map<std::string, double> &quantities) {
  Evaluation evaluation(solution, problem, quadrature, equilibrium, quantities);
  for (const auto &request : problem.quantities())
    evaluation.add(request);
}

} // namespace comparisons::metrics
