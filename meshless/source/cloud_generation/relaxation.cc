#include "relaxation.h"

#include "wall.h"

#include "meshless/cloud/levelled_cells.h"
#include "meshless/cloud/radix_sort.h"
#include "meshless/linear_algebra/pack.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace meshless::cloud_generation {

namespace {

using linear_algebra::gather;
using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;

/// Particles farther apart than this, in units of the spacing, do not see each other.
constexpr double reach = 1.7;
/// Neighbour lists hold until a particle has moved by half of this, in units of its spacing.
constexpr double margin = 0.3;
constexpr int n_steps = 120;
/// After each round the worst crowded particles are put into the largest gaps.
constexpr int n_rounds = 3;
constexpr int n_steps_between = 30;
/// Nearer to its neighbour than this a particle is crowded; a gap has at least as much around it.
constexpr double crowded = 0.72;
/// Least distance of a particle inside from the boundary, in units of the spacing.
constexpr double clearance = 0.5;
/// Largest step; below the clearance, so that nothing jumps over a slot.
constexpr double longest_step = 0.15;

class Relaxation {
public:
  Relaxation(const domain::Boundary &region, const Spacing &spacing, double scale,
             std::span<const Point2> boundary_particles, std::vector<Point2> &interior)
      : region_(region), spacing_(spacing), scale_(scale), wall_(region, boundary_particles),
        n_fixed_(boundary_particles.size()), interior_(interior),
        positions_(boundary_particles.begin(), boundary_particles.end()), velocity_(interior.size()),
        moved_(interior.size()) {
    positions_.insert(positions_.end(), interior.begin(), interior.end());
    s_ = spacing.at(positions_);
    for (double &s : s_)
      s *= scale;
  }

  void run() {
    settle(n_steps);
    for (int round = 1; round < n_rounds && fill_gaps(); ++round)
      settle(n_steps_between);
    std::copy(positions_.begin() + static_cast<std::ptrdiff_t>(n_fixed_), positions_.end(), interior_.begin());
  }

private:
  void settle(int steps) {
    find_neighbours();
    for (int step = 0; step < steps; ++step) {
      if (farthest_move() > 0.5 * margin)
        find_neighbours();
      advance(2 * step < steps ? 0.8 : 0.6);
    }
  }

  /// Since the lists were made, in units of the spacing.
  double farthest_move() const {
    double squared = 0;
    for (std::size_t i = n_fixed_; i < positions_.size(); ++i)
      squared = std::max(squared, cloud::distance_squared<2>(positions_[i], listed_[i]) / (s_[i] * s_[i]));
    return std::sqrt(squared);
  }

  void find_neighbours() {
    listed_ = positions_;
    auto inside = spacing_.at(std::span(positions_).subspan(n_fixed_));
    for (std::size_t i = 0; i < inside.size(); ++i)
      s_[n_fixed_ + i] = scale_ * inside[i];
    const cloud::LevelledCells<2> cells(positions_, s_, (reach + margin) / 2);
    offsets_.assign(1, 0);
    neighbours_.clear();
    weights_.clear();
    near_boundary_.assign(interior_.size(), false);
    std::vector<std::size_t> pieces;
    std::vector<cloud::Index> found;
    for (std::size_t i = 0; i < interior_.size(); ++i) {
      const std::size_t a = n_fixed_ + i;
      found.clear();
      cells.append_within(positions_[a], (reach + margin) * s_[a], 0, found);
      cloud::sort_indices(found, found.size());
      std::copy_if(found.begin(), found.end(), std::back_inserter(neighbours_), [&](cloud::Index j) {
        const auto b = static_cast<std::size_t>(j);
        return b != a && (b >= n_fixed_ || !wall_.hides(b, positions_[b], positions_[a]));
      });
      offsets_.push_back(neighbours_.size());
      for (std::size_t k = weights_.size(); k < neighbours_.size(); ++k)
        weights_.push_back(2 / (s_[a] + s_[static_cast<std::size_t>(neighbours_[k])]));
      region_.pieces_within(positions_[a], (clearance + 4 * longest_step) * s_[a], pieces);
      near_boundary_[i] = !pieces.empty();
    }
    interleave();
  }

