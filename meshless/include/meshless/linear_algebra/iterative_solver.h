#pragma once

#include "meshless/linear_algebra/krylov.h"
#include "meshless/linear_algebra/ordering.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meshless::linear_algebra {

/// Incomplete factors of blocks of 2 x 2, alone or with a coarse system of aggregates.
enum class Preconditioner {
  ilu0,        ///< on the pattern of A
  thinned,     ///< on the pattern of A less what is small
  ilut,        ///< with fill, less what is small (Saad 1994)
  ilu0_coarse, ///< each with the coarse system
  thinned_coarse,
  ilut_coarse,
};

struct PreconditionerDescription {
  Preconditioner preconditioner;
  const char *name;
  const char *meaning;
};

/// Every preconditioner by its name.
std::span<const PreconditionerDescription> preconditioner_table();
const char *to_text(Preconditioner preconditioner);
/// @throws std::invalid_argument for an unknown name, listing those there are
Preconditioner preconditioner_of(std::string_view name);

struct PreconditionerSettings {
  Preconditioner preconditioner = Preconditioner::thinned_coarse;
  Ordering ordering = Ordering::rcm;
  /// Blocks below this part of the largest of their row are left out; none: 2e-3 (thinned), 1e-2 (ILUT).
  std::optional<double> drop = {};
  /// Of ILUT: blocks of a row of both factors over those of the row of A.
  double fill = 2;
};

/// A matrix with two unknowns a particle (2 I and 2 I + 1), in an order of its own, and its preconditioner.
///
/// The operators of smooth particle bases have wide rows of which little matters: hence thinned factors, without fill
/// and in single precision. A coarse system of aggregates takes what the factors do not see: the number of iterations
/// hardly depends on that of particles.
class PreconditionedSystem {
public:
  /// @throws std::invalid_argument if A is not square with an even number of rows; SolveError if a pivot block is
  ///   singular
  PreconditionedSystem(const SparseRows &matrix, const PreconditionerSettings &settings);
  ~PreconditionedSystem();
  PreconditionedSystem(const PreconditionedSystem &) = delete;
  PreconditionedSystem &operator=(const PreconditionedSystem &) = delete;

  KrylovResult solve(Krylov krylov, std::span<const double> right_hand_side, const KrylovTolerance &tolerance = {});

  /// Least over largest pivot of the incomplete factor U: as rough as what sparse LU tells.
  double reciprocal_condition() const;
  /// A coarse system was asked for and is singular: the factors stand alone.
  bool coarse_left_out() const;
  /// Of the factors and the coarse system.
  std::size_t bytes() const;

private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

struct IterativeSettings {
  Krylov krylov = Krylov::bicgstab;
  PreconditionerSettings preconditioner;
  KrylovTolerance tolerance;
};

struct IterativeResult {
  std::vector<double> solution;
  int iterations = 0;
  double algebraic_error = 0; ///< KrylovResult::algebraic_error
  double reciprocal_condition = 0;
  int n_restarts = 0;           ///< KrylovResult::n_restarts
  bool coarse_left_out = false; ///< PreconditionedSystem::coarse_left_out
};

/// Solves A x = b, with two unknowns a particle.
/// @return none if the backward error does not come near enough to the wanted one (KrylovTolerance) or a pivot is zero;
///   sparse LU is what is left then
/// @throws std::invalid_argument if A is not square with an even number of rows
std::optional<IterativeResult> solve_iteratively(const SparseRows &matrix, std::span<const double> right_hand_side,
                                                 const IterativeSettings &settings = {});

} // namespace meshless::linear_algebra
