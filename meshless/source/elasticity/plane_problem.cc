#include "meshless/elasticity/plane_problem.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace meshless::elasticity {

namespace {

bool same_place(const Point2 &a, const Point2 &b, double tolerance) {
  return std::hypot(a[0] - b[0], a[1] - b[1]) <= tolerance;
}

} // namespace

void PlaneProblem::check(bool may_move) const {
  if (regions.empty())
    throw std::invalid_argument("the problem has no region");
  std::array<bool, 2> fixed{};
  for (const auto &region : regions)
    for (const auto &piece : region.boundary.pieces()) {
      if (piece.id == interface_id)
        continue;
      const auto found = conditions.find(piece.id);
      if (found == conditions.end())
        throw std::invalid_argument(fmt::format("boundary {} has no condition", piece.id));
      for (int k = 0; k < 2; ++k)
        if (found->second.kind[k] == ConditionKind::displacement) {
          fixed[k] = true;
          if (!found->second.displacement)
            throw std::invalid_argument(fmt::format("boundary {} prescribes no displacement field", piece.id));
        }
    }
  if (!may_move && (!fixed[0] || !fixed[1]))
    throw std::invalid_argument("the body can move freely: no boundary fixes both u1 and u2");
  Interfaces{regions};
}

void PlaneProblem::require_inside(const cloud::Particles<2> &particles) const {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Point2 &x = particles.position(i);
    const auto region = static_cast<std::size_t>(particles.region(i));
    if (region >= regions.size())
      throw std::invalid_argument(
          fmt::format("particle {} is of region {}, but there are only {}", i, region, regions.size()));
    const auto &boundary = regions[region].boundary;
    if (!boundary.contains(x) && boundary.pieces_at(x).empty())
      throw std::invalid_argument(fmt::format("particle {} at ({:.6g}, {:.6g}) lies outside of the {}", i, x[0], x[1],
                                              regions.size() == 1 ? "domain" : fmt::format("region {}", region)));
  }
}

Interfaces::Interfaces(std::span<const Region> regions) {
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto pieces = regions[r].boundary.pieces();
    for (std::size_t p = 0; p < pieces.size(); ++p) {
      if (pieces[p].id != interface_id)
        continue;
      const auto &piece = pieces[p];
      const double tolerance = regions[r].boundary.tolerance();
      bool found = false;
      for (std::size_t s = 0; s < regions.size() && !found; ++s) {
        if (s == r)
          continue;
        // A piece that is near the middle of this one, not all of them.
        for (const std::size_t q : regions[s].boundary.pieces_at(piece.point(0.5))) {
          const auto &other = regions[s].boundary.pieces()[q];
          if (other.id != interface_id || !same_place(other.begin, piece.end, tolerance) ||
              !same_place(other.end, piece.begin, tolerance))
            continue;
          const double own = regions[r].material.plane_modulus();
          const double others = regions[s].material.plane_modulus();
          sides_[{r, p}] = {s, q, own < others || (own == others && r < s)};
          found = true;
        }
      }
      if (!found)
        throw std::invalid_argument(fmt::format(
            "the interface from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) of region {} has no counterpart in another region",
            piece.begin[0], piece.begin[1], piece.end[0], piece.end[1], r));
    }
  }
}

} // namespace meshless::elasticity
