#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include <fmt/format.h>

#include <cmath>

namespace comparisons::hard_cases {

namespace {

/// The cantilever on 16 x 4 points in units of `metre` and `pascal`, its corner at `origin`.
double error_of(const std::string &method, double metre, double pascal, double origin,
                std::vector<std::string> *warnings) {
  const Material material{pascal, .3, false};
  const auto unit = cantilever_field(1, .2, {1, .3, false});
  const Field field{[=](Point2 p) -> Vector2 {
                      const auto u = unit.displacement({(p[0] - origin) / metre, (p[1] - origin) / metre});
                      return {u[0] * metre, u[1] * metre};
                    },
                    [=](Point2 p) {
                      return unit.gradient({(p[0] - origin) / metre, (p[1] - origin) / metre});
                    }};
  auto setup = rectangle({origin, origin}, {origin + metre, origin + .2 * metre}, {16, 4}, 0, 0, material, field);
  const auto result = measure(method, setup, field);
  if (warnings != nullptr)
    *warnings = result.warnings;
  return result.error;
}

} // namespace

std::vector<HardCase> unit_cases() {
  std::vector<HardCase> cases;
  const auto add = [&](std::string name, double metre, double pascal, double origin, double threshold,
                       std::string reason) {
    cases.push_back(
        {"shift and scale", std::move(name),
         "the cantilever on 16 x 4 points; difference of its relative error from that in metres and pascals "
         "at the origin",
         "no difference", threshold, std::move(reason), all_solvers(), true, [=](const std::string &m) {
           Measurement result;
           const double here = error_of(m, 1, 1, 0, nullptr);
           result.value = error_of(m, metre, pascal, origin, &result.warnings);
           result.error = std::abs(*result.value - here);
           return result;
         }});
  };
  const std::string rounding = "rounding times the condition of the system, 1e6";
  for (const double metre : {1e-9, 1e-3, 1e3, 1e9})
    add(fmt::format("lengths x {:g}", metre), metre, 1, 0, 1e-8, rounding);
  for (const double pascal : {1e-9, 1e9, 1e12})
    add(fmt::format("stresses x {:g}", pascal), 1, pascal, 0, 1e-8, rounding);
  add("shifted by 1e6", 1, 1, 1e6, 1e-5,
      "coordinates round by 1e-10, 2e-9 of the spacing; second derivatives amplify that by 1e2, the system more");
  return cases;
}

} // namespace comparisons::hard_cases
