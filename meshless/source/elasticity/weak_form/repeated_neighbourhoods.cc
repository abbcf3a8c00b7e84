#include "repeated_neighbourhoods.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshless::elasticity::weak_form {

namespace {

using cloud::Particles;
using cloud::Point;

/// Kinds beyond this number are not remembered: where there are so many, few particles are alike.
constexpr std::size_t most_patterns = 4096;
/// Relative to the reach: far above rounding, far below a distance at which a kernel is not zero to rounding.
constexpr double touching = 1e-12;

/// What rounding makes of the differences of coordinates.
double rounding_of(const Particles<2> &particles) {
  double largest = 0;
  for (const auto &x : particles.positions())
    largest = std::max({largest, std::abs(x[0]), std::abs(x[1])});
  return 4 * std::numeric_limits<double>::epsilon() * largest;
}

bool equal(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

/// The finaliser of MurmurHash3, of both.
std::uint64_t mixed(std::uint64_t key, std::uint64_t value) {
  key ^= value + 0x9e3779b97f4a7c15 + (key << 6U) + (key >> 2U);
  key ^= key >> 33U;
  key *= 0xff51afd7ed558ccd;
  key ^= key >> 33U;
  return key;
}

} // namespace

bool RepeatedNeighbourhoods::likely(const Particles<2> &particles) {
  const double tolerance = rounding_of(particles);
  std::size_t n_in_line = 0;
  for (std::size_t i = 1; i + 1 < particles.size(); ++i) {
    const auto &a = particles.position(i - 1);
    const auto &b = particles.position(i);
    const auto &c = particles.position(i + 1);
    n_in_line += equal(b[0] - a[0], c[0] - b[0], tolerance) && equal(b[1] - a[1], c[1] - b[1], tolerance);
  }
  return 2 * n_in_line >= particles.size();
}

RepeatedNeighbourhoods::RepeatedNeighbourhoods(const domain::Boundary &boundary,
                                               const cloud::CandidateSearch<2> &search, std::span<const double> radii)
    : search_(&search), tolerance_(rounding_of(search.particles())), first_(radii.size()), shared_(radii.size()) {
  const auto &particles = search.particles();
  std::unordered_map<std::uint64_t, Pattern> patterns;
  std::vector<std::size_t> pieces;
  std::vector<cloud::Index> candidates;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    first_[i] = i;
    boundary.pieces_within(particles.position(i), radii[i], pieces);
    if (!pieces.empty())
      continue;
    collect(particles.position(i), radii[i], candidates);
    const auto key = key_of(i, candidates);
    if (const auto found = patterns.find(key); found != patterns.end()) {
      if (same(found->second, i, candidates, radii)) {
        first_[i] = found->second.particle;
        shared_[first_[i]] = true;
        ++n_repeated_;
      }
    } else if (patterns.size() < most_patterns)
      patterns.emplace(key, Pattern{i, candidates});
  }
}

void RepeatedNeighbourhoods::collect(const Point<2> &centre, double radius,
                                     std::vector<cloud::Index> &candidates) const {
  search_->collect(centre, radius, candidates);
  const auto &particles = search_->particles();
  std::erase_if(candidates, [&](cloud::Index j) {
    const auto particle = static_cast<std::size_t>(j);
    const double reach = (search_->support() * particles.smoothing_length(particle) + radius) * (1 - touching);
    return cloud::distance_squared<2>(particles.position(particle), centre) >= reach * reach;
  });
}

/// Of places to a millionth of h: which of those with the same key are the same is seen exactly later.
std::uint64_t RepeatedNeighbourhoods::key_of(std::size_t particle, std::span<const cloud::Index> candidates) const {
  const auto &particles = search_->particles();
  const auto &centre = particles.position(particle);
  const double scale = 0x1p20 / particles.smoothing_length(particle);
  std::uint64_t key = candidates.size();
  for (const auto j : candidates) {
    const auto &x = particles.position(static_cast<std::size_t>(j));
    const auto dx = static_cast<std::int64_t>(std::nearbyint(scale * (x[0] - centre[0])));
    const auto dy = static_cast<std::int64_t>(std::nearbyint(scale * (x[1] - centre[1])));
    key = mixed(key, static_cast<std::uint64_t>(dx) ^ (static_cast<std::uint64_t>(dy) << 32U));
  }
  return key;
}

bool RepeatedNeighbourhoods::same(const Pattern &pattern, std::size_t particle,
                                  std::span<const cloud::Index> candidates, std::span<const double> radii) const {
  const auto &particles = search_->particles();
  if (pattern.candidates.size() != candidates.size() || !equal(radii[pattern.particle], radii[particle], tolerance_))
    return false;
  const auto &a = particles.position(pattern.particle);
  const auto &b = particles.position(particle);
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    const auto i = static_cast<std::size_t>(pattern.candidates[k]), j = static_cast<std::size_t>(candidates[k]);
    const auto &x = particles.position(i);
    const auto &y = particles.position(j);
    if (!equal(x[0] - a[0], y[0] - b[0], tolerance_) || !equal(x[1] - a[1], y[1] - b[1], tolerance_) ||
        !equal(particles.smoothing_length(i), particles.smoothing_length(j), tolerance_) ||
        (particles.has_volumes() && particles.volumes()[i] != particles.volumes()[j]))
      return false;
  }
  return true;
}

} // namespace meshless::elasticity::weak_form
