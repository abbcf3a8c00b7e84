#pragma once

#include "block_rows.h"
#include "incomplete_lu.h"

#include "meshless/linear_algebra/sparse_lu.h"

#include <optional>
#include <span>
#include <vector>

namespace meshless::linear_algebra {

/// What an incomplete factorisation does not see are motions of many particles at once. They are found in the space Z
/// of displacements that are constant on aggregates of neighbours: with the Galerkin system E = Z^T A Z,
///   x = M^-1 (r - A Z y) + Z y,  E y = Z^T r,
/// where M are the incomplete factors (the adapted deflation A-DEF1 of Tang et al., J. Sci. Comput. 39, 2009). The
/// number of iterations then hardly grows with that of particles.
class CoarseCorrection {
public:
  /// Both are kept by reference.
  CoarseCorrection(const BlockRows &matrix, const IncompleteLu &factors);

  /// x = the preconditioned r; all of 2 n_rows() entries.
  void apply(std::span<const double> r, std::span<double> x);
  /// The coarse system is regular; if not, the factors stand alone.
  bool regular() const { return coarse_lu_.has_value(); }
  /// Without those of the incomplete factors.
  std::size_t bytes() const;

private:
  using Index = BlockRows::Index;

  void aggregate(const BlockRows &matrix);
  void set_products(const BlockRows &matrix);

  const IncompleteLu &factors_;
  std::vector<Index> aggregate_of_;
  std::size_t n_aggregates_ = 0;
  // A Z by blocks.
  std::vector<std::size_t> start_;
  std::vector<Index> columns_;
  std::vector<BlockRows::Block> blocks_;
  std::optional<SparseRows> coarse_;
  std::optional<SparseLu> coarse_lu_; ///< none: E is singular, and M stands alone
  std::vector<double> coarse_residual_;
  std::vector<double> coarse_solution_;
  std::vector<double> deflated_;
};

} // namespace meshless::linear_algebra
