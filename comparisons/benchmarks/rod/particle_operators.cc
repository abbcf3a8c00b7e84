#include "comparisons/benchmarks/rod/methods.h"

#include "comparisons/benchmarks/rod/basis_choice.h"

#include "meshless/basis/derivative_operators.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace comparisons::benchmarks::rod {

namespace {

/// Particles within the support of each, itself included; places increase. Whether one on the edge counts is decided as
/// by the bases.
void require_neighbours(const std::vector<double> &places, double support, double h, std::size_t needed,
                        std::string_view basis) {
  using meshless::basis::EdgeRule;
  const double radius = h * std::sqrt(meshless::basis::edge_limit(support, EdgeRule::excluded));
  std::size_t first = 0;
  std::size_t last = 0; // one past
  for (std::size_t i = 0; i < places.size(); ++i) {
    while (places[i] - places[first] >= radius)
      ++first;
    while (last < places.size() && places[last] - places[i] < radius)
      ++last;
    if (last - first < needed)
      throw methods::Refused(fmt::format("basis {} needs {} particles within the support of {:.6g} m; particle {} at "
                                         "x = {:.6g} m has {}, itself included: use more particles or a larger support",
                                         basis, needed, support * h, i + 1, places[i], last - first));
  }
}

} // namespace

ParticleOperators particle_operators(const scene::Parameters &method, const std::vector<double> &places,
                                     Measurement &measurement) {
  auto &seconds = measurement.seconds;
  meshless::linear_algebra::Stopwatch watch;
  const auto basis = make_basis(method);
  const auto volumes = method.text("volumes") == "equal" ? Volumes::equal : Volumes::voronoi;
  const auto particles = make_particles(places, method.real("smoothing_length"), volumes);
  seconds["points"] += watch.lap();
  require_neighbours(places, basis->support(), particles.smoothing_length(0), basis->n_terms(), method.text("basis"));
  seconds["neighbours"] += watch.lap();
  try {
    auto operators =
        meshless::basis::make_derivative_operators<1>(*basis, particles, {.gradient = true, .hessian = true});
    seconds["basis"] += watch.lap();
    measurement.n_pivoted += operators.n_indefinite;
    return {std::move(operators.gradient.front()), std::move(operators.hessian.front())};
  } catch (const meshless::basis::SingularMomentMatrix &error) {
    throw methods::Refused(error.what());
  } catch (const std::invalid_argument &error) { // no second derivatives of this order or with this kernel
    throw methods::Refused(error.what());
  }
}

} // namespace comparisons::benchmarks::rod
