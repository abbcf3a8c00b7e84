#include "meshless/basis/point_neighbours.h"

#include "meshless/basis/shape_functions.h"

#include <limits>
#include <stdexcept>

namespace meshless::basis {

namespace {

// Points without candidates have nothing to weigh; that they have no neighbours is reported as such.
void require_volumes_of(bool nothing_to_weigh, bool has_volumes) {
  if (!nothing_to_weigh && !has_volumes)
    throw std::invalid_argument("this basis weighs particles with their volumes m / rho, and the cloud has none: give "
                                "volumes to the particles, or choose ssph or mls without volumes");
}

} // namespace

template <int dim>
void require_volumes(const CandidateBatch<dim> &candidates) {
  require_volumes_of(candidates.size() == 0, candidates.volumes() != nullptr);
}

template <int dim>
void require_volumes(const NeighbourPack<dim> &pack) {
  require_volumes_of(pack.n_slots() == 0, pack.particles().has_volumes());
}

template <int dim>
void PointNeighbours<dim>::collect(const kernels::Kernel &kernel, EdgeRule edge, const cloud::Point<dim> &x,
                                   const CandidateBatch<dim> &candidates, double scale) {
  require_volumes(candidates);
  if (candidates.flattening(0) != nullptr)
    throw std::invalid_argument("this basis has round supports alone: choose ssph for ellipses");
  all.clear();
  const double inverse_scale = 1 / scale;
  double least_distance = std::numeric_limits<double>::infinity();
  nearest = 0;
  std::visit(
      [&](const auto &k) {
        const double support = k.support();
        const double limit = edge_limit(support, edge);
        const double factor = k.normalisation(dim);
        for (std::size_t j = 0; j < candidates.size(); ++j) {
          PointNeighbour<dim> neighbour;
          const double inverse_h = candidates.inverse_h()[j];
          double distance_squared = 0;
          for (int i = 0; i < dim; ++i) {
            const double d = candidates.coordinate(i)[j] - x[i];
            distance_squared += d * d;
            neighbour.offset[i] = d * inverse_scale;
          }
          double s_squared = distance_squared * inverse_h * inverse_h;
          if (!(s_squared < limit))
            continue;
          s_squared = std::min(s_squared, support * support);
          double amount = factor * candidates.volumes()[j];
          for (int i = 0; i < dim; ++i)
            amount *= inverse_h;
          const double to_h = scale * inverse_h;
          const double unit = amount * to_h * to_h;
          const double curvature = k.curvature(s_squared);
          // At the centre every direction is radial.
          const double slope = s_squared > 0 ? k.slope(s_squared) : curvature;
          const double radial = s_squared > 0 ? (curvature - slope) / s_squared * to_h * to_h : 0;
          neighbour.candidate = j;
          neighbour.weight = amount * k.value(s_squared);
          int ab = 0;
          for (int a = 0; a < dim; ++a) {
            neighbour.gradient[a] = unit * slope * neighbour.offset[a];
            for (int b = a; b < dim; ++b, ++ab)
              neighbour.hessian[ab] =
                  unit * ((a == b ? slope : 0) + radial * neighbour.offset[a] * neighbour.offset[b]);
          }
          if (distance_squared < least_distance) {
            least_distance = distance_squared;
            nearest = all.size();
          }
          all.push_back(neighbour);
        }
      },
      kernel);
}

#define INSTANTIATE(dim)                                                                                               \
  template void require_volumes<dim>(const CandidateBatch<dim> &);                                                     \
  template void require_volumes<dim>(const NeighbourPack<dim> &);                                                      \
  template struct PointNeighbours<dim>;
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