  /// The lists of as many particles as there are lanes, turn by turn; the shorter ones end with the particle itself,
  /// which does not repel.
  void interleave() {
    group_offsets_.assign(1, 0);
    partners_.clear();
    partner_weights_.clear();
    for (std::size_t first = 0; first < interior_.size(); first += n_lanes) {
      std::size_t longest = 0;
      for (std::size_t i = first; i < std::min(first + n_lanes, interior_.size()); ++i)
        longest = std::max(longest, offsets_[i + 1] - offsets_[i]);
      for (std::size_t k = 0; k < longest; ++k)
        for (std::size_t i = first; i < first + n_lanes; ++i) {
          const bool any = i < interior_.size() && offsets_[i] + k < offsets_[i + 1];
          const std::size_t itself = n_fixed_ + std::min(i, interior_.size() - 1);
          partners_.push_back(any ? neighbours_[offsets_[i] + k] : static_cast<cloud::Index>(itself));
          partner_weights_.push_back(any ? weights_[offsets_[i] + k] : 0);
        }
      group_offsets_.push_back(partners_.size());
    }
  }

  /// Distance to the nearest neighbour of the particle with list i, in units of the spacing; from `x` near it.
  double nearest(std::size_t i, const Point2 &x, bool with_itself) const {
    const std::size_t a = n_fixed_ + i;
    double squared = with_itself ? cloud::distance_squared<2>(x, positions_[a]) / (s_[a] * s_[a]) : reach * reach;
    for (std::size_t k = offsets_[i]; k < offsets_[i + 1]; ++k) {
      const auto b = static_cast<std::size_t>(neighbours_[k]);
      const double mean = 0.5 * (s_[a] + s_[b]);
      squared = std::min(squared, cloud::distance_squared<2>(x, positions_[b]) / (mean * mean));
    }
    return std::sqrt(squared);
  }

  /// Largest gap beside particle i: its size and place. No place outside is offered.
  std::pair<double, Point2> gap_beside(std::size_t i) {
    static constexpr std::array<Point2, 8> directions{{{1, 0},
                                                       {0.7071067811865476, 0.7071067811865476},
                                                       {0, 1},
                                                       {-0.7071067811865476, 0.7071067811865476},
                                                       {-1, 0},
                                                       {-0.7071067811865476, -0.7071067811865476},
                                                       {0, -1},
                                                       {0.7071067811865476, -0.7071067811865476}}};
    const std::size_t a = n_fixed_ + i;
    std::pair<double, Point2> best{0, {}};
    for (const Point2 &e : directions) {
      const double step = 0.9 * s_[a];
      Point2 x{positions_[a][0] + step * e[0], positions_[a][1] + step * e[1]};
      const double size = nearest(i, x, true);
      if (size > best.first && (!near_boundary_[i] || keep_inside(x, s_[a])))
        best = {size, x};
    }
    return best;
  }

  /// Moves crowded particles into the largest gaps; false if there was nothing to do.
  bool fill_gaps() {
    find_neighbours();
    std::vector<std::pair<double, std::size_t>> crowd;
    std::vector<std::pair<double, Point2>> gaps;
    for (std::size_t i = 0; i < interior_.size(); ++i)
      if (const double q = nearest(i, positions_[n_fixed_ + i], false); q < crowded)
        crowd.emplace_back(q, i);
    if (crowd.empty())
      return false;
    for (std::size_t i = 0; i < interior_.size(); ++i)
      if (const auto gap = gap_beside(i); gap.first > crowded)
        gaps.push_back(gap);
    std::sort(crowd.begin(), crowd.end());
    std::sort(gaps.begin(), gaps.end(), [](const auto &p, const auto &q) { return p.first > q.first; });
    // Of two crowded neighbours one has to go; a gap is found from several sides.
    std::vector<Point2> taken;
    std::vector<Point2> left;
    std::size_t next = 0;
    for (const auto &[q, i] : crowd) {
      const std::size_t a = n_fixed_ + i;
      const auto far = [&](const std::vector<Point2> &points, const Point2 &x) {
        return std::all_of(points.begin(), points.end(),
                           [&](const Point2 &p) { return cloud::distance_squared<2>(p, x) > 4 * s_[a] * s_[a]; });
      };
      if (!far(left, positions_[a]))
        continue;
      while (next < gaps.size() && !far(taken, gaps[next].second))
        ++next;
      if (next == gaps.size())
        break;
      left.push_back(positions_[a]);
      taken.push_back(gaps[next].second);
      positions_[a] = gaps[next].second;
      velocity_[i] = {};
    }
    return !taken.empty();
  }

  /// One step of gradient descent with momentum; the repulsion at the distance q, in units of the spacing, is
  /// (1 - q / reach)^2 / (q + .05).
  void advance(double momentum) {
    for (std::size_t group = 0; group + 1 < group_offsets_.size(); ++group)
      propose(group, momentum);
    for (std::size_t i = 0; i < interior_.size(); ++i) {
      const std::size_t a = n_fixed_ + i;
      if (!near_boundary_[i] || keep_inside(moved_[i], s_[a])) {
        positions_[a] = moved_[i];
        continue;
      }
      // Pressed against the boundary: away from it, but no farther.
      velocity_[i] = {};
      moved_[i] = positions_[a];
      if (keep_inside(moved_[i], s_[a]))
        positions_[a] = moved_[i];
    }
  }

