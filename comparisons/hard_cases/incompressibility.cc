#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include "meshless/cloud_generation/generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace comparisons::hard_cases {

namespace {

namespace generation = meshless::cloud_generation;

/// Moves the particles of one region and measures their spacing anew.
void jitter(const meshless::domain::Boundary &boundary, double amount, std::uint64_t seed, problems::Cloud &cloud) {
  const std::vector<meshless::domain::Boundary> boundaries{boundary};
  if (amount > 0)
    generation::jitter(boundaries, generation::local_spacing(boundaries, cloud.positions), {}, amount, seed,
                       cloud.positions);
  cloud.spacing = generation::local_spacing(boundaries, cloud.positions);
}

/// n x n cells between four curves, from points(i, j); ids of the sides i = 0, i = n, j = 0, j = n.
problems::Mesh block(int n1, int n2, const std::function<Point2(int, int)> &point, const std::array<int, 4> &ids,
                     bool arcs) {
  problems::Mesh mesh;
  const auto vertex = [&](int i, int j) { return static_cast<unsigned>(i * (n2 + 1) + j); };
  for (int i = 0; i <= n1; ++i)
    for (int j = 0; j <= n2; ++j)
      mesh.vertices.push_back(point(i, j));
  for (int i = 0; i < n1; ++i)
    for (int j = 0; j < n2; ++j)
      mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
  for (int j = 0; j < n2; ++j)
    for (const int i : {0, n1}) {
      mesh.boundary.push_back({{vertex(i, j), vertex(i, j + 1)}, ids[i == 0 ? 0 : 1]});
      if (arcs)
        mesh.boundary.back().arc_centre = Point2{0, 0};
    }
  for (int i = 0; i < n1; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, ids[2]});
    mesh.boundary.push_back({{vertex(i, n2), vertex(i + 1, n2)}, ids[3]});
  }
  return mesh;
}

/// Cook's membrane, E = 1, F = 1: a relaxed cloud of n^2 particles, jittered, and a mesh of (n - 1)^2 cells.
PlaneSetup cook(double nu, int n, double amount, std::uint64_t seed) {
  const Material material{1, nu, true};
  const Point2 a{0, 0}, b{48, 44}, c{48, 60}, d{0, 44};
  const Field nothing{[](Point2) -> Vector2 { return {0, 0}; }, [](Point2) -> std::array<double, 4> { return {}; }};
  PlaneSetup setup;
  setup.statement = statement_of(
      {{"", material, {{a, b, 2, "bottom"}, {b, c, 1, "right"}, {c, d, 3, "top"}, {d, a, 0, "left"}}}}, nothing, {0});
  setup.statement.conditions[1].traction = [](std::span<const Point2>, std::span<const Vector2>, std::span<Vector2> t) {
    std::fill(t.begin(), t.end(), Vector2{0, 1. / 16});
  };
  setup.statement.characteristic_length = 48;
  setup.statement.corners = {{"NE", c}, {"SE", b}, {"SW", a}, {"NW", d}};
  const meshless::domain::Boundary boundary({{a, b, 2}, {b, c, 1}, {c, d, 3}, {d, a, 0}});
  const auto even = [](std::span<const Point2>, std::span<double> spacing) {
    std::fill(spacing.begin(), spacing.end(), 1.0);
  };
  setup.cloud.positions = generation::generate({{boundary}, even, seed, static_cast<std::size_t>(n * n), {}}).positions;
  jitter(boundary, amount, seed, setup.cloud);
  setup.mesh = block(
      n - 1, n - 1,
      [=](int i, int j) -> Point2 {
        const double s = static_cast<double>(i) / (n - 1), t = static_cast<double>(j) / (n - 1);
        return {48 * s, (1 - t) * 44 * s + t * (44 + 16 * s)};
      },
      {0, 1, 2, 3}, false);
  return setup;
}

