#pragma once

#include "comparisons/scene/vocabulary.h"

#include "meshless/linear_algebra/system_solver.h"

#include <map>
#include <string>
#include <vector>

namespace comparisons::methods {

/// Keys of the linear solver of particle methods: `solver`, `ordering`, `preconditioner`.
std::vector<scene::Declaration> solver_keys();
/// Of three unknowns a particle: sparse LU alone.
std::vector<scene::Declaration> mixed_solver_keys();

std::vector<std::string> ordering_names();
std::vector<std::string> preconditioner_names();

/// Sparse LU has no preconditioner.
void check_solver_keys(const scene::CheckContext &context, scene::Diagnostics &diagnostics);

/// What the keys ask for; a benchmark may not have them.
meshless::linear_algebra::SolverRequest solver_request(const scene::Parameters &parameters);

/// "method", "ordering" and, of an iteration, "preconditioner", by their names in scenes.
std::map<std::string, std::string> names_of(const meshless::linear_algebra::SolverChoice &choice);

} // namespace comparisons::methods
