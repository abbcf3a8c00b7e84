#pragma once

#include "comparisons/scene/scene.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons::problems {

using Point2 = std::array<double, 2>;
using Vector2 = std::array<double, 2>;
/// Components 11, 22, 12.
using Stress2 = std::array<double, 3>;

/// Batch callbacks: values at points, SI.
using VectorField = std::function<void(std::span<const Point2>, std::span<Vector2>)>;
using StressField = std::function<void(std::span<const Point2>, std::span<Stress2>)>;
using TractionField =
    std::function<void(std::span<const Point2>, std::span<const Vector2> normals, std::span<Vector2>)>;

struct Material {
  double youngs_modulus = 0; ///< Pa
  double poisson_ratio = 0;
  bool plane_strain = false;
};

/// Straight piece of the boundary, the domain to its left.
struct BoundaryPiece {
  Point2 begin;
  Point2 end;
  int id = 0;
  std::string name; ///< "left"
};

/// What is prescribed on one boundary id, per component.
struct BoundaryCondition {
  std::array<bool, 2> displacement_prescribed{};
  VectorField displacement;
  TractionField traction; ///< empty: zero
};

/// A corner that a scene may name ("NE").
struct Corner {
  std::string name;
  Point2 position;
};

/// All that a method gets to see of a plane elastostatic problem: the mathematical statement. The
/// exact solution is in it only as boundary data and body force.
struct PlaneStatement {
  std::vector<BoundaryPiece> boundary;
  std::map<int, BoundaryCondition> conditions;
  Material material;
  /// N/m^3; empty unless the scene calls for the effect body_force.
  VectorField body_force;
  /// L of the penalty alpha = penalty E0 / L, m.
  double characteristic_length = 1;
  std::vector<Corner> corners;
};

/// A cloud of particles of one level.
struct Cloud {
  std::vector<Point2> positions;
  /// Nominal distance of neighbours at every particle, m.
  std::vector<double> spacing;
};

/// A mesh of quadrilaterals of one level, counter-clockwise.
struct Mesh {
  struct Edge {
    std::array<unsigned, 2> vertices;
    int id;
  };
  std::vector<Point2> vertices;
  std::vector<std::array<unsigned, 4>> cells;
  std::vector<Edge> boundary;
};

/// Points and weights (m^2) over the domain: the one quadrature of all error norms of a level.
struct Quadrature {
  std::vector<Point2> points;
  std::vector<double> weights;
};

/// The exact solution, for metrics and boundary data.
struct ExactSolution {
  VectorField displacement; ///< m
  StressField stress;       ///< Pa
};

/// A curve along which displacement or stress is compared and written as data.
struct SampleLine {
  std::string name; ///< "bottom"
  std::vector<Point2> points;
  /// Coordinate axis that runs along it.
  int axis = 0;
};

/// A scene's plane elastostatic problem: statement, discretisations, exact solution, sample lines.
class PlaneProblem {
public:
  virtual ~PlaneProblem() = default;

  virtual const PlaneStatement &statement() const = 0;
  virtual const ExactSolution &exact() const = 0;
  virtual Cloud cloud(const scene::Level &level) const = 0;
  virtual Mesh mesh(const scene::Level &level) const = 0;
  virtual Quadrature quadrature(const scene::Level &level) const = 0;
  virtual std::vector<SampleLine> sample_lines() const = 0;
  /// Component of the displacement whose largest error is reported, and the line where it is sought.
  struct LargestError {
    std::string quantity; ///< "u2_max_relative"
    int component = 0;
    std::string line;
  };
  virtual std::optional<LargestError> largest_error() const { return {}; }
};

} // namespace comparisons::problems
