#include "meshless/domain/visibility.h"

#include "detour.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace meshless::domain {

namespace {

/// Sine of the least turn to the right that counts as a re-entrant corner: below it lies the rounding of polylines.
constexpr double reflex_sine = 1e-9;

Point2 along(const Point2 &from, const Point2 &direction, double r) {
  return {from[0] + r * direction[0], from[1] + r * direction[1]};
}

} // namespace

Visibility::Visibility(const Boundary &boundary) : boundary_(&boundary) {
  const auto pieces = boundary.pieces();
  concave_.resize(pieces.size());
  reflex_after_.resize(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    concave_[i] = pieces[i].arc && !pieces[i].arc->counter_clockwise;
    const Point2 a = pieces[i].tangent(1);
    const Point2 b = pieces[boundary.next(i)].tangent(0);
    reflex_after_[i] = a[0] * b[1] - a[1] * b[0] < -reflex_sine;
    convex_ = convex_ && !concave_[i] && !reflex_after_[i];
  }
  convex_ = convex_ && boundary.n_loops() == 1;
}

bool Visibility::convex_chain(std::span<const std::size_t> pieces) const {
  std::size_t n_ends = 0;
  for (const std::size_t i : pieces) {
    if (concave_[i])
      return false;
    if (!std::binary_search(pieces.begin(), pieces.end(), boundary_->next(i)))
      ++n_ends;
    else if (reflex_after_[i])
      return false;
  }
  return n_ends <= 1;
}

Visibility::Place Visibility::place_of(const Point2 &point) const {
  std::vector<std::size_t> near;
  double radius = 2 * boundary_->tolerance();
  for (; near.empty(); radius *= 8)
    boundary_->pieces_within(point, radius, near);
  std::size_t nearest = near[0];
  for (const std::size_t i : near)
    if (boundary_->distance(point, i) < boundary_->distance(point, nearest))
      nearest = i;
  return {nearest, boundary_->pieces()[nearest].nearest(point)};
}

double Visibility::way(const Place &from, const Place &to) const {
  const std::size_t loop = boundary_->loop(from.piece);
  if (loop != boundary_->loop(to.piece))
    return std::numeric_limits<double>::infinity();
  return boundary_->distance_along_loop(loop, boundary_->along_loop(from.piece, from.t),
                                        boundary_->along_loop(to.piece, to.t));
}

double way_around(const Visibility &visibility, const Point2 &from, const Point2 &direction, double r,
                  std::span<const SeenPiece> pieces, std::span<const Meeting> meetings,
                  const std::vector<bool> &outside) {
  const auto place = [&](std::size_t k) -> Visibility::Place {
    if (k == 0)
      return visibility.place_of(from);
    if (k == meetings.size() + 1)
      return visibility.place_of(along(from, direction, r));
    const auto &piece = pieces[meetings[k - 1].piece];
    return {piece.index(), std::clamp(piece.parameter(direction, meetings[k - 1].r), 0.0, 1.0)};
  };
  const auto distance = [&](std::size_t k) { return k == 0 ? 0 : k == meetings.size() + 1 ? r : meetings[k - 1].r; };
  double length = 0;
  for (std::size_t k = 0; k <= meetings.size();) {
    if (!outside[k]) {
      length += distance(k + 1) - distance(k);
      ++k;
      continue;
    }
    std::size_t end = k + 1; // meetings within a gap: a corner, or an island that the ray only touches
    while (end <= meetings.size() && outside[end])
      ++end;
    // Along the boundary is never shorter than straight; rounding may say so where a gap is tiny.
    length += std::max(distance(end) - distance(k), visibility.way(place(k), place(end)));
    k = end;
  }
  return length;
}

struct View::Scratch {
  std::vector<std::size_t> near;
  std::vector<SeenPiece> pieces;
  mutable std::vector<Meeting> meetings;
  mutable std::vector<bool> outside;
};

View::View(const Visibility &visibility) : visibility_(&visibility), scratch_(std::make_unique<Scratch>()) {}
View::~View() = default;
View::View(View &&) noexcept = default;

void View::move_to(const Point2 &from, double reach) {
  from_ = from;
  clear_ = true;
  if (visibility_->convex())
    return;
  const Boundary &boundary = visibility_->boundary();
  boundary.pieces_within(from, reach, scratch_->near);
  if (visibility_->convex_chain(scratch_->near))
    return;
  clear_ = false;
  on_boundary_ = false;
  scratch_->pieces.clear();
  for (const std::size_t i : scratch_->near) {
    scratch_->pieces.emplace_back(boundary.pieces()[i], i, from, boundary.tolerance());
    on_boundary_ = on_boundary_ || boundary.distance(from, i) <= boundary.tolerance();
  }
}

bool View::sees(const Point2 &to) const {
  if (clear_)
    return true;
  const Boundary &boundary = visibility_->boundary();
  const double tolerance = boundary.tolerance();
  const double distance = std::hypot(to[0] - from_[0], to[1] - from_[1]);
  if (distance <= tolerance)
    return true;
  const Point2 direction{(to[0] - from_[0]) / distance, (to[1] - from_[1]) / distance};
  auto &meetings = scratch_->meetings;
  meetings.clear();
  for (std::size_t i = 0; i < scratch_->pieces.size(); ++i)
    scratch_->pieces[i].append(direction, i, meetings);
  std::erase_if(meetings, [&](const Meeting &m) { return m.r >= distance - tolerance; });
  if (meetings.empty() && !on_boundary_)
    return true;
  std::sort(meetings.begin(), meetings.end(), [](const Meeting &a, const Meeting &b) { return a.r < b.r; });
  auto &outside = scratch_->outside;
  outside.clear();
  bool any = false;
  double begin = 0;
  for (std::size_t k = 0; k <= meetings.size(); ++k) {
    const double end = k < meetings.size() ? meetings[k].r : distance;
    const Point2 middle = along(from_, direction, 0.5 * (begin + end));
    // Ways along an edge count as inside.
    outside.push_back(end - begin > tolerance && !boundary.contains(middle) && boundary.pieces_at(middle).empty());
    any = any || outside.back();
    begin = end;
  }
  return !any || way_around(*visibility_, from_, direction, distance, scratch_->pieces, meetings, outside) <=
                     Visibility::largest_detour * distance;
}

} // namespace meshless::domain
