#include "meshless/elasticity/cloud_quality.h"

#include "meshless/cloud/candidate_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace meshless::elasticity {

namespace {

/// Sixteen on the unit circle.
const std::array<Point2, 16> directions = [] {
  std::array<Point2, 16> result;
  for (std::size_t k = 0; k < result.size(); ++k) {
    const double angle = std::numbers::pi / 8 * static_cast<double>(k);
    result[k] = {std::cos(angle), std::sin(angle)};
  }
  return result;
}();

/// Looks at the moment matrices of one particle after the other.
class Probe {
public:
  Probe(const Surroundings &surroundings, const cloud::Particles<2> &particles, const basis::ShapeFunctions<2> &basis,
        double reach)
      : surroundings_(surroundings), particles_(particles), basis_(basis), search_(particles, basis.support()),
        reach_(reach) {
    for (std::size_t r = 0; r < surroundings.n_regions(); ++r)
      filters_.emplace_back(surroundings, particles, r);
  }

  /// The particle and, inside the domain, sixteen points around it, with the particles that it sees.
  basis::Regularity look(std::size_t particle) {
    const auto region = static_cast<std::size_t>(particles_.region(particle));
    const Point2 &x = particles_.position(particle);
    const double radius = reach_ * particles_.smoothing_length(particle);
    points_.assign(1, x);
    if (radius > 0)
      add_rings(surroundings_.boundary(region), x, radius);
    search_.collect(x, radius, candidates_);
    if (!surroundings_.simple())
      filters_[region].apply(x, candidates_);
    batch_.assign(std::span<const Point2>(points_));
    candidate_batch_.assign(particles_, candidates_, points_.front());
    return basis_.evaluate(batch_, candidate_batch_, {}, values_, workspace_);
  }

  std::span<const Point2> points() const { return points_; }
  std::span<const cloud::Index> candidates() const { return candidates_; }

private:
  /// Two rings, interlaced; of their points those inside.
  void add_rings(const domain::Boundary &boundary, const Point2 &x, double radius) {
    boundary.pieces_within(x, radius, pieces_);
    const bool beside_boundary = !pieces_.empty();
    if (!beside_boundary && !boundary.contains(x))
      return;
    for (std::size_t k = 0; k < directions.size(); ++k) {
      const double r = k % 2 == 0 ? radius : 0.5 * radius;
      const Point2 point{x[0] + r * directions[k][0], x[1] + r * directions[k][1]};
      if (!beside_boundary || boundary.contains(point))
        points_.push_back(point);
    }
  }

  const Surroundings &surroundings_;
  const cloud::Particles<2> &particles_;
  const basis::ShapeFunctions<2> &basis_;
  cloud::CandidateSearch<2> search_;
  double reach_;
  std::vector<RegionFilter> filters_;
  std::vector<Point2> points_;
  std::vector<std::size_t> pieces_;
  std::vector<cloud::Index> candidates_;
  basis::PointBatch<2> batch_;
  basis::CandidateBatch<2> candidate_batch_;
  basis::ShapeFunctionValues<2> values_;
  basis::ShapeFunctions<2>::Workspace workspace_;
};

double distance(const Point2 &a, const Point2 &b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// Of particles at the outskirts of a point's neighbourhood: their distance in units of their own support.
constexpr double outskirts_begin = 0.6;
constexpr double outskirts_end = 1.2;
constexpr double step = 1.05;
constexpr double largest_enlargement = 2;

} // namespace

double poor_pivot_ratio(int order) { return std::pow(10.0, -2 - order); }

CloudQuality cloud_quality(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                           const basis::ShapeFunctions<2> &basis, double reach) {
  CloudQuality quality;
  quality.smallest_distance = std::numeric_limits<double>::infinity();
  Probe probe(surroundings, particles, basis, reach);
  std::vector<std::size_t> counts;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto regularity = probe.look(i);
    const Point2 &x = particles.position(i);
    std::size_t n_neighbours = 0;
    for (const cloud::Index c : probe.candidates()) {
      const auto j = static_cast<std::size_t>(c);
      const double d = distance(x, particles.position(j));
      n_neighbours += std::sqrt(particles.squared_distance_in_h(j, x)) < basis.support();
      if (j != i && d / particles.smoothing_length(i) < quality.smallest_distance) {
        quality.smallest_distance = d / particles.smoothing_length(i);
        quality.closest = i;
      }
    }
    counts.push_back(n_neighbours);
    quality.n_indefinite += regularity.n_indefinite;
    if (regularity.smallest_pivot_ratio < quality.smallest_pivot_ratio) {
      quality.smallest_pivot_ratio = regularity.smallest_pivot_ratio;
      quality.worst = i;
      quality.worst_point = probe.points()[regularity.worst_point];
    }
  }
  const auto fewest = std::min_element(counts.begin(), counts.end());
  quality.fewest_at = static_cast<std::size_t>(fewest - counts.begin());
  quality.fewest_neighbours = *fewest;
  quality.most_neighbours = *std::max_element(counts.begin(), counts.end());
  std::nth_element(counts.begin(), counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2), counts.end());
  quality.median_neighbours = counts[counts.size() / 2];
  return quality;
}

Enlargement enlarge_where_poor(const Surroundings &surroundings, const cloud::Particles<2> &particles,
                               const basis::ShapeFunctions<2> &basis, double reach) {
  Enlargement result{particles};
  std::vector<bool> given_up(particles.size());
  const double poor = poor_pivot_ratio(basis.order());
  for (bool changed = true; changed;) {
    changed = false;
    std::vector<double> h(result.particles.smoothing_lengths().begin(), result.particles.smoothing_lengths().end());
    Probe probe(surroundings, result.particles, basis, reach);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      if (given_up[i])
        continue;
      const auto regularity = probe.look(i);
      if (regularity.smallest_pivot_ratio > poor)
        continue;
      const Point2 x = probe.points()[regularity.worst_point];
      given_up[i] = true;
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const double s = std::sqrt(result.particles.squared_distance_in_h(j, x)) / basis.support();
        if (s < outskirts_begin || s > outskirts_end || particles.region(j) != particles.region(i))
          continue;
        const double larger = step * result.particles.smoothing_length(j);
        if (larger > largest_enlargement * particles.smoothing_length(j))
          continue;
        h[j] = larger;
        given_up[i] = false;
        changed = true;
      }
    }
    if (changed) {
      const auto positions = particles.positions();
      const auto volumes = particles.volumes();
      const auto regions = particles.regions();
      const auto flattenings = particles.flattenings();
      result.particles =
          cloud::Particles<2>({positions.begin(), positions.end()}, std::move(h), {volumes.begin(), volumes.end()},
                              {regions.begin(), regions.end()}, {flattenings.begin(), flattenings.end()});
    }
  }
  for (std::size_t j = 0; j < particles.size(); ++j) {
    const double factor = result.particles.smoothing_length(j) / particles.smoothing_length(j);
    result.n_enlarged += factor > 1;
    result.largest_factor = std::max(result.largest_factor, factor);
  }
  return result;
}

} // namespace meshless::elasticity