/// Lame's thick cylinder, radii 1 and 2, unit pressure inside: a quarter with rollers on its cuts.
PlaneSetup cylinder(double nu, int n, double amount, std::uint64_t seed) {
  const Material material{1, nu, true};
  const double A = .5 / (1.5 * (2 * lambda_of(material) + 2 * mu_of(material)));
  const double B = 2 / (3 * mu_of(material));
  const Field field{[=](Point2 p) -> Vector2 {
                      const double f = A + B / (p[0] * p[0] + p[1] * p[1]);
                      return {f * p[0], f * p[1]};
                    },
                    [=](Point2 p) -> std::array<double, 4> {
                      const auto [x, y] = p;
                      const double r2 = x * x + y * y, f = A + B / r2, g = -2 * B / (r2 * r2);
                      return {f + g * x * x, g * x * y, g * x * y, f + g * y * y};
                    }};
  PlaneSetup setup;
  const auto arc = [](bool ccw) { return problems::Arc{{0, 0}, ccw}; };
  setup.statement = statement_of({{"",
                                   material,
                                   {{{1, 0}, {2, 0}, 0, "bottom"},
                                    {{2, 0}, {0, 2}, 1, "outside", arc(true)},
                                    {{0, 2}, {0, 1}, 2, "left"},
                                    {{0, 1}, {1, 0}, 3, "inside", arc(false)}}}},
                                 field, {});
  setup.statement.conditions[0].displacement_prescribed = {false, true};
  setup.statement.conditions[2].displacement_prescribed = {true, false};
  setup.statement.corners = {{"SW", {1, 0}}, {"SE", {2, 0}}, {"NE", {0, 2}}, {"NW", {0, 1}}};
  const meshless::domain::Boundary boundary({{{1, 0}, {2, 0}, 0},
                                             {{2, 0}, {0, 2}, 1, meshless::domain::Arc{{0, 0}, true}},
                                             {{0, 2}, {0, 1}, 2},
                                             {{0, 1}, {1, 0}, 3, meshless::domain::Arc{{0, 0}, false}}});
  const int n_angle = static_cast<int>(std::lround((n - 1) * .75 * std::numbers::pi));
  const auto point = [=](int i, int j) -> Point2 {
    const double r = 1 + static_cast<double>(i) / (n - 1), angle = std::numbers::pi / 2 * j / n_angle;
    return {j == n_angle ? 0 : r * std::cos(angle), j == 0 ? 0 : r * std::sin(angle)};
  };
  setup.mesh = block(n - 1, n_angle, point, {3, 1, 0, 2}, true);
  setup.cloud.positions = setup.mesh.vertices;
  jitter(boundary, amount, seed, setup.cloud);
  return setup;
}

/// The worst of several seeds.
Measurement worst(int n_seeds, const std::function<Measurement(std::uint64_t)> &run) {
  Measurement result{-1};
  for (int seed = 0; seed < n_seeds; ++seed) {
    auto next = run(static_cast<std::uint64_t>(seed));
    if (!(next.error <= result.error)) // a NaN is kept
      result = std::move(next);
  }
  return result;
}

} // namespace

std::vector<HardCase> incompressibility_cases() {
  std::vector<HardCase> cases;
  const std::pair<double, double> tips[] = {{.3, 21.94}, {.49, 18.73}, {.4999, 18.512}, {.499999, 18.508}};
  const std::vector<std::string> some{"weak1", "weak1 consistent", "mixed", "fem Q1", "fem Q2", "fem Q2Q1"};
  for (const auto &[nu_, tip_] : tips) {
    const double nu = nu_, tip = tip_;
    for (const int n_seeds : {1, 20}) {
      const bool all = n_seeds == 20;
      if (all && nu < .4999)
        continue;
      cases.push_back({"incompressibility", fmt::format("cook nu={}{}", nu, all ? ", 20 clouds" : ""),
                       fmt::format("Cook's membrane in plane strain, 625 particles jittered by 25 % ({}), or 24 x 24 "
                                   "cells; error of the tip's u2",
                                   all ? "the worst of 20 seeds" : "one seed"),
                       fmt::format("u2(48, 52) = {}, computed at high order", tip), .02,
                       "2 %: the corner singularity on 25 points a side",
                       all ? std::vector<std::string>{"mixed"} : some, !all, [=](const std::string &m) {
                         return worst(n_seeds, [&](std::uint64_t seed) {
                           return measure_at(m, cook(nu, 25, .25, seed), "displacement", 1, {48, 52}, tip);
                         });
                       }});
    }
  }
  for (const double nu : {.3, .4999, .499999}) {
    cases.push_back({"incompressibility", fmt::format("thick cylinder nu={}", nu),
                     "Lame's cylinder in plane strain, 21 particles along the radius, jittered by 25 %; error of the "
                     "hoop stress inside",
                     "p (b^2 + a^2) / (b^2 - a^2) = 5/3", .02,
                     "2 %: first derivatives on a boundary, (h / a)^2 = .0025 "
                     "with a factor",
                     some, true, [=](const std::string &m) {
                       return measure_at(m, cylinder(nu, 21, .25, 1), "stress", 1, {1, 0}, 5. / 3);
                     }});
    cases.push_back({"incompressibility", fmt::format("cantilever nu={}", nu),
                     "Timoshenko's cantilever in plane strain, L/h = 5, 31 x 7 points jittered by 25 %; error of u",
                     "the polynomial, Batra & Zhang 2008 (4.2)", .05,
                     "5 %: ten times what a basis of order 2 leaves on the uniform grid", all_solvers(), true,
                     [=](const std::string &m) {
                       const Material material{1, nu, true};
                       const auto field = cantilever_field(1, .2, material);
                       return measure(m, rectangle({0, 0}, {1, .2}, {31, 7}, .25, 1, material, field), field);
                     }});
  }
  return cases;
}

} // namespace comparisons::hard_cases
