#pragma once

#include "discretisation.h"
#include "fem_reference/elasticity/material.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace fem_reference::elasticity {
/// Stress (s11, s22, s12) at the nodes of every cell, averaged over the cells of a region that share the node.
///
/// In each cell the stress is fitted by a polynomial of one degree less than the displacement, weighted by the
/// quadrature: in Qp it interpolates the p x p Gauss points, where the stress is superconvergent (Barlow 1976), in
/// triangles it is the least-squares fit. Its values at the nodes are averaged with equal weights
/// (Hinton and Campbell 1974).
class RecoveredStress {
public:
  RecoveredStress(const Discretisation &discretisation, std::span<const Material> materials,
                  std::span<const double> displacement, std::span<const double> cell_pressure = {});

  /// At node a of a cell, in the order of its element.
  const std::array<double, 3> &at(std::size_t cell, std::size_t a) const {
    return values_[value_of_[discretisation_.cell_start[cell] + a]];
  }

private:
  void number_values();

  const Discretisation &discretisation_;
  std::vector<unsigned> value_of_; ///< of each entry of cell_nodes: nodes on an interface have several values
  std::vector<std::array<double, 3>> values_;
};

/// Stress in a cell from the derivatives of the shape functions along xi; with the pressure of a mixed method, 2 mu eps
/// + p I.
std::array<double, 3> cell_stress(const Discretisation &discretisation, const Material &material,
                                  std::span<const double> displacement, std::size_t cell,
                                  const ReferenceElement::Values &slope_1, const ReferenceElement::Values &slope_2,
                                  std::optional<double> pressure = {});

/// Pressure at a point with these shape functions of the displacement, from the values at the nodes of all cells;
/// nothing if there are none.
std::optional<double> pressure_in_cell(const Discretisation &discretisation, std::span<const double> cell_pressure,
                                       std::size_t cell, const ReferenceElement::Values &shape);
} // namespace fem_reference::elasticity
