#include "kernel_weights.h"

namespace meshless::basis {

namespace {

using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

template <int dim>
using Offset = std::array<Pack, dim>;

/// Distance squared over h_J squared.
template <int dim>
Pack scaled_distance_squared(const Offset<dim> &x, const CandidateBatch<dim> &candidates, std::size_t j) {
  Pack s_squared = 0;
  for (int k = 0; k < dim; ++k) {
    const Pack s = (candidates.coordinate(k)[j] - x[k]) * candidates.inverse_h()[j];
    s_squared += s * s;
  }
  return s_squared;
}

/// V_J G / h_J^dim.
template <int dim>
double amount(const CandidateBatch<dim> &candidates, std::size_t j, double normalisation) {
  double result = normalisation * candidates.volumes()[j];
  for (int k = 0; k < dim; ++k)
    result *= candidates.inverse_h()[j];
  return result;
}

/// Flattened: the compiler must see the exponential function to compute it once for value, slope and curvature.
template <int dim, typename Kernel>
[[gnu::flatten]] void compute(const Kernel &kernel, const Weighing &weighing, const Offset<dim> &x,
                              const CandidateBatch<dim> &candidates, WeightDerivatives derivatives,
                              typename ShapeFunctions<dim>::Workspace &workspace) {
  const double support = kernel.support();
  const double limit = edge_limit(support, weighing.edge);
  // Arguments stay inside the support, where the kernel holds.
  const double largest = std::min(limit, support * support);
  const double normalisation = kernel.normalisation(dim);
  workspace.active.clear();
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    Pack s_squared = scaled_distance_squared<dim>(x, candidates, j);
    const auto inside = s_squared < limit;
    if (none_of(inside))
      continue;
    s_squared = min(s_squared, Pack(largest));
    const std::size_t a = workspace.active.size() * n_lanes;
    workspace.active.push_back(static_cast<cloud::Index>(j));
    const double factor = weighing.volumes ? amount(candidates, j, normalisation) : 1;
    const auto keep = [&](Pack quantity, std::vector<double> &array) {
      where(!inside, quantity) = 0;
      store(weighing.volumes ? quantity * factor : quantity, &array[a]);
    };
    keep(kernel.value(s_squared), workspace.weights);
    if (derivatives == WeightDerivatives::none)
      continue;
    Pack slope = kernel.slope(s_squared);
    if (derivatives == WeightDerivatives::second) {
      const auto centre = s_squared == 0;
      const Pack curvature = kernel.curvature(s_squared);
      where(centre, slope) = curvature; // where every direction is radial
      Pack divisor = s_squared;
      where(centre, divisor) = 1; // 0 / 0 there, even if it is thrown away, would trap in Debug builds
      Pack radial = (curvature - slope) / divisor;
      where(centre, radial) = 0;
      keep(radial, workspace.curvatures);
    }
    keep(slope, workspace.slopes);
  }
}

} // namespace

template <int dim>
void compute_weights(const Weighing &weighing, const std::array<Pack, dim> &x, const CandidateBatch<dim> &candidates,
                     WeightDerivatives derivatives, typename ShapeFunctions<dim>::Workspace &workspace) {
  std::visit([&](const auto &kernel) { compute<dim>(kernel, weighing, x, candidates, derivatives, workspace); },
             weighing.kernel);
}

template <int dim>
std::size_t count_neighbours(const Weighing &weighing, const cloud::Point<dim> &x,
                             const CandidateBatch<dim> &candidates) {
  const double limit = edge_limit(kernels::support_of(weighing.kernel), weighing.edge);
  std::size_t count = 0;
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    double s_squared = 0;
    for (int k = 0; k < dim; ++k) {
      const double s = (candidates.coordinate(k)[j] - x[k]) * candidates.inverse_h()[j];
      s_squared += s * s;
    }
    count += s_squared < limit;
  }
  return count;
}

#define INSTANTIATE(dim)                                                                                               \
  template void compute_weights<dim>(const Weighing &, const std::array<Pack, dim> &, const CandidateBatch<dim> &,     \
                                     WeightDerivatives, ShapeFunctions<dim>::Workspace &);                             \
  template std::size_t count_neighbours<dim>(const Weighing &, const cloud::Point<dim> &, const CandidateBatch<dim> &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
