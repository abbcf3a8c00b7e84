#pragma once

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

/// Evaluates shape functions at arbitrary points: points of one small cell form a batch that
/// shares its candidates, so that SIMD lanes are filled and searches are few.
template <int dim>
class GroupedEvaluation {
public:
  /// One batch: which points it holds, the candidates, and their shape functions.
  struct Group {
    std::span<const std::size_t> points;
    std::span<const cloud::Index> candidates;
    const ShapeFunctionValues<dim> &values;
    const Regularity &regularity;
  };
  using Visitor = std::function<void(const Group &)>;

  /// All are kept by reference.
  /// @param filter null: all candidates take part
  GroupedEvaluation(const ShapeFunctions<dim> &basis, const cloud::CandidateSearch<dim> &search,
                    CandidateFilter<dim> *filter = nullptr)
      : basis_(&basis), search_(&search), filter_(filter) {}

  /// Visits every point once, in batches of at most 64.
  /// @param noun what the points are, for the message: "particle" or "point"
  /// @throws SingularMomentMatrix where the basis does not exist, naming the point by its index
  void visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted, const Visitor &visitor,
             const char *noun = "point") const;

private:
  double reach_of(std::span<const cloud::Index> candidates, const cloud::Point<dim> &centre) const;
  void evaluate_filtered(
      std::span<const cloud::Point<dim>> points, std::span<std::size_t> group, std::span<const cloud::Index> candidates,
      const std::function<void(std::span<const std::size_t>, std::span<const cloud::Index>)> &evaluate) const;

  const ShapeFunctions<dim> *basis_;
  const cloud::CandidateSearch<dim> *search_;
  CandidateFilter<dim> *filter_;
};

} // namespace meshless::basis
