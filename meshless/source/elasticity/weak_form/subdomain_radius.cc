#include "subdomain_radius.h"

#include <algorithm>
#include <stdexcept>

namespace meshless::elasticity::weak_form {

namespace {

/// A piece is across the domain if the way to it along the boundary is longer than this times the straight one.
constexpr double across = 2;

} // namespace

double shrunk_radius(const domain::Visibility &visibility, const Point2 &centre, double radius,
                     const std::vector<std::size_t> &own) {
  const auto &boundary = visibility.boundary();
  thread_local std::vector<std::size_t> near;
  boundary.pieces_within(centre, radius, near);
  double result = radius;
  for (const std::size_t i : near) {
    const double distance = boundary.distance(centre, i);
    if (distance >= result || distance <= boundary.tolerance())
      continue;
    if (own.empty()) {
      result = distance;
      continue;
    }
    const auto &piece = boundary.pieces()[i];
    const double t = piece.nearest(centre);
    const Point2 x = piece.point(t);
    const domain::Visibility::Place here{own[0], boundary.pieces()[own[0]].nearest(centre)};
    if (visibility.way(here, {i, t}) > across * distance &&
        boundary.contains({0.5 * (centre[0] + x[0]), 0.5 * (centre[1] + x[1])}))
      result = distance;
  }
  return result;
}

void require_shrinkable(Subdomains subdomains, const cloud::Particles<2> &particles) {
  if (subdomains == Subdomains::shrunk && particles.has_flattenings())
    throw std::invalid_argument("subdomains that are ellipses are not shrunk: leave them whole");
}

} // namespace meshless::elasticity::weak_form
