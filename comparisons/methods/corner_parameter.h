#pragma once

#include "comparisons/problems/plane_problem.h"

#include "meshless/elasticity/strong_form/corner_rules.h"

#include <string>
#include <vector>

namespace comparisons::methods {

/// Reads the key `corner` of the strong form: "NE: s11 s22, SW: u1 t2", one or more corners with two
/// conditions each; corners that are not named keep the default rule. Empty text: no rule.
/// @throws std::invalid_argument saying what was found and what is allowed
std::vector<meshless::elasticity::strong_form::CornerRule> read_corner_rules(
    const std::string &text, const std::vector<problems::Corner> &corners);

} // namespace comparisons::methods
