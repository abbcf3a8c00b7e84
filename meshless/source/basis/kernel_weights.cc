#include "kernel_weights.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace meshless::basis {

namespace {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::store;

template <int dim>
using Offset = std::array<Pack, dim>;

/// Distance squared over h_J squared of the candidates inside the support of a lane, and which they are. Without a
/// branch: whether a candidate is a neighbour cannot be foreseen.
/// @returns how many they are
template <int dim, bool round>
std::size_t find_neighbours(const Offset<dim> &x, const CandidateBatch<dim> &candidates, double limit,
                            cloud::Index *active, double *squares) {
  std::array<const double *, dim> coordinates;
  for (int k = 0; k < dim; ++k)
    coordinates[k] = candidates.coordinate(k);
  std::array<const double *, dim> flattening;
  for (int k = 0; k < dim; ++k)
    flattening[k] = candidates.flattening(k);
  const double *inverse_h = candidates.inverse_h();
  const std::size_t n = candidates.size();
  const Offset<dim> own = x; // a copy that no store can change
  std::size_t n_active = 0;
  for (std::size_t j = 0; j < n; ++j) {
    Pack s_squared = 0;
    Pack along = 0;
    for (int k = 0; k < dim; ++k) {
      const Pack d = coordinates[k][j] - own[k];
      s_squared += d * d;
      if constexpr (!round)
        along += flattening[k][j] * d;
    }
    if constexpr (!round)
      s_squared += along * along;
    s_squared *= inverse_h[j] * inverse_h[j];
    store(s_squared, squares + n_active * n_lanes);
    active[n_active] = static_cast<cloud::Index>(j);
    n_active += any_of(s_squared < limit);
  }
  return n_active;
}

/// Of the slots of a pack; those that a lane has not are outside.
template <int dim, bool round>
void measure_slots(const NeighbourPack<dim> &pack, double limit, double *squares) {
  const Pack counts = pack.counts();
  const Pack scale = pack.scale();
  for (std::size_t a = 0; a < pack.n_slots(); ++a) {
    Pack s_squared = 0;
    Pack along = 0;
    for (int k = 0; k < dim; ++k) {
      const Pack d = load(pack.offset(k) + a * n_lanes);
      s_squared += d * d;
      if constexpr (!round)
        along += pack.flattening(k, a) * d;
    }
    if constexpr (!round)
      s_squared += along * along;
    const Pack to_h = scale * load(pack.inverse_h() + a * n_lanes);
    s_squared *= to_h * to_h;
    where(counts <= static_cast<double>(a), s_squared) = limit;
    store(s_squared, squares + a * n_lanes);
  }
}

/// Derivatives of the weights and their normalisation are those of round supports.
void require_round(const Weighing &weighing, WeightDerivatives derivatives, bool round) {
  if (!round && (weighing.volumes || derivatives != WeightDerivatives::none))
    throw std::invalid_argument("supports that are ellipses need a basis that weighs without volumes and finds its "
                                "derivatives directly: ssph");
}

/// Replaces s^2 in `workspace.weights` by the kernel.
///
/// Flattened: the compiler must see the exponential function to compute it once for value, slope and curvature.
template <WeightDerivatives derivatives, typename Kernel, typename Workspace>
[[gnu::flatten]] void compute(const Kernel &given, double limit, std::size_t n_active, Workspace &workspace) {
  const Kernel kernel = given;
  // Arguments stay inside the support, where the kernel holds.
  const double largest = std::min(limit, kernel.support() * kernel.support());
  double *weights = workspace.weights.data();
  double *slopes = workspace.slopes.data();
  double *curvatures = workspace.curvatures.data();
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
}

template <typename Workspace>
void compute(const Weighing &weighing, WeightDerivatives derivatives, double limit, std::size_t n_active,
             Workspace &workspace) {
  std::visit(
      [&](const auto &kernel) {
        if (derivatives == WeightDerivatives::none)
          compute<WeightDerivatives::none>(kernel, limit, n_active, workspace);
        else if (derivatives == WeightDerivatives::first)
          compute<WeightDerivatives::first>(kernel, limit, n_active, workspace);
        else
          compute<WeightDerivatives::second>(kernel, limit, n_active, workspace);
      },
      weighing.kernel);
}

/// Times V_J G / h_J^dim.
/// @param amount_of V_J and 1 / h_J of neighbour a, of all lanes or one a lane
template <int dim, typename Workspace, typename AmountOf>
void multiply_volumes(const Weighing &weighing, WeightDerivatives derivatives, std::size_t n_active,
                      Workspace &workspace, const AmountOf &amount_of) {
  const double normalisation = kernels::normalisation_of(weighing.kernel, dim);
  for (std::size_t a = 0; a < n_active; ++a) {
    const auto [volume, inverse_h] = amount_of(a);
    auto factor = normalisation * volume;
    for (int k = 0; k < dim; ++k)
      factor *= inverse_h;
    const auto scale = [&](std::vector<double> &array) {
      store(load(&array[a * n_lanes]) * factor, &array[a * n_lanes]);
    };
    scale(workspace.weights);
    if (derivatives != WeightDerivatives::none)
      scale(workspace.slopes);
    if (derivatives == WeightDerivatives::second)
      scale(workspace.curvatures);
  }
}

template <typename Workspace>
void make_room(std::size_t n_neighbours, WeightDerivatives derivatives, Workspace &workspace) {
  const std::size_t n_weights = n_neighbours * n_lanes;
  workspace.weights.resize(n_weights);
  workspace.slopes.resize(derivatives == WeightDerivatives::none ? 0 : n_weights);
  workspace.curvatures.resize(derivatives == WeightDerivatives::second ? n_weights : 0);
}

} // namespace

