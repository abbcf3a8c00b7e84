#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include "comparisons/problems/exact_solutions.h"

#include "meshless/cloud_generation/generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace comparisons::hard_cases {

namespace {

namespace generation = meshless::cloud_generation;

/// A bar of two materials in series, pulled; nu = 0: the strain is 1 on the left and E_left / E_right on the right.
PlaneSetup bar_of_two(double contrast, Field &field) {
  const Material left{1, 0, false}, right{contrast, 0, false};
  field = {[=](Point2 p) -> Vector2 {
             return {p[0] < 1 ? p[0] : 1 + (p[0] - 1) / contrast, 0};
           },
           [=](Point2 p) -> std::array<double, 4> {
             return {p[0] < 1 ? 1 : 1 / contrast, 0, 0, 0};
           }};
  PlaneSetup setup;
  const int interface = problems::interface_id;
  setup.statement.regions = {{"left",
                              left,
                              {{{0, 0}, {1, 0}, 2, "bottom"},
                               {{1, 0}, {1, .5}, interface, "inside"},
                               {{1, .5}, {0, .5}, 3, "top"},
                               {{0, .5}, {0, 0}, 0, "left"}}},
                             {"right",
                              right,
                              {{{1, 0}, {2, 0}, 2, "bottom"},
                               {{2, 0}, {2, .5}, 1, "right"},
                               {{2, .5}, {1, .5}, 3, "top"},
                               {{1, .5}, {1, 0}, interface, "inside"}}}};
  for (int id = 0; id < 4; ++id)
    setup.statement.conditions[id] = {};
  const auto zero = [](std::span<const Point2>, std::span<Vector2> u) { std::fill(u.begin(), u.end(), Vector2{}); };
  setup.statement.conditions[0].displacement_prescribed = {true, true};
  setup.statement.conditions[0].displacement = zero;
  setup.statement.conditions[1].traction = [](std::span<const Point2>, std::span<const Vector2>, std::span<Vector2> t) {
    std::fill(t.begin(), t.end(), Vector2{1, 0});
  };
  setup.statement.characteristic_length = 2;
  constexpr int n = 10, m = 5;
  for (int region = 0; region < 2; ++region)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j) {
        setup.cloud.positions.push_back({region + static_cast<double>(i) / n, .1 * j});
        setup.cloud.spacing.push_back(.1);
        setup.cloud.regions.push_back(region);
      }
  setup.cloud.regular = true;
  const auto vertex = [](int i, int j) { return static_cast<unsigned>(i * (m + 1) + j); };
  for (int i = 0; i <= 2 * n; ++i)
    for (int j = 0; j <= m; ++j)
      setup.mesh.vertices.push_back({static_cast<double>(i) / n, .1 * j});
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < m; ++j)
      setup.mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}, 4, i >= n});
  for (int j = 0; j < m; ++j) {
    setup.mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, 0});
    setup.mesh.boundary.push_back({{vertex(2 * n, j), vertex(2 * n, j + 1)}, 1});
  }
  for (int i = 0; i < 2 * n; ++i) {
    setup.mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 2});
    setup.mesh.boundary.push_back({{vertex(i, m), vertex(i + 1, m)}, 3});
  }
  return setup;
}

/// A cloud for a polygon, ids of its sides in turn; the mesh is empty.
PlaneSetup polygon(const std::vector<Point2> &corners, double spacing, const Material &material, const Field &field,
                   const std::vector<int> &fixed) {
  PlaneSetup setup;
  problems::Region region{"", material, {}};
  std::vector<meshless::domain::BoundaryPiece> pieces;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto &begin = corners[i], &end = corners[(i + 1) % corners.size()];
    region.boundary.push_back({begin, end, static_cast<int>(i), fmt::format("side {}", i)});
    pieces.push_back({begin, end, static_cast<int>(i)});
  }
  const auto even = [spacing](std::span<const Point2>, std::span<double> s) { std::fill(s.begin(), s.end(), spacing); };
  auto cloud = generation::generate({{meshless::domain::Boundary(std::move(pieces))}, even, 1, {}, {}});
  setup.cloud = {std::move(cloud.positions), std::move(cloud.spacing), {}, false};
  setup.statement = statement_of({std::move(region)}, field, fixed);
  return setup;
}

