#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/plane_case.h"

#include <fmt/format.h>

namespace comparisons::hard_cases {

std::vector<HardCase> penalty_cases() {
  std::vector<HardCase> cases;
  const Material material{1, .3, false};
  const auto field = cantilever_field(1, .2, material);
  for (const double penalty : {1e0, 1e1, 1e3, 1e6, 1e9, 1e12})
    cases.push_back(
        {"penalty",
         fmt::format("penalty {:.0e}", penalty),
         "the cantilever on 31 x 7 points with this penalty on prescribed displacement, in E0 / L; error of u",
         "the polynomial, Batra & Zhang 2008 (4.2)",
         .05,
         "5 %: between 1e3 and 1e9 the penalty is not to be felt",
         {"weak1", "weak1 consistent", "weak2", "hybrid"},
         true,
         [=](const std::string &m) {
           return measure(m, rectangle({0, 0}, {1, .2}, {31, 7}, 0, 0, material, field), field, {{"penalty", penalty}});
         }});
  return cases;
}

} // namespace comparisons::hard_cases
