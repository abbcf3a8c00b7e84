#include "comparisons/hard_cases/case_table.h"

#include <iterator>

namespace comparisons::hard_cases {

std::vector<HardCase> case_table(const study::Catalogue &catalogue) {
  std::vector<HardCase> table;
  for (auto family : {patch_cases(), incompressibility_cases(), slenderness_cases(), irregular_cases(),
                      degenerate_cases(), unit_cases(), geometry_cases(), penalty_cases(), transient_cases(catalogue),
                      blast_wave_cases(), long_run_cases(catalogue)})
    table.insert(table.end(), std::make_move_iterator(family.begin()), std::make_move_iterator(family.end()));
  return table;
}

} // namespace comparisons::hard_cases
