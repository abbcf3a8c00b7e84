#include "kernel_weights.h"

namespace meshless::basis {

namespace {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

template <int dim>
using Offset = std::array<Pack, dim>;

/// V_J G / h_J^dim.
template <int dim>
double amount(const CandidateBatch<dim> &candidates, std::size_t j, double normalisation) {
  double result = normalisation * candidates.volumes()[j];
  for (int k = 0; k < dim; ++k)
    result *= candidates.inverse_h()[j];
  return result;
}

/// Distance squared over h_J squared of the candidates inside the support of a lane, and which they are. Without a
/// branch: whether a candidate is a neighbour cannot be foreseen.
/// @returns how many they are
template <int dim>
std::size_t find_neighbours(const Offset<dim> &x, const CandidateBatch<dim> &candidates, double limit,
                            cloud::Index *active, double *squares) {
  std::array<const double *, dim> coordinates;
  for (int k = 0; k < dim; ++k)
    coordinates[k] = candidates.coordinate(k);
  const double *inverse_h = candidates.inverse_h();
  const std::size_t n = candidates.size();
  const Offset<dim> own = x; // a copy that no store can change
  std::size_t n_active = 0;
  for (std::size_t j = 0; j < n; ++j) {
    Pack s_squared = 0;
    for (int k = 0; k < dim; ++k) {
      const Pack d = coordinates[k][j] - own[k];
      s_squared += d * d;
    }
    s_squared *= inverse_h[j] * inverse_h[j];
    store(s_squared, squares + n_active * n_lanes);
    active[n_active] = static_cast<cloud::Index>(j);
    n_active += any_of(s_squared < limit);
  }
  return n_active;
}

/// Flattened: the compiler must see the exponential function to compute it once for value, slope and curvature.
template <int dim, WeightDerivatives derivatives, typename Kernel>
[[gnu::flatten]] void compute(const Kernel &given, const Weighing &weighing, const Offset<dim> &x,
                              const CandidateBatch<dim> &candidates,
                              typename ShapeFunctions<dim>::Workspace &workspace) {
  const Kernel kernel = given;
  const double support = kernel.support();
  const double limit = edge_limit(support, weighing.edge);
  // Arguments stay inside the support, where the kernel holds.
  const double largest = std::min(limit, support * support);
  double *weights = workspace.weights.data();
  double *slopes = workspace.slopes.data();
  double *curvatures = workspace.curvatures.data();
  workspace.active.resize(candidates.size());
  const std::size_t n_active = find_neighbours<dim>(x, candidates, limit, workspace.active.data(), weights);
  workspace.active.resize(n_active);
  for (std::size_t a = 0; a < n_active; ++a) {
    Pack s_squared = load(weights + a * n_lanes);
    const auto outside = !(s_squared < limit);
    s_squared = min(s_squared, Pack(largest));
    const auto keep = [&](Pack quantity, double *array) {
      where(outside, quantity) = 0;
      store(quantity, array + a * n_lanes);
    };
    keep(kernel.value(s_squared), weights);
    if constexpr (derivatives == WeightDerivatives::none)
      continue;
    Pack slope = kernel.slope(s_squared);
    if constexpr (derivatives == WeightDerivatives::second) {
      const auto centre = s_squared == 0;
      const Pack curvature = kernel.curvature(s_squared);
      where(centre, slope) = curvature; // where every direction is radial
      Pack divisor = s_squared;
      where(centre, divisor) = 1; // 0 / 0 there, even if it is thrown away, would trap in Debug builds
      Pack radial = (curvature - slope) / divisor;
      where(centre, radial) = 0;
      keep(radial, curvatures);
    }
    keep(slope, slopes);
  }
  if (!weighing.volumes)
    return;
  const double normalisation = kernel.normalisation(dim);
  for (std::size_t a = 0; a < n_active; ++a) {
    const double factor = amount(candidates, static_cast<std::size_t>(workspace.active[a]), normalisation);
    const auto scale = [&](double *array) { store(load(array + a * n_lanes) * factor, array + a * n_lanes); };
    scale(weights);
    if constexpr (derivatives != WeightDerivatives::none)
      scale(slopes);
    if constexpr (derivatives == WeightDerivatives::second)
      scale(curvatures);
  }
}

} // namespace

template <int dim>
void compute_weights(const Weighing &weighing, const std::array<Pack, dim> &x, const CandidateBatch<dim> &candidates,
                     WeightDerivatives derivatives, typename ShapeFunctions<dim>::Workspace &workspace) {
  std::visit(
      [&](const auto &kernel) {
        if (derivatives == WeightDerivatives::none)
          compute<dim, WeightDerivatives::none>(kernel, weighing, x, candidates, workspace);
        else if (derivatives == WeightDerivatives::first)
          compute<dim, WeightDerivatives::first>(kernel, weighing, x, candidates, workspace);
        else
          compute<dim, WeightDerivatives::second>(kernel, weighing, x, candidates, workspace);
      },
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
