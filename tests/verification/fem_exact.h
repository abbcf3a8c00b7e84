#pragma once

#include "fem_support.h"

#include <numbers>

/// Exact solutions on curved domains, written from the textbooks.
namespace fem_test {
/// Infinite plate with a circular hole of radius b under the tension s along x1 (Kirsch 1898), with the
/// displacement of Muskhelishvili's potentials; kappa = 3 - 4 nu in plane strain, (3 - nu) / (1 + nu) in plane stress.
inline Exact kirsch(const Material &material, double b, double s) {
  const double nu = material.poisson_ratio();
  const double kappa = material.model() == PlaneModel::plane_strain ? 3 - 4 * nu : (3 - nu) / (1 + nu);
  const double mu = material.mu();
  return {[=](Point x) {
            const double r = std::hypot(x[0], x[1]) / b;
            const double t = std::atan2(x[1], x[0]);
            const double scale = s * b / (8 * mu);
            return Vector{
                scale * (r * (kappa + 1) * std::cos(t) + 2 / r * ((1 + kappa) * std::cos(t) + std::cos(3 * t)) -
                         2 / (r * r * r) * std::cos(3 * t)),
                scale * (r * (kappa - 3) * std::sin(t) + 2 / r * ((1 - kappa) * std::sin(t) + std::sin(3 * t)) -
                         2 / (r * r * r) * std::sin(3 * t))};
          },
          [=](Point x) {
            const double q = b * b / (x[0] * x[0] + x[1] * x[1]);
            const double t = std::atan2(x[1], x[0]);
            const double c2 = std::cos(2 * t), c4 = std::cos(4 * t), s2 = std::sin(2 * t), s4 = std::sin(4 * t);
            return Stress{s * (1 - q * (1.5 * c2 + c4) + 1.5 * q * q * c4),
                          s * (-q * (.5 * c2 - c4) - 1.5 * q * q * c4), s * (-q * (.5 * s2 + s4) + 1.5 * q * q * s4)};
          }};
}

/// One layer of a thick-walled cylinder (Lame 1852): sigma_r = A - B / r^2, sigma_theta = A + B / r^2,
/// u_r = A r / (2 (lambda + mu)) + B / (2 mu r) with the constants of the plane law.
struct LameLayer {
  Material material;
  double outer_radius;
  double a;
  double b;

  double radial_stress(double r) const { return a - b / (r * r); }
  double radial_displacement(double r) const {
    return a * r / (2 * (material.lambda() + material.mu())) + b / (2 * material.mu() * r);
  }
};

/// The solution over layers from the inside outwards; a point between two belongs to the inner one.
inline Exact lame(const std::vector<LameLayer> &layers) {
  const auto layer_of = [layers](double r) {
    for (const auto &layer : layers)
      if (r <= layer.outer_radius)
        return layer;
    return layers.back();
  };
  return {[=](Point x) {
            const double r = std::hypot(x[0], x[1]);
            const double u = layer_of(r).radial_displacement(r);
            return Vector{u * x[0] / r, u * x[1] / r};
          },
          [=](Point x) {
            const double r = std::hypot(x[0], x[1]);
            const auto layer = layer_of(r);
            const double c = x[0] / r, s = x[1] / r;
            const double radial = layer.a - layer.b / (r * r), hoop = layer.a + layer.b / (r * r);
            return Stress{radial * c * c + hoop * s * s, radial * s * s + hoop * c * c, (radial - hoop) * c * s};
          }};
}

/// Ring under a pressure inside.
inline std::vector<LameLayer> pressed_ring(const Material &material, double inner, double outer, double pressure) {
  const double a = pressure * inner * inner / (outer * outer - inner * inner);
  return {{material, outer, a, a * outer * outer}};
}

/// Ring of two materials under a pressure inside; the pressure at the interface makes both displacements one.
inline std::vector<LameLayer> pressed_double_ring(const Material &first, const Material &second, double inner,
                                                  double interface, double outer, double pressure) {
  // The displacement of each layer at the interface is linear in the unknown pressure there.
  const auto layers = [&](double between) {
    const double square = interface * interface;
    const double a1 = (pressure * inner * inner - between * square) / (square - inner * inner);
    const double b1 = (pressure - between) * inner * inner * square / (square - inner * inner);
    const double a2 = between * square / (outer * outer - square);
    return std::vector<LameLayer>{{first, interface, a1, b1}, {second, outer, a2, a2 * outer * outer}};
  };
  const auto gap = [&](double between) {
    const auto both = layers(between);
    return both[0].radial_displacement(interface) - both[1].radial_displacement(interface);
  };
  const double at_zero = gap(0);
  const double at_pressure = gap(pressure);
  return layers(pressure * at_zero / (at_zero - at_pressure));
}

/// Relative L2 errors over given points with given weights, and how many of these the mesh does not hold.
struct Norms {
  double displacement = 0;
  double stress = 0;
  double recovered = 0;
  std::size_t outside = 0;
};

/// Points of a domain given as the image of the unit square, with the weights of the midpoint rule on n x n cells: over
/// the exact domain, independent of the mesh.
struct Sampling {
  std::vector<Point> points;
  std::vector<double> weights;
};

inline Sampling sample(const std::function<Point(double, double)> &map, unsigned n) {
  Sampling result;
  const double step = 1e-5;
  for (unsigned j = 0; j < n; ++j)
    for (unsigned i = 0; i < n; ++i) {
      const double s = (i + .5) / n, t = (j + .5) / n;
      const Point a = map(s - step, t), b = map(s + step, t), c = map(s, t - step), d = map(s, t + step);
      result.points.push_back(map(s, t));
      result.weights.push_back(std::abs((b[0] - a[0]) * (d[1] - c[1]) - (b[1] - a[1]) * (d[0] - c[0])));
    }
  return result;
}

inline Sampling sample_ring(double inner, double outer, double angle, unsigned n = 67) {
  return sample(
      [=](double s, double t) {
        const double r = inner + s * (outer - inner);
        return Point{r * std::cos(t * angle), r * std::sin(t * angle)};
      },
      n);
}

/// The quarter plate as an image of the unit square: t = 1/2 is the diagonal.
inline Sampling sample_plate(double radius, double half_width, unsigned n = 120) {
  return sample(
      [=](double s, double t) {
        const double angle = .5 * std::numbers::pi * t;
        const double reach = half_width / std::max(std::cos(angle), std::sin(angle));
        const double r = radius * std::pow(reach / radius, s); // denser near the hole
        return Point{r * std::cos(angle), r * std::sin(angle)};
      },
      n);
}

inline Norms norms(const PlaneSolution &solution, const Exact &exact, const Sampling &sampling) {
  const auto &points = sampling.points;
  std::vector<Vector> displacement(points.size());
  std::vector<Stress> stress(points.size()), recovered(points.size());
  solution.displacement(points, displacement);
  Norms result;
  result.outside = solution.points_outside();
  solution.stress(points, stress);
  solution.recovered_stress(points, recovered);
  double u = 0, s = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double w = sampling.weights[k];
    const auto exact_u = exact.displacement(points[k]);
    const auto exact_s = exact.stress(points[k]);
    for (std::size_t d = 0; d < 2; ++d) {
      result.displacement += w * std::pow(displacement[k][d] - exact_u[d], 2);
      u += w * std::pow(exact_u[d], 2);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      result.stress += w * std::pow(stress[k][d] - exact_s[d], 2);
      result.recovered += w * std::pow(recovered[k][d] - exact_s[d], 2);
      s += w * std::pow(exact_s[d], 2);
    }
  }
  result.displacement = std::sqrt(result.displacement / u);
  result.stress = std::sqrt(result.stress / s);
  result.recovered = std::sqrt(result.recovered / s);
  return result;
}

