#pragma once

#include "meshless/basis/basis_options.h"
#include "meshless/cloud/particles.h"
#include "meshless/kernels/kernel_table.h"

#include <array>
#include <cstddef>
#include <vector>

namespace meshless::basis {

template <int dim>
class CandidateBatch;
template <int dim>
class NeighbourPack;

/// A particle whose support holds the evaluation point x, and its weight W_J V_J there with
/// W_J = G / h_J^dim W(|xi_J - x| / h_J). Lengths in units of the scale of the monomials.
template <int dim>
struct PointNeighbour {
  static constexpr int n_hessian = dim * (dim + 1) / 2;

  std::size_t candidate = 0;
  std::array<double, dim> offset{}; ///< xi_J - x
  double weight = 0;
  /// Derivatives of the weight with respect to the particle's place xi_J.
  std::array<double, dim> gradient{};
  /// In the order 11, 12, .., 22, ..; the same with respect to x.
  std::array<double, n_hessian> hessian{};
};

/// The neighbours of one point, for bases that work point by point.
template <int dim>
struct PointNeighbours {
  std::vector<PointNeighbour<dim>> all;
  /// The one next to the point, the first of equals; all.size() if there is none.
  std::size_t nearest = 0;

  /// @param scale unit of lengths, m
  /// @throws std::invalid_argument if the candidates have no volumes
  void collect(const kernels::Kernel &kernel, EdgeRule edge, const cloud::Point<dim> &x,
               const CandidateBatch<dim> &candidates, double scale);
};

/// @throws std::invalid_argument if the candidates have no volumes
template <int dim>
void require_volumes(const CandidateBatch<dim> &candidates);
template <int dim>
void require_volumes(const NeighbourPack<dim> &pack);

} // namespace meshless::basis
