#pragma once

#include "fem_reference/elasticity/plane_elasticity.h"
#include "fem_reference/mesh/formulas.h"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

/// Exact solutions, meshes and error norms for the tests of fem_reference.
namespace fem_test {
using namespace fem_reference;
using namespace fem_reference::elasticity;
using Stress = std::array<double, 3>; // s11 s22 s12

/// An exact solution, point by point.
struct Exact {
  std::function<Vector(Point)> displacement;
  std::function<Stress(Point)> stress;
  std::function<Vector(Point)> body_force = {}; // empty: none
};

inline VectorField batch(const std::function<Vector(Point)> &function) {
  return [function](std::span<const Point> points, std::span<Vector> values) {
    for (std::size_t k = 0; k < points.size(); ++k)
      values[k] = function(points[k]);
  };
}

inline TractionField traction_of(const std::function<Stress(Point)> &stress) {
  return [stress](std::span<const Point> points, std::span<const Vector> normals, std::span<Vector> values) {
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto [s11, s22, s12] = stress(points[k]);
      const auto [n1, n2] = normals[k];
      values[k] = {s11 * n1 + s12 * n2, s12 * n1 + s22 * n2};
    }
  };
}

inline BoundaryCondition condition(const Exact &exact, ConditionKind kind_1, ConditionKind kind_2) {
  return {{kind_1, kind_2}, batch(exact.displacement), traction_of(exact.stress)};
}

constexpr auto fixed = ConditionKind::displacement;
constexpr auto loaded = ConditionKind::traction;

/// Displacement on the left edge (id 0), tractions on the three others.
inline PlaneProblem left_fixed(PlaneMesh mesh, const Material &material, const Exact &exact) {
  PlaneProblem problem{std::move(mesh), {material}, {{0, condition(exact, fixed, fixed)}}};
  for (int id = 1; id < 4; ++id)
    problem.boundary.emplace(id, condition(exact, loaded, loaded));
  if (exact.body_force)
    problem.body_force = batch(exact.body_force);
  return problem;
}

/// A grid whose interior vertices are moved by up to `amount` of the spacing in a fixed pattern.
inline PlaneMesh jittered(Point lower, Point upper, unsigned vertices_x, unsigned vertices_y, double amount = .25) {
  auto vertices = mesh::rectangle(lower, upper, vertices_x, vertices_y).vertices;
  const double hx = (upper[0] - lower[0]) / (vertices_x - 1);
  const double hy = (upper[1] - lower[1]) / (vertices_y - 1);
  for (unsigned j = 1; j + 1 < vertices_y; ++j)
    for (unsigned i = 1; i + 1 < vertices_x; ++i) {
      const unsigned k = j * vertices_x + i;
      vertices[k][0] += amount * hx * std::sin(12.9898 * k);
      vertices[k][1] += amount * hy * std::cos(78.233 * k);
    }
  return mesh::rectangle(vertices, vertices_x, vertices_y);
}

/// Relative discrete L2 errors of displacement and stress over a lattice of n x n points inside the
/// rectangle; points are not on any cell border of a grid.
struct Errors {
  double displacement;
  double stress;
};

inline Errors errors(const PlaneSolution &solution, const Exact &exact, Point lower, Point upper, unsigned n = 83) {
  std::vector<Point> points;
  for (unsigned j = 0; j < n; ++j)
    for (unsigned i = 0; i < n; ++i)
      points.push_back(
          {lower[0] + (upper[0] - lower[0]) * (i + .5) / n, lower[1] + (upper[1] - lower[1]) * (j + .5) / n});
  std::vector<Vector> displacement(points.size());
  std::vector<Stress> stress(points.size());
  solution.displacement(points, displacement);
  solution.stress(points, stress);
  double du = 0, u = 0, ds = 0, s = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto exact_u = exact.displacement(points[k]);
    const auto exact_s = exact.stress(points[k]);
    for (std::size_t d = 0; d < 2; ++d) {
      du += std::pow(displacement[k][d] - exact_u[d], 2);
      u += std::pow(exact_u[d], 2);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      ds += std::pow(stress[k][d] - exact_s[d], 2);
      s += std::pow(exact_s[d], 2);
    }
  }
  return {std::sqrt(du / u), std::sqrt(ds / s)};
}

inline Stress hooke(const Material &material, double e11, double e22, double e12) {
  const double trace = material.lambda() * (e11 + e22);
  return {trace + 2 * material.mu() * e11, trace + 2 * material.mu() * e22, 2 * material.mu() * e12};
}

/// u = a + B x with all components different from zero.
inline Exact linear_field(const Material &material) {
  return {[](Point x) -> Vector {
            return {1e-3 + 2e-3 * x[0] - 1e-3 * x[1], -2e-3 + 3e-3 * x[0] + 4e-3 * x[1]};
          },
          [material](Point) { return hooke(material, 2e-3, 4e-3, 1e-3); }};
}

/// The cantilever plate of Batra & Zhang (2008), equations (4.2) and (4.3), in plane stress, with its
/// lower left corner at `offset`.
struct Cantilever {
  double length = 1;
  double width = .2;
  double force = 1e6;
  Material material = Material(226.9e9, .33, PlaneModel::plane_stress);

  Exact exact(Point offset = {0, 0}) const {
    const auto self = *this;
    return {[self, offset](Point x) {
              const double e = self.material.youngs_modulus();
              const double nu = self.material.poisson_ratio();
              const double a = (x[0] - offset[0]) / self.width;
              const double b = (x[1] - offset[1]) / self.width;
              const double l = self.length / self.width;
              return Vector{-2 * self.force / e * (b - .5) * (3 * a * (2 * l - a) + (2 + nu) * b * (b - 1)),
                            2 * self.force / e *
                                (a * a * (3 * l - a) + 3 * nu * (l - a) * (b - .5) * (b - .5) + (4 + 5 * nu) / 4 * a)};
            },
            [self, offset](Point x) {
              const double a = (x[0] - offset[0]) / self.width;
              const double b = (x[1] - offset[1]) / self.width;
              const double scale = self.force / self.width;
              return Stress{-12 * scale * (self.length / self.width - a) * (b - .5), 0, -6 * scale * b * (b - 1)};
            }};
  }
};

/// The message of the InvalidInput or SolveFailure that a call ends with, or an empty text.
template <typename Error, typename Function>
std::string message_of(const Function &function) {
  try {
    function();
  } catch (const Error &error) {
    return error.what();
  }
  return {};
}
} // namespace fem_test

#define EXPECT_CONTAINS(text, part) EXPECT_NE(std::string(text).find(part), std::string::npos) << "message: " << (text)