/// The L-shape in cells of 1/n, ids of its sides as in l_shape.
problems::Mesh l_mesh(int n) {
  problems::Mesh mesh;
  std::map<std::array<int, 2>, unsigned> numbers;
  const auto vertex = [&](int i, int j) {
    const auto [found, is_new] = numbers.try_emplace({i, j}, static_cast<unsigned>(mesh.vertices.size()));
    if (is_new)
      mesh.vertices.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n});
    return found->second;
  };
  for (int i = -n; i < n; ++i)
    for (int j = -n; j < n; ++j)
      if (i >= 0 || j >= 0)
        mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
  for (int k = -n; k < n; ++k) {
    mesh.boundary.push_back({{vertex(n, k), vertex(n, k + 1)}, 2});
    mesh.boundary.push_back({{vertex(k, n), vertex(k + 1, n)}, 3});
    if (k < 0) {
      mesh.boundary.push_back({{vertex(0, k), vertex(0, k + 1)}, 0});
      mesh.boundary.push_back({{vertex(k, 0), vertex(k + 1, 0)}, 5});
    } else {
      mesh.boundary.push_back({{vertex(k, -n), vertex(k + 1, -n)}, 1});
      mesh.boundary.push_back({{vertex(-n, k), vertex(-n, k + 1)}, 4});
    }
  }
  return mesh;
}

/// The L-shape with a corner of 270 degrees at the origin, the third quadrant missing: displacement and tractions of
/// the strongest symmetric singularity.
struct LShape {
  PlaneSetup setup;
  problems::ExactSolution exact;
  Field field;
};

LShape l_shape(double spacing) {
  const Material material{1, .3, true};
  const auto exact = problems::reentrant_corner(1, material);
  const Field field{[=](Point2 p) {
                      Vector2 u;
                      exact.displacement({&p, 1}, {&u, 1});
                      return u;
                    },
                    [](Point2) -> std::array<double, 4> { return {}; }};
  auto setup = polygon({{0, 0}, {0, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, 0}}, spacing, material, field, {2});
  for (auto &[id, condition] : setup.statement.conditions)
    if (id != 2)
      condition.traction = [exact, id = id](std::span<const Point2> x, std::span<const Vector2> n,
                                            std::span<Vector2> t) {
        std::vector<Stress2> s(x.size());
        exact.stress(x, s);
        for (std::size_t i = 0; i < x.size(); ++i)
          t[i] = id == 0 || id == 5
                     ? Vector2{} // free faces: the stress is infinite in the corner
                     : Vector2{s[i][0] * n[i][0] + s[i][2] * n[i][1], s[i][2] * n[i][0] + s[i][1] * n[i][1]};
      };
  return {std::move(setup), exact, field};
}

Measurement l_shape_error(const std::string &method, double spacing) {
  const auto shape = l_shape(spacing);
  return measure(method, shape.setup, shape.field);
}

/// The relative L2 error of the stress over the L-shape, the square root of the integral of the square of the
/// difference. Shells that halve towards the corner, since the cells at the corner hold most of the error; 16 squares
/// along a side, which no spacing divides: the stress of elements is better than elsewhere in their centres.
Measurement l_shape_stress_error(const std::string &method, double spacing) {
  auto shape = l_shape(spacing);
  if (method.starts_with("fem"))
    shape.setup.mesh = l_mesh(static_cast<int>(std::lround(1 / spacing)));
  const auto solution = solve(method, shape.setup.statement, shape.setup.cloud, shape.setup.mesh);
  std::vector<Point2> points;
  std::vector<double> areas;
  constexpr int n = 16, n_shells = 14;
  for (int shell = 0; shell < n_shells; ++shell) {
    const double size = std::ldexp(1., -shell - 1) / n;
    for (int i = -2 * n; i < 2 * n; ++i)
      for (int j = -2 * n; j < 2 * n; ++j)
        if ((i >= 0 || j >= 0) && (i < -n || i >= n || j < -n || j >= n)) {
          points.push_back({(i + .5) * size, (j + .5) * size});
          areas.push_back(size * size);
        }
  }
  std::vector<Stress2> exact(points.size());
  shape.exact.stress(points, exact);
  const std::size_t n_components = solution->n_components("stress");
  std::vector<double> own(points.size() * n_components);
  solution->evaluate("stress", points, own);
  double difference = 0, size = 0;
  for (std::size_t q = 0; q < points.size(); ++q)
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = (k == 2 ? 2 : 1) * areas[q]; // the shear stands twice in sigma : sigma
      difference += weight * std::pow(own[q * n_components + k] - exact[q][k], 2);
      size += weight * std::pow(exact[q][k], 2);
    }
  return {std::sqrt(difference / size), {}, solution->record().warnings};
}

