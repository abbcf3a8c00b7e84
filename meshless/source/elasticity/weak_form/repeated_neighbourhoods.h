#pragma once

#include "meshless/cloud/candidate_search.h"
#include "meshless/domain/boundary.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace meshless::elasticity::weak_form {

/// Finds particles inside whose local subdomain and all particles that reach into it lie as those of another one,
/// moved: on a grid most. Their rows are the same numbers in other columns.
///
/// Neighbourhoods are the same if their particles, in the order of their numbers, have the same places relative to the
/// particle and the same smoothing lengths, to what rounding makes of coordinates of the size of the cloud; so rows
/// agree to rounding.
class RepeatedNeighbourhoods {
public:
  /// @param boundary of the one, convex region
  /// @param search kept by reference
  /// @param radii of the subdomains of all particles, m
  RepeatedNeighbourhoods(const domain::Boundary &boundary, const cloud::CandidateSearch<2> &search,
                         std::span<const double> radii);

  /// True if half of the particles are in line with those before and after, at equal distances: what is cheap to see,
  /// and never so where there are no repetitions.
  static bool likely(const cloud::Particles<2> &particles);

  /// The first particle with the same neighbourhood; `particle` itself if it is the first, or alone.
  std::size_t first_like(std::size_t particle) const { return first_[particle]; }
  /// True if others are like this one, the first of them.
  bool shared(std::size_t particle) const { return shared_[particle]; }
  /// Number of particles that are like one before.
  std::size_t n_repeated() const { return n_repeated_; }

  /// Candidates as the neighbourhoods have them: without those that touch the subdomain to rounding, which do not reach
  /// any of its points; on a grid rounding would choose among them.
  void collect(const cloud::Point<2> &centre, double radius, std::vector<cloud::Index> &candidates) const;

private:
  /// The first of its kind.
  struct Pattern {
    std::size_t particle;
    std::vector<cloud::Index> candidates;
  };
  bool same(const Pattern &pattern, std::size_t particle, std::span<const cloud::Index> candidates,
            std::span<const double> radii) const;
  std::uint64_t key_of(std::size_t particle, std::span<const cloud::Index> candidates) const;

  const cloud::CandidateSearch<2> *search_;
  double tolerance_;
  std::vector<std::size_t> first_;
  std::vector<bool> shared_;
  std::size_t n_repeated_ = 0;
};

} // namespace meshless::elasticity::weak_form
