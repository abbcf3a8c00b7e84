#include "meshless/elasticity/plane_problem.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::elasticity {

void PlaneProblem::check() const {
  std::array<bool, 2> fixed{};
  for (const auto &piece : boundary.pieces()) {
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
  if (!fixed[0] || !fixed[1])
    throw std::invalid_argument("the body can move freely: no boundary fixes both u1 and u2");
}

void PlaneProblem::require_inside(std::span<const Point2> particles) const {
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (!boundary.contains(particles[i]) && boundary.pieces_at(particles[i]).empty())
      throw std::invalid_argument(fmt::format("particle {} at ({:.6g}, {:.6g}) lies outside of the domain", i,
                                              particles[i][0], particles[i][1]));
}

} // namespace meshless::elasticity
