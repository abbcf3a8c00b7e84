#pragma once

#include "comparisons/methods/method_table.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace comparisons::hard_cases {

/// A method with the parameters that a column of the matrix stands for.
struct Solver {
  std::string label;  ///< "weak1 consistent"
  std::string method; ///< "weak1"
  std::map<std::string, scene::Value> keys;
};

/// Columns of the plane cases.
const std::vector<Solver> &solvers();

// Groups of their labels.
std::vector<std::string> all_solvers();
std::vector<std::string> particle_solvers();
std::vector<std::string> weak_solvers();
std::vector<std::string> finite_elements();

/// Solves a plane problem by the solver of that label, with further keys of the method.
/// @throws what the method throws; std::logic_error for an unknown label
std::unique_ptr<methods::Solution> solve(const std::string &label, const problems::PlaneStatement &statement,
                                         const problems::Cloud &cloud, const problems::Mesh &mesh,
                                         const std::map<std::string, scene::Value> &keys = {});

} // namespace comparisons::hard_cases
