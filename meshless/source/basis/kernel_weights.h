#pragma once

#include "meshless/basis/shape_functions.h"

namespace meshless::basis {

/// How a basis weighs particles.
struct Weighing {
  kernels::Kernel kernel;
  bool volumes = false;
  EdgeRule edge = EdgeRule::excluded;
};

/// Which derivatives of the weights are needed.
enum class WeightDerivatives { none, first, second };

/// Weights of all candidates inside the support of any lane of the points x, listed in `workspace.active`;
/// outside they are zero. With volumes the weight is V_J G / h_J^dim W, without it is the plain W.
///
/// `workspace.slopes` holds W'/s, `workspace.curvatures` (W'' - W'/s) / s^2, times the same factor: with
/// d = (xi_J - x) / h_J the first derivatives by x are -slope d_k / h_J, the second
/// (slope delta_kl + curvature d_k d_l) / h_J^2.
/// @throws std::invalid_argument if volumes are needed and absent, or supports are ellipses and volumes or derivatives
///   are needed
template <int dim>
void compute_weights(const Weighing &weighing, const std::array<linear_algebra::Pack, dim> &x,
                     const CandidateBatch<dim> &candidates, WeightDerivatives derivatives,
                     typename ShapeFunctions<dim>::Workspace &workspace);

/// The same for points with neighbours of their own, slot by slot: 0 where a lane has no neighbour in the slot.
/// Offsets there are 0.
template <int dim>
void compute_weights(const Weighing &weighing, const NeighbourPack<dim> &pack, WeightDerivatives derivatives,
                     typename ShapeFunctions<dim>::Workspace &workspace);

/// Candidates inside the support at the point.
template <int dim>
std::size_t count_neighbours(const Weighing &weighing, const cloud::Point<dim> &x,
                             const CandidateBatch<dim> &candidates);

} // namespace meshless::basis
