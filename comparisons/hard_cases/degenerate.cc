#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::hard_cases {

namespace {

const Material steel{1, .3, true};

PlaneSetup square(const Field &field) { return rectangle({0, 0}, {1, 1}, {11, 11}, 0, 0, steel, field); }

/// Keeps the particles for which `keep` holds; the cloud no longer counts as regular.
void keep_if(problems::Cloud &cloud, const std::function<bool(const Point2 &)> &keep) {
  problems::Cloud kept;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
    if (keep(cloud.positions[i])) {
      kept.positions.push_back(cloud.positions[i]);
      kept.spacing.push_back(cloud.spacing[i]);
    }
  cloud = std::move(kept);
}

} // namespace

std::vector<HardCase> degenerate_cases() {
  std::vector<HardCase> cases;
  const auto field = polynomial_field(0);
  const std::string answer = "the linear field itself, or a refusal that names the particle";
  const std::string rounding = "1e-6: rounding times a condition that grows with the inverse distance";
  const auto add = [&](std::string name, std::string meaning, std::vector<std::string> methods,
                       const std::function<void(PlaneSetup &)> &spoil, std::map<std::string, scene::Value> keys = {}) {
    cases.push_back({"degenerate clouds", std::move(name), std::move(meaning) + "; error of u", answer, 1e-6, rounding,
                     std::move(methods), true, [=](const std::string &m) {
                       auto setup = square(field);
                       spoil(setup);
                       return measure(m, setup, field, keys);
                     }});
  };
  for (const int digits : {3, 6, 9, 12})
    add(fmt::format("coincident 1e-{} h", digits), "two particles nearly at one place on an 11 x 11 grid",
        particle_solvers(), [=](PlaneSetup &setup) {
          setup.cloud.positions.push_back({.5 + .1 * std::pow(10., -digits), .5});
          setup.cloud.spacing.push_back(.1);
          setup.cloud.regular = false;
        });
  add("coincident exactly", "two particles at one place", particle_solvers(), [](PlaneSetup &setup) {
    setup.cloud.positions.push_back({.5, .5});
    setup.cloud.spacing.push_back(.1);
  });
  add("collinear", "two lines of particles only: second powers across them cannot be told apart", particle_solvers(),
      [](PlaneSetup &setup) {
        keep_if(setup.cloud, [](const Point2 &p) { return p[1] == 0 || p[1] == 1; });
        for (auto &p : setup.cloud.positions)
          p[1] = p[1] == 0 ? .45 : .55;
      });
  add("isolated particle", "one particle far from all others", particle_solvers(), [](PlaneSetup &setup) {
    keep_if(setup.cloud, [](const Point2 &p) { return p[0] < .45 || (p[0] > .95 && p[1] > .95); });
  });
  add("gap of 1.5 h", "particles within 1.5 spacings of the middle left out", particle_solvers(),
      [](PlaneSetup &setup) {
        keep_if(setup.cloud, [](const Point2 &p) { return std::hypot(p[0] - .5, p[1] - .5) > .15; });
      });
  add("gap of 4 h", "particles within 4 spacings of the middle left out", particle_solvers(), [](PlaneSetup &setup) {
    keep_if(setup.cloud, [](const Point2 &p) { return std::hypot(p[0] - .5, p[1] - .5) > .4; });
  });
  add("four lines for order 4", "four lines of particles across, where order 4 needs five, with lower_order = \"on\"",
      {"weak1"},
      [=](PlaneSetup &setup) {
        setup = rectangle({0, 0}, {1, .3}, {11, 4}, 0, 0, steel, field);
      },
      {{"order", std::int64_t{4}}, {"lower_order", std::string("on")}});
  for (const double support : {1.01, 1.5, 2., 2.5, 3., 4., 6.})
    add(fmt::format("support {:g} h", support), "a grid with this support of the kernel", particle_solvers(),
        [](PlaneSetup &) {}, {{"support", support}});
  return cases;
}

} // namespace comparisons::hard_cases
