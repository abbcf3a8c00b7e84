#pragma once

#include "meshless/elasticity/row_sample.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace meshless::elasticity {

/// A system of the rows of all particles, solved.
struct SolvedRows {
  std::vector<double> solution;
  std::int64_t nonzeros = 0;
  double backward_error = 0;
  double reciprocal_condition = 0;
};

/// Assembles all rows, divides each by its largest entry, and solves.
/// @tparam Assembler has `seconds` and assemble(particle, SparseRows &, std::vector<double> &)
/// @param per_particle rows of a particle
/// @throws linear_algebra::SolveError, or what the assembler throws
template <typename Assembler>
SolvedRows assemble_and_solve(Assembler &assembler, std::size_t n_particles, std::size_t per_particle) {
  linear_algebra::SparseRows matrix(static_cast<std::int64_t>(per_particle * n_particles));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(per_particle * n_particles);
  for (std::size_t i = 0; i < n_particles; ++i)
    assembler.assemble(i, matrix, right_hand_side);
  linear_algebra::Stopwatch watch;
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  assembler.seconds.assembly += watch.lap();
  auto lu = linear_algebra::solve_lu(matrix, right_hand_side);
  assembler.seconds.solve = watch.lap();
  const double backward = linear_algebra::backward_error(matrix, lu.solution, right_hand_side);
  return {std::move(lu.solution), matrix.nonzeros(), backward, lu.reciprocal_condition};
}

/// Assembles the rows of `n_sampled` particles, evenly spread over their numbers, and multiplies up.
template <typename Assembler>
RowSample sample_rows(Assembler &assembler, std::size_t n_particles, std::size_t per_particle, std::size_t n_sampled) {
  n_sampled = std::min(n_sampled, n_particles);
  if (n_sampled == 0)
    return {};
  linear_algebra::SparseRows matrix(static_cast<std::int64_t>(per_particle * n_particles));
  std::vector<double> right_hand_side;
  linear_algebra::Stopwatch watch;
  for (std::size_t k = 0; k < n_sampled; ++k)
    assembler.assemble(k * n_particles / n_sampled, matrix, right_hand_side);
  const double factor = static_cast<double>(n_particles) / static_cast<double>(n_sampled);
  return {factor * static_cast<double>(matrix.nonzeros()), factor * watch.lap()};
}

} // namespace meshless::elasticity
