#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/candidate_search.h"

#include <functional>
#include <span>
#include <vector>

namespace meshless::basis {

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

  /// Both are kept by reference.
  GroupedEvaluation(const ShapeFunctions<dim> &basis, const cloud::CandidateSearch<dim> &search)
      : basis_(&basis), search_(&search) {}

  /// Visits every point once, in batches of at most 64.
  /// @param noun what the points are, for the message: "particle" or "point"
  /// @throws SingularMomentMatrix where the basis does not exist, naming the point by its index
  void visit(std::span<const cloud::Point<dim>> points, const Wanted &wanted, const Visitor &visitor,
             const char *noun = "point") const;

private:
  const ShapeFunctions<dim> *basis_;
  const cloud::CandidateSearch<dim> *search_;
};

} // namespace meshless::basis
