#pragma once

#include "meshless/cloud/neighbour_lists.h"
#include "meshless/cloud/particles.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace meshless::basis {

/// Up to a SIMD pack of points, each with a list of neighbours of its own, for points too far from each other to share
/// candidates. Slot a holds the a-th neighbour of every point, a lane each; the slots that a shorter list lacks repeat
/// its first particle and count nothing.
template <int dim>
class NeighbourPack {
  using Pack = linear_algebra::Pack;
  static constexpr std::size_t n_lanes = linear_algebra::n_lanes;

public:
  /// @param particles kept by reference, as are the lists
  /// @param points one at least, as many as a pack holds at most
  /// @param lists of indices of particles, as many as points: all whose support holds the point, farther ones may be
  ///   among them
  void assign(const cloud::Particles<dim> &particles, std::span<const cloud::Point<dim>> points,
              std::span<const std::span<const cloud::Index>> lists);

  const cloud::Particles<dim> &particles() const { return *particles_; }
  std::size_t size() const { return size_; }
  const cloud::Point<dim> &point(std::size_t i) const { return points_[i]; }
  std::span<const cloud::Index> list(std::size_t i) const { return lists_[i]; }
  /// Length of the longest list.
  std::size_t n_slots() const { return n_slots_; }

  /// (xi_J - x)_k / scale of the lanes of slot a from a * n_lanes on.
  const double *offset(int k) const { return offsets_[k].data(); }
  /// 1 / h_J likewise, 1/m.
  const double *inverse_h() const { return inverse_h_.data(); }
  /// Volumes of the particles of a slot, m^dim.
  Pack volumes(std::size_t a) const {
    return linear_algebra::gather<1>(particles_->volumes().data(), &slots_[a * n_lanes]);
  }
  /// Component k of the flattening of the particles of a slot; there must be some.
  Pack flattening(int k, std::size_t a) const {
    return linear_algebra::gather<dim>(particles_->flattenings().data()->data() + k, &slots_[a * n_lanes]);
  }
  /// Lengths of the lists; lanes beyond the last point repeat it.
  Pack counts() const { return linear_algebra::load(counts_.data()); }
  /// Scale of the monomials of every point: the harmonic mean of its neighbours' h, m.
  Pack scale() const { return linear_algebra::load(scale_.data()); }

private:
  void fill_slots();
  void fill_lengths();

  const cloud::Particles<dim> *particles_ = nullptr;
  std::size_t size_ = 0;
  std::size_t n_slots_ = 0;
  std::array<cloud::Point<dim>, n_lanes> points_{};
  std::array<std::span<const cloud::Index>, n_lanes> lists_{};
  std::array<double, n_lanes> counts_{};
  std::array<double, n_lanes> scale_{};
  std::vector<cloud::Index> slots_; ///< particles, lane fastest
  std::array<std::vector<double>, dim> offsets_;
  std::vector<double> inverse_h_;
};

} // namespace meshless::basis