  /// Where the particles of a group, a lane each, would go. Every lane adds up in the order of its own list, so that
  /// the cloud is the same for every number of lanes.
  void propose(std::size_t group, double momentum) {
    const std::size_t first = group * n_lanes;
    const auto place = [&](auto lane) { return n_fixed_ + std::min(first + lane, interior_.size() - 1); };
    const Pack x([&](auto lane) { return positions_[place(lane)][0]; });
    const Pack y([&](auto lane) { return positions_[place(lane)][1]; });
    const double *positions = positions_.front().data();
    Pack force_x = 0;
    Pack force_y = 0;
    for (std::size_t k = group_offsets_[group]; k < group_offsets_[group + 1]; k += n_lanes) {
      const Pack dx = x - gather<2>(positions, partners_.data() + k);
      const Pack dy = y - gather<2>(positions + 1, partners_.data() + k);
      const Pack weight = load(partner_weights_.data() + k);
      Pack d = sqrt(dx * dx + dy * dy);
      const Pack t = 1 - d * weight * (1 / reach);
      const auto apart = t <= 0 || d == 0;
      where(d == 0, d) = 1;
      Pack f = t * t / ((d * weight + 0.05) * d);
      where(apart, f) = 0;
      force_x += f * dx;
      force_y += f * dy;
    }
    for (std::size_t i = first; i < std::min(first + n_lanes, interior_.size()); ++i) {
      const std::size_t a = n_fixed_ + i;
      // In units of the spacing.
      Point2 v{momentum * velocity_[i][0] + step_size * force_x[i - first],
               momentum * velocity_[i][1] + step_size * force_y[i - first]};
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1]);
      if (length > longest_step)
        v = {v[0] * longest_step / length, v[1] * longest_step / length};
      velocity_[i] = v;
      moved_[i] = {positions_[a][0] + s_[a] * v[0], positions_[a][1] + s_[a] * v[1]};
    }
  }

  /// Pushes a point away from the boundary; false if it has left the region or found no room.
  bool keep_inside(Point2 &x, double s) {
    const double least = clearance * s;
    for (int attempt = 0; attempt < 3; ++attempt) {
      if (!region_.contains(x))
        return false;
      region_.pieces_within(x, least, pieces_);
      if (pieces_.empty())
        return true;
      double distance = least;
      Point2 foot{};
      for (const std::size_t p : pieces_) {
        const auto &piece = region_.pieces()[p];
        const Point2 nearest = piece.point(piece.nearest(x));
        const double d = std::sqrt(cloud::distance_squared<2>(x, nearest));
        if (d < distance) {
          distance = d;
          foot = nearest;
        }
      }
      if (distance == least)
        return true;
      if (distance <= 2 * region_.tolerance())
        return false;
      for (std::size_t k = 0; k < 2; ++k)
        x[k] = foot[k] + (x[k] - foot[k]) * (1.0001 * least / distance);
    }
    // A wall thinner than twice the clearance: anywhere inside will do.
    return region_.contains(x) && region_.distance(x) > 0.05 * s;
  }

  static constexpr double step_size = 0.12;

  const domain::Boundary &region_;
  const Spacing &spacing_;
  double scale_;
  Wall wall_;
  std::size_t n_fixed_;
  std::vector<Point2> &interior_;
  std::vector<Point2> positions_;
  std::vector<Point2> listed_; ///< positions that the neighbour lists were made for
  std::vector<double> s_;
  std::vector<Point2> velocity_;
  std::vector<Point2> moved_;
  std::vector<bool> near_boundary_;
  std::vector<std::size_t> offsets_;
  std::vector<cloud::Index> neighbours_;
  std::vector<double> weights_; ///< one over the mean spacing of the two
  /// The same for packs of particles: a partner of each lane after the other.
  std::vector<std::size_t> group_offsets_;
  std::vector<cloud::Index> partners_;
  std::vector<double> partner_weights_;
  std::vector<std::size_t> pieces_;
};

} // namespace

void relax(const domain::Boundary &region, const Spacing &spacing, double scale,
           std::span<const Point2> boundary_particles, std::vector<Point2> &interior) {
  Relaxation(region, spacing, scale, boundary_particles, interior).run();
}

} // namespace meshless::cloud_generation
