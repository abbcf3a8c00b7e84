#pragma once

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/domain/visibility.h"
#include "meshless/elasticity/plane_problem.h"

#include <memory>
#include <span>
#include <vector>

namespace meshless::elasticity {

/// The regions of a problem, and what can be seen in them; shared by the methods and their solutions. Neither moved nor
/// copied: visibility refers to the boundaries.
class Surroundings {
public:
  explicit Surroundings(std::vector<Region> regions);
  Surroundings(const Surroundings &) = delete;
  Surroundings &operator=(const Surroundings &) = delete;

  std::size_t n_regions() const { return regions_.size(); }
  const domain::Boundary &boundary(std::size_t region) const { return regions_[region].boundary; }
  const Material &material(std::size_t region) const { return regions_[region].material; }
  const domain::Visibility &visibility(std::size_t region) const { return visibility_[region]; }

  /// One convex region: every particle in reach takes part everywhere.
  bool simple() const { return regions_.size() == 1 && visibility_[0].convex(); }

  /// Index of the first region that contains the point or has it on its boundary; the one nearest to it if none does.
  std::size_t region_of(const Point2 &point) const;

private:
  std::vector<Region> regions_;
  std::vector<domain::Visibility> visibility_;
};

/// Lets the particles of one region take part that are visible from a point.
class RegionFilter final : public basis::CandidateFilter<2> {
public:
  /// Both are kept by reference.
  RegionFilter(const Surroundings &surroundings, const cloud::Particles<2> &particles, std::size_t region);

  bool active(const Point2 &centre, double radius, double reach) const override;
  void apply(const Point2 &point, std::vector<cloud::Index> &candidates) override;

private:
  const Surroundings *surroundings_;
  const cloud::Particles<2> *particles_;
  std::size_t region_;
  domain::View view_;
  mutable std::vector<std::size_t> near_;
};

} // namespace meshless::elasticity
