#pragma once

#include "comparisons/methods/method_table.h"

#include "meshless/elasticity/equations_of_motion.h"

#include <string>

namespace comparisons::methods {

/// Collocation with the basis' second derivatives, Batra & Zhang 2008, section 3.1.
Method strong();
/// MLPG with directly found derivatives, section 3.2.1.
Method weak1();
/// MLPG with differentiated shape functions, section 3.2.2.
Method weak2();

/// The strong form inside with weak1's rows on the boundary, where collocation is inaccurate.
Method hybrid();

/// Displacement and pressure, both unknown: meshless::elasticity::mixed_form.
Method mixed();

/// The equations of motion of one of these methods, by its name, with the densities of the statement's materials.
/// @throws Refused if a moment matrix is singular, or what the method throws
meshless::elasticity::EquationsOfMotion equations_of_motion(const SolveRequest &request, const std::string &method);

} // namespace comparisons::methods
