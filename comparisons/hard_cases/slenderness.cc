#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include <fmt/format.h>

namespace comparisons::hard_cases {

std::vector<HardCase> slenderness_cases() {
  std::vector<HardCase> cases;
  const Material material{1, .3, false};
  for (const int slenderness : {4, 10, 40, 100, 1000})
    cases.push_back({"slenderness", fmt::format("cantilever L/h={}", slenderness),
                     "Timoshenko's cantilever in plane stress on 41 x 5 points, whatever its length: cells are as "
                     "elongated as L/h / 10; error of u",
                     "the polynomial, Batra & Zhang 2008 (4.2)", .05,
                     "5 %: four cells over the height; Q1 with full integration locks, particles need neighbours along "
                     "the beam",
                     all_solvers(), true, [=](const std::string &m) {
                       const double length = slenderness;
                       const auto field = cantilever_field(length, 1, material);
                       return measure(m, rectangle({0, 0}, {length, 1}, {41, 5}, 0, 0, material, field), field);
                     }});
  for (const int slenderness : {10, 40})
    cases.push_back(
        {"slenderness", fmt::format("cantilever L/h={}, even", slenderness),
         "the same with square cells, four over the height", "the polynomial, Batra & Zhang 2008 (4.2)", .05,
         "5 %: four cells over the height", all_solvers(), slenderness == 10, [=](const std::string &m) {
           const double length = slenderness;
           const auto field = cantilever_field(length, 1, material);
           return measure(m, rectangle({0, 0}, {length, 1}, {4 * slenderness + 1, 5}, 0, 0, material, field), field);
         }});
  return cases;
}

} // namespace comparisons::hard_cases
