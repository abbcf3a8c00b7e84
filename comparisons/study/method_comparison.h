#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/scene.h"

#include <map>
#include <string>
#include <vector>

namespace comparisons::study {

/// Measures what Zhang & Batra 2008, Table 7, compares in words, for one cell: quantities whose names begin with
/// "fact_" (comparisons/reports/facts_section.h says what each is). Takes several solves; a scene asks for it by `facts
/// = true` in [study].
/// @param solution of `request` on the level
/// @param warnings receives the reason where a fact could not be measured
/// @throws what the method throws
std::map<std::string, double> measured_facts(const methods::Method &method, const methods::SolveRequest &request,
                                             const methods::Solution &solution, const problems::PlaneProblem &problem,
                                             const problems::Quadrature &quadrature,
                                             std::vector<std::string> &warnings);

} // namespace comparisons::study
