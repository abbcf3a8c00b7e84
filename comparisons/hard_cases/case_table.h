#pragma once

#include "comparisons/hard_cases/hard_case.h"
#include "comparisons/study/catalogue.h"

namespace comparisons::hard_cases {

// One file a family.
std::vector<HardCase> patch_cases();
std::vector<HardCase> incompressibility_cases();
std::vector<HardCase> slenderness_cases();
std::vector<HardCase> irregular_cases();
std::vector<HardCase> degenerate_cases();
std::vector<HardCase> unit_cases();
std::vector<HardCase> geometry_cases();
std::vector<HardCase> penalty_cases();
/// Bars and gases in time, by scenes of the benchmarks.
/// @param catalogue kept by reference
std::vector<HardCase> transient_cases(const study::Catalogue &catalogue);
std::vector<HardCase> blast_wave_cases();
/// Energy over many steps; the catalogue is kept by reference.
std::vector<HardCase> long_run_cases(const study::Catalogue &catalogue);

/// The one table of hard cases, family by family.
std::vector<HardCase> case_table(const study::Catalogue &catalogue);

} // namespace comparisons::hard_cases