/// Rate of the stress over three spacings.
Measurement l_shape_energy_rate(const std::string &method) {
  std::array<double, 3> errors{};
  Measurement result;
  for (std::size_t level = 0; level < 3; ++level) {
    const auto at_level = l_shape_stress_error(method, .1 / (1 << level));
    errors[level] = at_level.error;
    result.warnings = at_level.warnings;
  }
  const double first = std::log2(errors[0] / errors[1]), second = std::log2(errors[1] / errors[2]);
  const double rate = (first + second) / 2;
  result.value = rate;
  const double shortfall = problems::reentrant_corner_exponent() - rate;
  result.error = shortfall <= 0 ? 0 : shortfall; // a NaN is kept
  return result;
}

/// The cells of a plate with a slot from the right, y0 half of its width; ids of the sides as in tuning_fork.
problems::Mesh slotted_mesh(double y0) {
  constexpr int nx = 20, n_arm = 4, ny = 2 * n_arm + 1, root = 6; // cells; the slot is the row in the middle
  const auto y = [y0](int j) {
    return j <= n_arm ? -.5 + (.5 - y0) * j / n_arm : y0 + (.5 - y0) * (j - n_arm - 1) / n_arm;
  };
  problems::Mesh mesh;
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      mesh.vertices.push_back({.1 * i, y(j)});
  const auto vertex = [](int i, int j) { return static_cast<unsigned>(i * (ny + 1) + j); };
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      if (i < root || j != n_arm)
        mesh.cells.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
  for (int i = 0; i < nx; ++i) {
    mesh.boundary.push_back({{vertex(i, 0), vertex(i + 1, 0)}, 0});
    mesh.boundary.push_back({{vertex(i, ny), vertex(i + 1, ny)}, 6});
    if (i >= root) {
      mesh.boundary.push_back({{vertex(i, n_arm), vertex(i + 1, n_arm)}, 2});
      mesh.boundary.push_back({{vertex(i, n_arm + 1), vertex(i + 1, n_arm + 1)}, 4});
    }
  }
  mesh.boundary.push_back({{vertex(root, n_arm), vertex(root, n_arm + 1)}, 3});
  for (int j = 0; j < ny; ++j) {
    mesh.boundary.push_back({{vertex(0, j), vertex(0, j + 1)}, 7});
    if (j != n_arm)
      mesh.boundary.push_back({{vertex(nx, j), vertex(nx, j + 1)}, j < n_arm ? 1 : 5});
  }
  return mesh;
}

