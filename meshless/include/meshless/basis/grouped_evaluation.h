#pragma once

#include "meshless/basis/neighbour_pack.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/candidate_search.h"

#include <functional>
#include <span>
#include <vector>

namespace meshless::basis {

/// Leaves out candidates that have no part in the shape functions at a point although they are near: they belong to
/// another region, or are hidden behind a slot.
template <int dim>
class CandidateFilter {
public:
  virtual ~CandidateFilter() = default;

  /// False if no candidate is to be left out at any point of the ball.
  /// @param reach distance of the farthest candidate from the centre, m
  virtual bool active(const cloud::Point<dim> &centre, double radius, double reach) const = 0;
  /// Removes what has no part at the point; keeps the order.
  virtual void apply(const cloud::Point<dim> &point, std::vector<cloud::Index> &candidates) = 0;
};

/// Evaluates shape functions at arbitrary points, so that SIMD lanes are filled and searches are few.
///
/// Points so dense that several fall within the distance of two particles are evaluated by cells: those of a small cell
/// share their candidates. Points about as sparse as the particles, and such as a filter has work for, are packed along
/// a curve and have neighbours of their own.
template <int dim>
class GroupedEvaluation {
public:
  /// One batch: which points it holds and their shape functions, a row for every candidate. Whether all points have the
  /// same candidate in a row or each its own is up to the evaluation.
  class Group {
  public:
    Group(std::span<const std::size_t> points_, std::span<const cloud::Index> candidates,
          const ShapeFunctionValues<dim> &values_, const Regularity &regularity_)
        : points(points_), values(values_), regularity(regularity_), candidates_(candidates.data()), row_step_(1),
          n_candidates_(candidates.size()) {}
    Group(std::span<const std::size_t> points_, const NeighbourPack<dim> &pack, const ShapeFunctionValues<dim> &values_,
          const Regularity &regularity_)
        : points(points_), values(values_), regularity(regularity_), candidates_(pack.slots()),
          row_step_(linear_algebra::n_lanes), point_step_(1), n_candidates_(pack.n_slots()), pack_(&pack) {}

    std::span<const std::size_t> points;
    const ShapeFunctionValues<dim> &values;
    const Regularity &regularity;

    /// Rows of the values.
    std::size_t n_candidates() const { return n_candidates_; }
    /// Rows that point p has; in those beyond its values are 0, and the candidate is any particle.
    std::size_t n_candidates(std::size_t p) const { return pack_ ? pack_->list(p).size() : n_candidates_; }
    /// Particle of row j at point p; of one point every particle once at most, in increasing order.
    cloud::Index candidate(std::size_t j, std::size_t p) const { return candidates_[j * row_step_ + p * point_step_]; }

  private:
    const cloud::Index *candidates_;
    std::size_t row_step_;
    std::size_t point_step_ = 0;
    std::size_t n_candidates_;
    const NeighbourPack<dim> *pack_ = nullptr;
  };
  using Visitor = std::function<void(const Group &)>;

  /// All are kept by reference.
  /// @param filter null: all candidates take part
  GroupedEvaluation(const ShapeFunctions<dim> &basis, const cloud::CandidateSearch<dim> &search,
                    CandidateFilter<dim> *filter = nullptr)
      : basis_(&basis), search_(&search), filter_(filter) {}

  /// Visits every point once, in batches of at most 32.
  /// @param noun what the points are, for the message: "particle" or "point"
  /// @throws SingularMomentMatrix where the basis does not exist, naming the point by its index
  void visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted, const Visitor &visitor,
             const char *noun = "point") const;

private:
  class Visit;

  const ShapeFunctions<dim> *basis_;
  const cloud::CandidateSearch<dim> *search_;
  CandidateFilter<dim> *filter_;
};

} // namespace meshless::basis
