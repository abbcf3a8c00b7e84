#pragma once

#include "meshless/basis/shape_functions.h"
#include "meshless/cloud/candidate_search.h"

#include <numeric>
#include <vector>

/// Shape functions of a few points with one call, for tests.
namespace evaluate_basis {

using namespace meshless;

inline constexpr basis::Wanted everything(int order) {
  return {.value = true, .gradient = true, .hessian = order >= 2, .differentiated_gradient = true};
}

template <int dim>
struct Result {
  std::vector<cloud::Index> candidates;
  basis::ShapeFunctionValues<dim> values;
  basis::Regularity regularity;
  double scale = 0; ///< of the monomials, m
};

/// All points as one batch; the candidates are given or all particles.
template <int dim>
Result<dim> at(const basis::ShapeFunctions<dim> &shape, const cloud::Particles<dim> &particles,
               const std::vector<cloud::Point<dim>> &points, const basis::Wanted &wanted,
               std::vector<cloud::Index> candidates = {}) {
  Result<dim> result;
  result.candidates = std::move(candidates);
  if (result.candidates.empty()) {
    result.candidates.resize(particles.size());
    std::iota(result.candidates.begin(), result.candidates.end(), 0);
  }
  basis::PointBatch<dim> batch;
  batch.assign(std::span<const cloud::Point<dim>>(points));
  basis::CandidateBatch<dim> candidate_batch;
  candidate_batch.assign(particles, result.candidates, points.empty() ? cloud::Point<dim>{} : points.front());
  typename basis::ShapeFunctions<dim>::Workspace workspace;
  result.regularity = shape.evaluate(batch, candidate_batch, wanted, result.values, workspace);
  basis::require_regular<dim>(result.regularity, batch, shape);
  result.scale = candidate_batch.scale();
  return result;
}

} // namespace evaluate_basis