/// A plate with a slot from the right, as wide as `width` spacings of .1: the upper arm is bent by a traction at its
/// end, the lower one is free and only turns with the root. The value is u2 at the end of the lower arm over that of
/// the upper, the error its difference from that of elements of degree 3. No width is a slit, whose faces are two sides
/// in one place; its reference is that of .01 spacings.
Measurement tuning_fork(const std::string &method, double width) {
  const Material material{1, .3, false};
  const Field nothing{[](Point2) -> Vector2 { return {0, 0}; }, [](Point2) -> std::array<double, 4> { return {}; }};
  const auto fork = [&](double y) {
    auto setup =
        y > 0 ? polygon({{0, -.5}, {2, -.5}, {2, -y}, {.6, -y}, {.6, y}, {2, y}, {2, .5}, {0, .5}}, .1, material,
                        nothing, {7})
              : polygon({{0, -.5}, {2, -.5}, {2, 0}, {.6, 0}, {2, 0}, {2, .5}, {0, .5}}, .1, material, nothing, {6});
    setup.statement.conditions[y > 0 ? 5 : 4].traction = [](std::span<const Point2>, std::span<const Vector2>,
                                                            std::span<Vector2> t) {
      std::fill(t.begin(), t.end(), Vector2{0, 1});
    };
    setup.statement.characteristic_length = 2;
    setup.mesh = slotted_mesh(y);
    return setup;
  };
  const auto ratio = [](const methods::Solution &solution) {
    const std::vector<Point2> ends{{2, -.5}, {2, .5}};
    std::vector<double> u(4);
    solution.evaluate("displacement", ends, u);
    return u[1] / u[3];
  };
  const auto setup = fork(.05 * width);
  const auto solution = solve(method, setup.statement, setup.cloud, setup.mesh);
  const double value = ratio(*solution);
  const auto open = fork(.05 * std::max(width, .01));
  const double reference =
      ratio(*solve("fem Q2", open.statement, open.cloud, open.mesh, {{"element", std::string("Q3")}}));
  Measurement result{std::abs(value - reference), value, solution->record().warnings};
  check(*solution, setup, result);
  return result;
}

} // namespace

std::vector<HardCase> geometry_cases() {
  std::vector<HardCase> cases;
  for (const double contrast : {1e1, 1e3, 1e6, 1e-6})
    cases.push_back({"material contrast", fmt::format("bar of two, 1:{:g}", contrast),
                     "two materials in series under tension, nu = 0; error of u", "u is linear in both", 1e-6,
                     "a patch test: rounding times the condition, which grows with the contrast", all_solvers(), true,
                     [=](const std::string &m) {
                       Field field;
                       const auto setup = bar_of_two(contrast, field);
                       return measure(m, setup, field);
                     }});
  for (const double spacing : {.1, .05})
    cases.push_back({"slots and corners", fmt::format("L-shape, spacing {}", spacing),
                     "a re-entrant corner of 270 degrees, its singular field as data; error of u",
                     "exponent .544483737 (Szabo & Babuska)", .05,
                     "5 %: the error of u falls like h^1.09, from about .1^1.09 = .08 with a small constant",
                     particle_solvers(), spacing == .1,
                     [=](const std::string &m) { return l_shape_error(m, spacing); }});
  cases.push_back({"slots and corners", "L-shape, rate",
                   "the same for spacings of .1 and .05: rate at which the error of u falls; error is what it is below "
                   "the exponent",
                   "the error falls at least like h^.544 (the energy norm does like h^.544483737, u faster)", .05,
                   ".05 of the rate: two levels and clouds that are not similar", particle_solvers(), false,
                   [](const std::string &m) {
                     auto coarse = l_shape_error(m, .1), fine = l_shape_error(m, .05);
                     const double rate = std::log2(coarse.error / fine.error);
                     fine.value = rate;
                     const double shortfall = problems::reentrant_corner_exponent() - rate;
                     fine.error = shortfall <= 0 ? 0 : shortfall; // a NaN is kept
                     return fine;
                   }});
  auto with_elements = particle_solvers();
  with_elements.insert(with_elements.end(), {"fem Q1", "fem Q2"});
  cases.push_back({"slots and corners", "L-shape, rate of the stress",
                   "the same for spacings of .1, .05 and .025: mean rate at which the L2 error of the stress falls, a "
                   "measure of the energy norm; error is what it is below the exponent",
                   "h^.544483737 for methods that do not know of the singularity", .05,
                   ".05 of the rate: clouds that are not similar", std::move(with_elements), false,
                   [](const std::string &m) { return l_shape_energy_rate(m); }});
  for (const double width : {2., .5, .01, 0.})
    cases.push_back(
        {"slots and corners", width > 0 ? fmt::format("slot of {:g} spacings", width) : "slit: a slot of no width",
         "two arms beside a slot, the upper one loaded: movement of the lower one's end over the upper's; error of "
         "that",
         "elements Q3 on cells of a spacing", .05,
         "5 % of the upper's movement: if the faces were coupled across the slot both arms would move alike",
         all_solvers(), true, [=](const std::string &m) { return tuning_fork(m, width); }});
  return cases;
}

} // namespace comparisons::hard_cases
