#pragma once

#include "../parallel/ordered_chunks.h"

#include "meshless/elasticity/linear_system.h"
#include "meshless/elasticity/particle_solution.h"
#include "meshless/elasticity/row_sample.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"
#include "meshless/linear_algebra/system_solver.h"
#include "meshless/parallel/threads.h"

#include <tbb/concurrent_queue.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <shared_mutex>
#include <utility>
#include <vector>

namespace meshless::elasticity {

/// A system of the rows of all particles, solved.
struct SolvedRows {
  linear_algebra::SystemSolution system;
  std::int64_t nonzeros = 0;
};

/// Assembles the rows of one particle and divides them, and their right-hand sides, by their largest entries, while
/// they are in the cache: large systems would pass through memory once more.
/// @param n_before rows of the whole matrix before this part of it
template <typename Assembler>
void assemble_equilibrated(Assembler &assembler, std::size_t particle, std::size_t n_before,
                           linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
  const std::size_t first = right_hand_side.size();
  assembler.assemble(particle, matrix, right_hand_side);
  linear_algebra::Stopwatch watch;
  for (std::size_t row = first; row < right_hand_side.size(); ++row)
    right_hand_side[row] /= matrix.equilibrate_row(row, n_before + row);
  assembler.seconds.assembly += watch.lap();
}

/// Room for the rows of all particles if they have as many entries as those so far, and a tenth: growing step by step
/// moves large matrices and leaves room that is not used.
/// @param n_rows_done rows that `n_entries` are in
inline void make_room(linear_algebra::SparseRows &matrix, std::size_t n_entries, std::size_t n_rows_done) {
  matrix.reserve(static_cast<std::size_t>(1.1 * static_cast<double>(n_entries) *
                                          static_cast<double>(matrix.n_columns()) / static_cast<double>(n_rows_done)));
}

/// Assembles all rows, each divided by its largest entry, by as many threads as are set; the rows are the same for any
/// number of them. `assembler.seconds` grow by the time that passes, shared between the phases as the threads spent
/// theirs.
/// @param another () -> Assembler, one for each thread more
template <typename Assembler, typename Another>
void assemble_rows(Assembler &assembler, const Another &another, std::size_t n_particles,
                   linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
  constexpr std::size_t chunk = 32; // a millisecond or so
  if (parallel::threads() == 1) {
    std::size_t most = 0; // entries of a particle's rows so far
    for (std::size_t i = 0; i < n_particles; ++i) {
      const auto n_before = static_cast<std::size_t>(matrix.nonzeros());
      if (i >= chunk && !matrix.has_room(most)) {
        linear_algebra::Stopwatch watch;
        make_room(matrix, n_before, right_hand_side.size());
        assembler.seconds.assembly += watch.lap();
      }
      assemble_equilibrated(assembler, i, 0, matrix, right_hand_side);
      most = std::max(most, static_cast<std::size_t>(matrix.nonzeros()) - n_before);
    }
    return;
  }
  struct Rows {
    linear_algebra::SparseRows matrix;
    std::vector<double> right_hand_side;
    std::size_t place = 0; // of the entries, in the whole matrix
  };
  const auto per_particle = static_cast<std::size_t>(matrix.n_columns()) / n_particles;
  linear_algebra::Stopwatch watch;
  tbb::enumerable_thread_specific<Assembler> assemblers(another);
  std::shared_mutex moving;          // the matrix to where it has more room
  tbb::concurrent_queue<Rows> spare; // storage of chunks that have been taken: its growth would cost page faults
  parallel::in_ordered_chunks<Rows>(
      n_particles, chunk, parallel::threads(),
      [&](std::size_t begin, std::size_t end) {
        auto &own = assemblers.local();
        Rows rows{linear_algebra::SparseRows(matrix.n_columns()), {}};
        if (spare.try_pop(rows)) {
          rows.matrix.clear();
          rows.right_hand_side.clear();
        }
        for (std::size_t i = begin; i < end; ++i)
          assemble_equilibrated(own, i, begin * per_particle, rows.matrix, rows.right_hand_side);
        return rows;
      },
      [&](Rows &rows) {
        if (!matrix.has_room(static_cast<std::size_t>(rows.matrix.nonzeros()))) {
          const std::unique_lock lock(moving);
          make_room(matrix, static_cast<std::size_t>(matrix.nonzeros() + rows.matrix.nonzeros()),
                    right_hand_side.size() + rows.right_hand_side.size()); // moving stops the others
        }
        rows.place = matrix.append_place(rows.matrix);
        right_hand_side.insert(right_hand_side.end(), rows.right_hand_side.begin(), rows.right_hand_side.end());
      },
      [&](Rows &rows) {
        {
          const std::shared_lock lock(moving);
          matrix.fill(rows.place, rows.matrix);
        }
        spare.push(std::move(rows));
      });
  const double wall = watch.lap();
  SolveSeconds spent;
  for (const auto &own : assemblers) {
    spent.neighbours += own.seconds.neighbours;
    spent.basis += own.seconds.basis;
    spent.assembly += own.seconds.assembly;
  }
  const double all = spent.neighbours + spent.basis + spent.assembly;
  const double share = all > 0 ? wall / all : 0;
  assembler.seconds.neighbours += share * spent.neighbours;
  assembler.seconds.basis += share * spent.basis;
  assembler.seconds.assembly += share * spent.assembly;
}

/// Assembles all rows and divides each by its largest entry.
/// @tparam Assembler has `seconds` and assemble(particle, SparseRows &, std::vector<double> &)
/// @param another () -> Assembler, for other threads
/// @param per_particle rows of a particle
template <typename Assembler, typename Another>
LinearSystem assemble_system(Assembler &assembler, const Another &another, std::size_t n_particles,
                             std::size_t per_particle) {
  LinearSystem system{linear_algebra::SparseRows(static_cast<std::int64_t>(per_particle * n_particles)), {}};
  system.right_hand_side.reserve(per_particle * n_particles);
  assemble_rows(assembler, another, n_particles, system.matrix, system.right_hand_side);
  return system;
}

/// The same, solved.
/// @throws linear_algebra::SolveError, or what the assembler throws
template <typename Assembler, typename Another>
SolvedRows assemble_and_solve(Assembler &assembler, const Another &another, std::size_t n_particles,
                              std::size_t per_particle, const linear_algebra::SolverRequest &solver) {
  const auto rows = assemble_system(assembler, another, n_particles, per_particle);
  linear_algebra::Stopwatch watch;
  auto system = linear_algebra::solve_system(rows.matrix, rows.right_hand_side, solver, per_particle);
  assembler.seconds.solve = watch.lap();
  return {std::move(system), rows.matrix.nonzeros()};
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