template <int dim>
void compute_weights(const Weighing &weighing, const std::array<Pack, dim> &x, const CandidateBatch<dim> &candidates,
                     WeightDerivatives derivatives, typename ShapeFunctions<dim>::Workspace &workspace) {
  const bool round = candidates.flattening(0) == nullptr;
  require_round(weighing, derivatives, round);
  make_room(candidates.size(), derivatives, workspace);
  const double limit = edge_limit(kernels::support_of(weighing.kernel), weighing.edge);
  auto &active = workspace.active;
  active.resize(candidates.size());
  const auto find = round ? find_neighbours<dim, true> : find_neighbours<dim, false>;
  active.resize(find(x, candidates, limit, active.data(), workspace.weights.data()));
  compute(weighing, derivatives, limit, active.size(), workspace);
  if (weighing.volumes)
    multiply_volumes<dim>(weighing, derivatives, active.size(), workspace, [&](std::size_t a) {
      const auto j = static_cast<std::size_t>(active[a]);
      return std::pair(candidates.volumes()[j], candidates.inverse_h()[j]);
    });
}

template <int dim>
void compute_weights(const Weighing &weighing, const NeighbourPack<dim> &pack, WeightDerivatives derivatives,
                     typename ShapeFunctions<dim>::Workspace &workspace) {
  const bool round = !pack.particles().has_flattenings();
  require_round(weighing, derivatives, round);
  make_room(pack.n_slots(), derivatives, workspace);
  const double limit = edge_limit(kernels::support_of(weighing.kernel), weighing.edge);
  const auto measure = round ? measure_slots<dim, true> : measure_slots<dim, false>;
  measure(pack, limit, workspace.weights.data());
  compute(weighing, derivatives, limit, pack.n_slots(), workspace);
  if (weighing.volumes)
    multiply_volumes<dim>(weighing, derivatives, pack.n_slots(), workspace, [&](std::size_t a) {
      return std::pair(pack.volumes(a), load(pack.inverse_h() + a * n_lanes));
    });
}

template <int dim>
std::size_t count_neighbours(const Weighing &weighing, const cloud::Point<dim> &x,
                             const CandidateBatch<dim> &candidates) {
  const double limit = edge_limit(kernels::support_of(weighing.kernel), weighing.edge);
  std::size_t count = 0;
  for (std::size_t j = 0; j < candidates.size(); ++j) {
    double s_squared = 0;
    double along = 0;
    for (int k = 0; k < dim; ++k) {
      const double s = (candidates.coordinate(k)[j] - x[k]) * candidates.inverse_h()[j];
      s_squared += s * s;
      if (candidates.flattening(k) != nullptr)
        along += candidates.flattening(k)[j] * s;
    }
    s_squared += along * along;
    count += s_squared < limit;
  }
  return count;
}

#define INSTANTIATE(dim)                                                                                               \
  template void compute_weights<dim>(const Weighing &, const std::array<Pack, dim> &, const CandidateBatch<dim> &,     \
                                     WeightDerivatives, ShapeFunctions<dim>::Workspace &);                             \
  template void compute_weights<dim>(const Weighing &, const NeighbourPack<dim> &, WeightDerivatives,                  \
                                     ShapeFunctions<dim>::Workspace &);                                                \
  template std::size_t count_neighbours<dim>(const Weighing &, const cloud::Point<dim> &, const CandidateBatch<dim> &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
