#pragma once

#include "meshless/basis/shape_functions.h"

#include <span>

namespace meshless::basis {

/// Bases that are evaluated point by point, from the neighbours of the point.
template <int dim>
class PointwiseBasis : public ShapeFunctions<dim> {
public:
  using typename ShapeFunctions<dim>::Workspace;
  using Values = ShapeFunctionValues<dim>;

  PointwiseBasis(const kernels::Kernel &kernel, EdgeRule edge) : kernel_(kernel), edge_(edge) {}

  double support() const override { return search_radius(kernels::support_of(kernel_), edge_); }

  Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, const Wanted &wanted,
                      Values &values, Workspace &workspace) const override;

protected:
  /// One point, its neighbours and where the results go.
  struct Place {
    const PointNeighbours<dim> &neighbours;
    Workspace &workspace;
    Values &values;
    const Wanted &wanted;
    std::size_t point;
    double scale; ///< unit of the neighbours' lengths, m

    std::size_t size() const { return neighbours.all.size(); }
    const PointNeighbour<dim> &nearest() const { return neighbours.all[neighbours.nearest]; }
    /// Shape functions of all neighbours.
    void write(int quantity, std::span<const double> shape) const {
      for (std::size_t j = 0; j < size(); ++j)
        values.row(quantity, neighbours.all[j].candidate)[point] = shape[j];
    }
  };

  /// Fills the rows of what is wanted at one point that has `n_terms` neighbours at least.
  /// @returns the regularity of its matrices, 1 if it has none
  virtual double evaluate_point(const Place &place) const = 0;

  /// @throws std::invalid_argument for what the basis cannot give
  virtual void check_wanted(const Wanted &wanted) const = 0;

  const kernels::Kernel &kernel() const { return kernel_; }

private:
  kernels::Kernel kernel_;
  EdgeRule edge_;
};

} // namespace meshless::basis