/// Reactions and applied loads added up, over the sum of absolute loads (or reactions, where nothing is applied).
inline double imbalance(const PlaneSolution &solution) {
  Vector sum = solution.applied_body_force();
  double size = solution.load_magnitude();
  for (const auto &[id, force] : solution.applied_tractions())
    for (std::size_t d = 0; d < 2; ++d)
      sum[d] += force[d];
  for (const auto &[id, force] : solution.reactions())
    for (std::size_t d = 0; d < 2; ++d) {
      sum[d] += force[d];
      size += solution.load_magnitude() > 0 ? 0 : std::abs(force[d]);
    }
  return std::hypot(sum[0], sum[1]) / size;
}

/// The quarter plate under exact tractions, symmetric about both axes (ids of quarter_plate_with_hole).
inline PlaneProblem plate_problem(PlaneMesh mesh, const Material &material, double radius, double tension) {
  const auto exact = kirsch(material, radius, tension);
  const auto zero = batch([](Point) { return Vector{0, 0}; });
  return {std::move(mesh),
          {material},
          {{0, {{fixed, loaded}, zero, {}}},
           {1, {{loaded, fixed}, zero, {}}},
           {2, condition(exact, loaded, loaded)},
           {3, condition(exact, loaded, loaded)},
           {4, {}}}};
}

/// A ring under `exact`, free of friction on both straight sides (ids of ring_sector with a quarter turn).
inline PlaneProblem ring_problem(PlaneMesh mesh, std::vector<Material> materials, const Exact &exact) {
  const auto zero = batch([](Point) { return Vector{0, 0}; });
  return {std::move(mesh),
          std::move(materials),
          {{0, condition(exact, loaded, loaded)},
           {1, condition(exact, loaded, loaded)},
           {2, {{loaded, fixed}, zero, {}}},
           {3, {{fixed, loaded}, zero, {}}}}};
}

/// SCF at (0, b) raw and recovered, over the exact 3.
inline std::array<double, 2> concentration_errors(const PlaneSolution &solution, double radius, double tension) {
  const Point pole = {0, radius};
  Stress raw{}, recovered{};
  solution.stress({&pole, 1}, {&raw, 1});
  solution.recovered_stress({&pole, 1}, {&recovered, 1});
  return {std::abs(raw[0] / tension - 3) / 3, std::abs(recovered[0] / tension - 3) / 3};
}
} // namespace fem_test
