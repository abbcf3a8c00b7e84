#pragma once

#include "comparisons/benchmarks/rod/arrangement.h"
#include "comparisons/benchmarks/rod/measurement.h"
#include "comparisons/methods/method_table.h"
#include "comparisons/study/experiment.h"

#include "meshless/linear_algebra/sparse_rows.h"

#include <map>
#include <string>
#include <vector>

namespace comparisons::benchmarks::rod {

/// The particle method `collocation` with keys `basis`, `order`, `kernel`, `kernel_parameter`, `smoothing_length`,
/// `support` and `volumes`.
scene::MethodDescription collocation(std::vector<std::string> effects);

/// What the method `fem` has in a benchmark.
struct ElementKeys {
  int lowest_degree = 1;
  /// Has the key `mass`.
  bool mass = false;
};

/// The method `fem` with keys `element` and `mass`.
scene::MethodDescription finite_elements(const ElementKeys &keys, std::vector<std::string> effects);

/// Degree behind "Q2".
int degree_of(const scene::Parameters &method);

/// Rows that give the first and second derivative at every particle from the values at all particles.
struct ParticleOperators {
  meshless::linear_algebra::SparseRows first;
  meshless::linear_algebra::SparseRows second;
};

/// The operators of a method at the places. Seconds are added to the phases points, neighbours and basis, and moment
/// matrices that are not positive definite counted.
/// @throws methods::Refused naming the particle that has fewer neighbours than the basis needs, or saying that a moment
///   matrix is singular
ParticleOperators particle_operators(const scene::Parameters &method, const std::vector<double> &places,
                                     Measurement &measurement);

/// Rough figures for one cell of `n_arrangements`.
study::Estimate estimate(const scene::MethodRequest &request, int n, std::size_t n_arrangements);

} // namespace comparisons::benchmarks::rod
