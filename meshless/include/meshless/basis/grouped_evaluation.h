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
  /// @param reach no candidate is farther from the centre, m
  virtual bool active(const cloud::Point<dim> &centre, double radius, double reach) const = 0;
  /// Removes what has no part at the point; keeps the order.
  virtual void apply(const cloud::Point<dim> &point, std::vector<cloud::Index> &candidates) = 0;
};

/// Evaluates shape functions at arbitrary points. They are taken along a curve, so that searches are shared, and packed
/// into SIMD lanes, a list of neighbours each.
template <int dim>
class GroupedEvaluation {
public:
  /// A pack of points: which they are, and their shape functions in rows; row j holds those of every point's own
  /// neighbour j.
  class Group {
  public:
    Group(std::span<const std::size_t> points_, const NeighbourPack<dim> &pack, const ShapeFunctionValues<dim> &values_,
          const Regularity &regularity_)
        : points(points_), values(values_), regularity(regularity_), pack_(&pack) {}

    std::span<const std::size_t> points;
    const ShapeFunctionValues<dim> &values;
    const Regularity &regularity;

    /// Of point p; in the rows beyond them, of points that have more, its shape functions are 0.
    std::size_t n_neighbours(std::size_t p) const { return pack_->list(p).size(); }
    /// Neighbours of point p in increasing order.
    cloud::Index neighbour(std::size_t j, std::size_t p) const { return pack_->list(p)[j]; }

  private:
    const NeighbourPack<dim> *pack_;
  };
  using Visitor = std::function<void(const Group &)>;

  /// All are kept by reference.
  /// @param filter null: all candidates take part
  GroupedEvaluation(const ShapeFunctions<dim> &basis, const cloud::CandidateSearch<dim> &search,
                    CandidateFilter<dim> *filter = nullptr);

  /// Visits every point once.
  /// @param noun what the points are, for the message: "particle" or "point"
  /// @param numbers theirs, for the message; none: their indices
  /// @throws SingularMomentMatrix where the basis does not exist, naming the point by its number
  void visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted, const Visitor &visitor,
             const char *noun = "point", std::span<const std::size_t> numbers = {}) const;

private:
  const ShapeFunctions<dim> *basis_;
  const cloud::CandidateSearch<dim> *search_;
  CandidateFilter<dim> *filter_;
  double mean_h_; ///< m
};

} // namespace meshless::basis
