#pragma once

#include <cstddef>
#include <vector>

namespace meshless::hydrodynamics {

/// Particles a block: pairs (i, i + k) of the i of one block are one run of a loop.
inline constexpr std::size_t block_size = 64;

/// Places behind the last particle that may be read: the most neighbours to one side of a particle.
inline constexpr std::size_t padding = 512;

/// Which pairs of a line of particles can be within reach of each other: for every block of `block_size` particles the
/// largest difference k of the indices.
///
/// Pair (i, j), j > i, is within reach if x_j - x_i < r (h_i + h_j) / 2, that is L_j < R_i with L_j = x_j - r h_j / 2
/// and R_i = x_i + r h_i / 2. With M_j the least L of j and all later ones, all j with M_j < R_i are a range that
/// begins at i + 1; it holds every such pair.
class PairRanges {
public:
  explicit PairRanges(std::size_t n_allocated);

  /// @param first, last the particles, within arrays that hold `padding` far particles behind the last one
  /// @param reach r, the support's radius in units of h
  /// @returns false if a particle has more than `padding` neighbours to one side
  bool find(const double *position, const double *smoothing_length, std::size_t first, std::size_t last, double reach);

  std::size_t first() const { return first_; }
  std::size_t n_blocks() const { return widths_.size(); }
  /// First particle of a block, a place in the arrays.
  std::size_t begin(std::size_t block) const { return first_ + block * block_size; }
  /// Largest k of a block.
  std::size_t width(std::size_t block) const { return widths_[block]; }
  /// Where the pairs of a block begin in an array of pairs: that of k starts (k - 1) block_size further.
  std::size_t offset(std::size_t block) const { return offsets_[block]; }
  /// Length of an array of pairs.
  std::size_t n_pairs() const { return n_pairs_; }
  std::size_t bytes() const;

private:
  std::size_t first_ = 0;
  std::size_t n_pairs_ = 0;
  std::vector<double> least_left_; ///< M
  std::vector<std::size_t> widths_;
  std::vector<std::size_t> offsets_;
};

} // namespace meshless::hydrodynamics
