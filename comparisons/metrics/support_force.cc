#include "comparisons/metrics/support_force.h"

#include "comparisons/problems/boundary_foot.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace comparisons::metrics {

namespace {

using problems::Point2;
using problems::Vector2;

/// The weight and its gradient.
class Weight {
public:
  Weight(const problems::PlaneStatement &statement, std::size_t k) {
    for (const auto &region : statement.regions)
      for (const auto &piece : region.boundary) {
        corners_.push_back(piece.begin);
        const auto condition = statement.conditions.find(piece.id);
        if (condition != statement.conditions.end() && condition->second.displacement_prescribed[k])
          pieces_.push_back(&piece);
      }
  }

  bool empty() const { return pieces_.empty(); }

  /// Lets the weight vanish where of these points and the corners of the boundary the distance is largest.
  void reach(std::span<const Point2> points) {
    for (const auto &places : {points, std::span<const Point2>(corners_)})
      for (const auto &x : places)
        reach_ = std::max(reach_, distance(x).value);
  }

  double value(const Point2 &x) const {
    const double s = std::min(distance(x).value / reach_, 1.0);
    return 1 - s * s * s * (10 + s * (6 * s - 15));
  }

  Vector2 gradient(const Point2 &x) const {
    const Distance d = distance(x);
    const double s = d.value / reach_;
    if (s >= 1)
      return {0, 0};
    const double slope = -30 * s * s * (1 - s) * (1 - s) / reach_;
    return {slope * d.gradient[0], slope * d.gradient[1]};
  }

private:
  struct Distance {
    double value;
    Vector2 gradient;
  };

  Distance distance(const Point2 &x) const {
    double sum = 0;  // of 1 / d^2
    Vector2 slope{}; // of (x - foot) / d^4
    for (const auto *piece : pieces_) {
      const Point2 foot = problems::nearest_on(*piece, x);
      const double r1 = x[0] - foot[0], r2 = x[1] - foot[1], square = r1 * r1 + r2 * r2;
      if (square == 0)
        return {0, {0, 0}};
      sum += 1 / square;
      slope[0] += r1 / (square * square);
      slope[1] += r2 / (square * square);
    }
    const double value = 1 / std::sqrt(sum), cube = value * value * value;
    return {value, {cube * slope[0], cube * slope[1]}};
  }

  std::vector<const problems::BoundaryPiece *> pieces_;
  std::vector<Point2> corners_;
  double reach_ = 0;
};

/// int (sigma_kj w,j - b_k w) - int_t t_k w
double extracted(const Weight &weight, std::size_t k, std::span<const double> stress,
                 const problems::PlaneStatement &statement, const std::map<int, problems::BoundaryQuadrature> &boundary,
                 const problems::Quadrature &quadrature) {
  long double force = 0; // the rounding of many terms is not to show in the balance
  const std::size_t n = quadrature.points.size();
  for (std::size_t q = 0; q < n; ++q) {
    const auto [w1, w2] = weight.gradient(quadrature.points[q]);
    force += quadrature.weights[q] * (stress[3 * q + (k == 0 ? 0 : 2)] * w1 + stress[3 * q + (k == 0 ? 2 : 1)] * w2);
  }
  std::vector<Vector2> values;
  if (statement.body_force) {
    values.resize(n);
    statement.body_force(quadrature.points, values);
    for (std::size_t q = 0; q < n; ++q)
      force -= quadrature.weights[q] * values[q][k] * weight.value(quadrature.points[q]);
  }
  for (const auto &[id, points] : boundary) {
    const auto condition = statement.conditions.find(id);
    if (condition == statement.conditions.end() || condition->second.displacement_prescribed[k] ||
        !condition->second.traction)
      continue;
    values.assign(points.points.size(), {});
    condition->second.traction(points.points, points.normals, values);
    for (std::size_t q = 0; q < values.size(); ++q)
      force -= points.weights[q] * values[q][k] * weight.value(points.points[q]);
  }
  return static_cast<double>(force);
}

} // namespace

std::array<std::optional<double>, 2> support_force(const methods::Solution &solution,
                                                   const problems::PlaneStatement &statement,
                                                   const std::map<int, problems::BoundaryQuadrature> &boundary,
                                                   const problems::Quadrature &quadrature) {
  std::vector<double> stress(3 * quadrature.points.size());
  solution.evaluate("stress", quadrature.points, stress);
  std::array<std::optional<double>, 2> force;
  for (std::size_t k = 0; k < 2; ++k)
    if (Weight weight(statement, k); !weight.empty()) {
      weight.reach(quadrature.points);
      force[k] = extracted(weight, k, stress, statement, boundary, quadrature);
    }
  return force;
}

} // namespace comparisons::metrics
