#include "pointwise_basis.h"

#include <algorithm>

namespace meshless::basis {

template <int dim>
Regularity PointwiseBasis<dim>::evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates,
                                         const Wanted &wanted, Values &values, Workspace &workspace) const {
  check_wanted(wanted);
  values.resize(wanted, candidates.size(), points.stride());
  for (int quantity = 0; quantity < Values::n_quantities; ++quantity)
    if (values.has(quantity))
      for (std::size_t j = 0; j < candidates.size(); ++j)
        std::fill_n(values.row(quantity, j), points.stride(), 0.0);
  Regularity regularity;
  for (std::size_t i = 0; i < points.size(); ++i) {
    workspace.neighbours.collect(kernel_, edge_, points.point(i), candidates, candidates.scale());
    const std::size_t n_neighbours = workspace.neighbours.all.size();
    double ratio = 0;
    if (n_neighbours >= this->n_terms())
      ratio = evaluate_point({workspace.neighbours, workspace, values, wanted, i, candidates.scale()});
    if (ratio < regularity.smallest_pivot_ratio) {
      regularity.smallest_pivot_ratio = ratio;
      regularity.worst_point = i;
      regularity.n_neighbours = n_neighbours;
    }
  }
  return regularity;
}

template class PointwiseBasis<1>;
template class PointwiseBasis<2>;
template class PointwiseBasis<3>;

} // namespace meshless::basis
