#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

namespace comparisons::hard_cases {

namespace {

const Material steel{1, .3, true};

/// A rectangle whose spacing grows from left to right and from below: x -> x^2 towards one corner, ratio 1 : 17.
PlaneSetup graded_square(int n, const Field &field) {
  auto setup = rectangle({0, 0}, {1, 1}, {n, n}, 0, 0, steel, field);
  const auto grade = [](double x) { return x == 0 || x == 1 ? x : x * (.2 + .8 * x); };
  for (auto *points : {&setup.cloud.positions, &setup.mesh.vertices})
    for (auto &p : *points)
      p = {grade(p[0]), grade(p[1])};
  for (std::size_t i = 0; i < setup.cloud.positions.size(); ++i) {
    const auto &p = setup.cloud.positions[i];
    setup.cloud.spacing[i] = 1.2 * (.2 + .8 * std::max(p[0], p[1]) * 1.6) / (n - 1);
  }
  setup.cloud.regular = false;
  return setup;
}

} // namespace

std::vector<HardCase> patch_cases() {
  const std::string exact = "the field itself";
  const std::string rounding =
      "rounding (1e-16) times the condition of the system (1e5) and of the penalty (1e5 E0 / L)";
  const auto linear = polynomial_field(0);
  const auto quadratic = polynomial_field(1);
  const Field rigid{[](Point2 p) -> Vector2 {
                      return {1 - .5 * p[1], 2 + .5 * p[0]};
                    },
                    [](Point2) -> std::array<double, 4> {
                      return {0, -.5, .5, 0};
                    }};
  const std::vector<std::string> second_order{"strong", "weak1",  "weak1 consistent", "hybrid",
                                              "mixed",  "fem Q2", "fem Q2Q1"};
  const Material rubber{1, .499999, true};
  const Field solenoidal{[](Point2 p) -> Vector2 {
                           const auto [x, y] = p;
                           return {.3 * x * x - .4 * x * y + .2 * y * y, .5 * x * x - .6 * x * y + .2 * y * y};
                         },
                         [](Point2 p) -> std::array<double, 4> {
                           const auto [x, y] = p;
                           return {.6 * x - .4 * y, -.4 * x + .4 * y, x - .6 * y, -.6 * x + .4 * y};
                         },
                         [](Point2) -> std::array<double, 6> { return {.6, -.4, .4, 1, -.6, .4}; }};
  return {
      {"patch",
       "quadratic, nu=0.499999, jitter 40 %, 20 seeds",
       "quadratic displacement without divergence in plane strain; the worst error of u",
       exact,
       1e-9,
       "rounding (1e-16) times the condition of the system (1e5 to 1e6)",
       {"mixed", "fem Q2Q1"},
       true,
       [=](const std::string &m) {
         Measurement worst{-1};
         for (std::uint64_t seed = 0; seed < 20; ++seed) {
           auto next = measure(m, rectangle({0, 0}, {1, 1}, {9, 9}, .4, seed, rubber, solenoidal), solenoidal);
           if (!(next.error <= worst.error))
             worst = std::move(next);
         }
         return worst;
       }},
      {"patch", "linear, grid", "linear displacement on 9 x 9 points; error of u", exact, 1e-8, rounding, all_solvers(),
       true,
       [=](const std::string &m) {
         return measure(m, rectangle({0, 0}, {1, 1}, {9, 9}, 0, 0, steel, linear), linear);
       }},
      {"patch", "linear, jitter 25 %", "the same, jittered", exact, 1e-8, rounding, all_solvers(), true,
       [=](const std::string &m) {
         return measure(m, rectangle({0, 0}, {1, 1}, {9, 9}, .25, 1, steel, linear), linear);
       }},
      {"patch", "linear, graded", "the same on a grid whose spacing grows five times", exact, 1e-8, rounding,
       all_solvers(), true, [=](const std::string &m) { return measure(m, graded_square(9, linear), linear); }},
      {"patch", "quadratic, jitter 25 %", "quadratic displacement with its body force, jittered", exact, 1e-8, rounding,
       second_order, true,
       [=](const std::string &m) {
         return measure(m, rectangle({0, 0}, {1, 1}, {9, 9}, .25, 1, steel, quadratic), quadratic);
       }},
      {"patch", "rigid motion", "translation and rotation, free but for the left edge, jittered", exact, 1e-8,
       "zero strain: " + rounding, all_solvers(), true,
       [=](const std::string &m) {
         return measure(m, rectangle({0, 0}, {1, 1}, {9, 9}, .25, 2, steel, rigid), rigid);
       }},
  };
}

} // namespace comparisons::hard_cases
