#pragma once

#include "plane_samples.h"

#include <numbers>

/// Domains with holes, slots and corners, and clouds for them.
namespace plane_samples {

inline Exact linear_displacement() {
  return {[](Point2 p) -> Vector2 {
            return {.1 + .3 * p[0] - .2 * p[1], -.3 + .4 * p[0] + .5 * p[1]};
          },
          [](Point2) -> std::array<double, 4> {
            return {.3, -.2, .4, .5};
          },
          {}};
}

/// All six second derivatives, and the body force that belongs to them.
inline Exact quadratic_displacement(const Material &d) {
  const double a1 = .3, b1 = -.4, c1 = .2, a2 = -.5, b2 = .6, c2 = .35;
  return {[=](Point2 p) -> Vector2 {
            const auto [x, y] = p;
            return {a1 * x * x + b1 * x * y + c1 * y * y + .2 * x, a2 * x * x + b2 * x * y + c2 * y * y - .1 * x};
          },
          [=](Point2 p) -> std::array<double, 4> {
            const auto [x, y] = p;
            return {2 * a1 * x + b1 * y + .2, b1 * x + 2 * c1 * y, 2 * a2 * x + b2 * y - .1, b2 * x + 2 * c2 * y};
          },
          [=](Point2) -> Vector2 {
            return {-(d.axial() * 2 * a1 + d.coupling() * b2 + d.shear() * (2 * c1 + b2)),
                    -(d.shear() * (b1 + 2 * a2) + d.coupling() * b1 + d.axial() * 2 * c2)};
          }};
}

/// A domain of one or several regions with the exact solution as data: displacement on `fixed_ids`, traction elsewhere.
inline PlaneProblem problem_on(std::vector<Region> regions, const Exact &exact, const std::vector<int> &fixed_ids) {
  PlaneProblem problem{std::move(regions), {}, {}};
  for (const auto &region : problem.regions)
    for (const auto &piece : region.boundary.pieces())
      if (piece.id != interface_id) {
        const bool held = std::find(fixed_ids.begin(), fixed_ids.end(), piece.id) != fixed_ids.end();
        const auto kind = held ? fixed : loaded;
        problem.conditions[piece.id] = {{kind, kind}, field(exact.displacement), traction_of(region.material, exact)};
      }
  if (exact.body_force)
    problem.body_force = field(exact.body_force);
  return problem;
}

/// Quarter of a square plate of edge 3 with a hole of radius 1 around the origin: ids 0 on x2 = 0, 1 right, 2 top,
/// 3 on x1 = 0, 4 the hole.
inline domain::Boundary quarter_plate() {
  return domain::Boundary({{{1, 0}, {3, 0}, 0},
                           {{3, 0}, {3, 3}, 1},
                           {{3, 3}, {0, 3}, 2},
                           {{0, 3}, {0, 1}, 3},
                           {{0, 1}, {1, 0}, 4, domain::Arc{{0, 0}, false}}});
}

/// n points on the hole, rings graded outwards to the square, jittered by this fraction of the spacing; particles on
/// the boundary stay on it. h is the mean distance of the four nearest.
inline cloud::Particles<2> quarter_plate_cloud(int n, double fraction, std::uint64_t seed) {
  sample_clouds::Uniform random(seed);
  const double quarter = std::numbers::pi / 2;
  const int n_rings = n; // from h = quarter / (n - 1) to about three times that
  std::vector<Point2> points;
  for (int i = 0; i < n_rings; ++i) {
    const double u = static_cast<double>(i) / (n_rings - 1);
    for (int j = 0; j < n; ++j) {
      const bool edge_r = i == 0 || i + 1 == n_rings;
      const bool edge_a = j == 0 || j + 1 == n || (i + 1 == n_rings && 2 * j == n - 1);
      const double move_a = edge_a ? 0 : fraction * random.between(-1, 1) / (n - 1);
      const double move_u = edge_r ? 0 : fraction * random.between(-1, 1) / (n_rings - 1);
      const double t = u + move_u;
      const double s = t * (.5 + .5 * t); // graded
      const double angle = quarter * (static_cast<double>(j) / (n - 1) + move_a);
      const double c = std::cos(angle), sn = std::sin(angle);
      const double out = 3 / std::max(c, sn); // on the square
      const double r = 1 + (out - 1) * s;
      Point2 x{r * c, r * sn};
      if (i + 1 == n_rings)
        x[c >= sn ? 0 : 1] = 3;
      if (j == 0)
        x[1] = 0;
      if (j + 1 == n)
        x[0] = 0;
      if (i + 1 == n_rings && 2 * j == n - 1)
        x = {3, 3};
      points.push_back(x);
    }
  }
  return sample_clouds::with_mean_lengths<2>(std::move(points));
}

/// Relative L2 errors at random points of the domain.
inline Errors errors_at_random(const ParticleSolution &solution, const Exact &exact, std::size_t n,
                               std::uint64_t seed) {
  const auto &all = solution.surroundings();
  Errors result;
  double error_u = 0, norm_u = 0, error_s = 0, norm_s = 0;
  for (std::size_t r = 0; r < all.n_regions(); ++r) {
    auto points = sample_clouds::random_points<2>(n, all.boundary(r).lower(), all.boundary(r).upper(), seed);
    std::erase_if(points, [&](const Point2 &x) { return !all.boundary(r).contains(x); });
    const std::vector<int> regions(points.size(), static_cast<int>(r));
    std::vector<Vector2> u(points.size());
    std::vector<Stress2> s(points.size());
    solution.displacement(points, u, regions);
    solution.stress(points, s, regions);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto exact_u = exact.displacement(points[i]);
      const auto exact_s = stress_of(all.material(r), exact.gradient(points[i]));
      for (std::size_t k = 0; k < 2; ++k) {
        error_u += std::pow(u[i][k] - exact_u[k], 2);
        norm_u += std::pow(exact_u[k], 2);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        error_s += std::pow(s[i][k] - exact_s[k], 2);
        norm_s += std::pow(exact_s[k], 2);
      }
    }
  }
  result.displacement = std::sqrt(error_u / norm_u);
  result.stress = std::sqrt(error_s / norm_s);
  return result;
}

/// Ways to solve a problem in weak form, all at nG = 10.
enum class WeakForm { weak1, weak2, heaviside, hybrid, hybrid_heaviside };

inline std::string name_of(WeakForm form) {
  const char *names[] = {"weak1", "weak2", "heaviside", "hybrid", "hybrid_heaviside"};
  return names[static_cast<int>(form)];
}

inline ParticleSolution solve(WeakForm form, const PlaneProblem &problem, const cloud::Particles<2> &particles,
                              int order) {
  weak_form::Parameters p;
  p.subdomains = weak_form::Subdomains::shrunk;
  p.test_radius = .85;
  p.characteristic_length = 3;
  if (form == WeakForm::weak2)
    p.derivatives = DerivativeRule::differentiated;
  if (form == WeakForm::heaviside || form == WeakForm::hybrid_heaviside) {
    p.test_function.reset();
    p.test_radius = .6;
  }
  if (form == WeakForm::hybrid || form == WeakForm::hybrid_heaviside)
    p.interior_rows = weak_form::InteriorRows::collocated;
  return weak_form::solve(problem, std::make_shared<const cloud::Particles<2>>(particles),
                          basis::make_ssph<2>(order, kernels::Gauss(order + 2)), p);
}

} // namespace plane_samples
