#pragma once

#include "comparisons/hard_cases/hard_case.h"
#include "comparisons/hard_cases/solvers.h"
#include "comparisons/problems/plane_problem.h"

#include <array>
#include <cstdint>
#include <functional>

namespace comparisons::hard_cases {

using problems::Material;
using problems::Point2;
using problems::Stress2;
using problems::Vector2;

/// A displacement with its gradient (u1,1 u1,2 u2,1 u2,2) and second derivatives (of u1: 11 12 22, of u2: 11 12 22).
struct Field {
  std::function<Vector2(Point2)> displacement;
  std::function<std::array<double, 4>(Point2)> gradient;
  std::function<std::array<double, 6>(Point2)> second = {}; ///< empty: no body force is needed
};

/// Hooke's law in the plane: lambda of plane stress or plane strain, and mu, Pa.
double lambda_of(const Material &material);
double mu_of(const Material &material);
Stress2 stress_of(const Material &material, const std::array<double, 4> &gradient);

/// All that a method needs for one case.
struct PlaneSetup {
  problems::PlaneStatement statement;
  problems::Cloud cloud;
  problems::Mesh mesh;
};

/// Conditions with an exact field as data: displacement on ids of `fixed`, traction on the others, body force if the
/// field needs one.
problems::PlaneStatement statement_of(std::vector<problems::Region> regions, const Field &field,
                                      const std::vector<int> &fixed);

/// A rectangle with n1 x n2 points, jittered by this part of the spacing, as a cloud and a mesh; the particles' spacing
/// is the mean of their four nearest and they count as irregular unless jitter is 0. Ids: 0 left, 1 right, 2 bottom,
/// 3 top; the left is fixed.
PlaneSetup rectangle(const Point2 &low, const Point2 &high, std::array<int, 2> n, double jitter, std::uint64_t seed,
                     const Material &material, const Field &field);

/// sqrt(sum |u - exact|^2 / sum |exact|^2) at points.
double displacement_error(const methods::Solution &solution, const std::vector<Point2> &points, const Field &field);

/// Solves and measures the displacement at `points` (empty: the vertices of the setup's mesh, else its particles).
Measurement measure(const std::string &method, const PlaneSetup &setup, const Field &field,
                    const std::map<std::string, scene::Value> &keys = {}, const std::vector<Point2> &points = {});

/// Adds the indicators of the error, and warnings where they are above their limits.
void check(const methods::Solution &solution, const PlaneSetup &setup, Measurement &measurement);

/// One component of the displacement or stress at a point, and the method's warnings.
Measurement measure_at(const std::string &method, const PlaneSetup &setup, const char *quantity, std::size_t component,
                       const Point2 &point, double reference, const std::map<std::string, scene::Value> &keys = {});

/// Timoshenko's cantilever of height `height` and length `length` from the left end, Batra & Zhang 2008, (4.2): a
/// cubic.
Field cantilever_field(double length, double height, const Material &material);

/// All first and second powers; the second scaled by `quadratic`.
Field polynomial_field(double quadratic);

} // namespace comparisons::hard_cases
