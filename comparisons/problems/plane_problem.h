#pragma once

#include "comparisons/scene/scene.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
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
using ScalarValues = std::function<void(std::span<const Point2>, std::span<double>)>;
using TractionField =
    std::function<void(std::span<const Point2>, std::span<const Vector2> normals, std::span<Vector2>)>;

struct Material {
  double youngs_modulus = 0; ///< Pa
  double poisson_ratio = 0;
  bool plane_strain = false;
  double density = 0; ///< kg/m^3; 0 where nothing moves
};

/// Circle that a curved piece lies on, and the sense in which the piece runs around it.
struct Arc {
  Point2 centre;
  bool counter_clockwise = true;
};

/// Line or circular arc of the boundary of a region, the region to its left.
struct BoundaryPiece {
  Point2 begin;
  Point2 end;
  int id = 0;
  std::string name; ///< "left"
  std::optional<Arc> arc = {};
};

/// The id of pieces between two regions; there is no condition on them: the regions are bonded.
inline constexpr int interface_id = -1;

/// Part of the domain that is of one material. Its boundary is closed loops, counter-clockwise outside, clockwise
/// around holes; what it shares with another region stands in both, in opposite directions, with interface_id.
struct Region {
  std::string name; ///< "steel"; empty if there is only one
  Material material;
  std::vector<BoundaryPiece> boundary;
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
  /// At least one.
  std::vector<Region> regions;
  /// By boundary id.
  std::map<int, BoundaryCondition> conditions;
  /// N/m^3; empty unless the scene calls for the effect body_force.
  VectorField body_force;
  /// Expansion coefficient times temperature; empty unless the scene calls for the effect thermal_expansion.
  ScalarValues thermal_strain = {};
  /// L of the penalty alpha = penalty E0 / L, m.
  double characteristic_length = 1;
  std::vector<Corner> corners;
};

/// A cloud of particles of one level.
struct Cloud {
  std::vector<Point2> positions;
  /// Nominal distance of neighbours at every particle, m.
  std::vector<double> spacing;
  /// Region of every particle; empty: all in the first. A particle on an interface stands once for each region.
  std::vector<int> regions = {};
  /// True for a grid with one spacing: methods may then take the papers' parameters as defaults.
  bool regular = false;
};

/// A mesh of triangles and quadrilaterals of one level, counter-clockwise.
struct Mesh {
  struct Cell {
    std::array<unsigned, 4> vertices;
    unsigned n_vertices = 4; ///< 3 or 4
    int region = 0;
  };
  /// A boundary edge; with a centre it is the shorter arc around it.
  struct Edge {
    std::array<unsigned, 2> vertices;
    int id;
    std::optional<Point2> arc_centre = {};
  };
  /// An edge, inside or on the boundary, that a mesh file gives as the parabola through three points.
  struct CurvedEdge {
    std::array<unsigned, 2> vertices;
    Point2 midpoint;
  };
  std::vector<Point2> vertices; ///< corners of cells only
  std::vector<Cell> cells;
  std::vector<Edge> boundary;
  std::vector<CurvedEdge> curved_edges = {};
};

/// Points and weights (m^2) over the domain: the one quadrature of all error norms of a level.
struct Quadrature {
  std::vector<Point2> points;
  std::vector<double> weights;
  /// Region of every point; empty: all in the first.
  std::vector<int> regions = {};
};

/// The exact solution, for metrics and boundary data, or the best substitute there is (a finer finite-element
/// solution, a file); empty fields if there is none: errors are then not reported.
struct ExactSolution {
  VectorField displacement; ///< m
  StressField stress;       ///< Pa
  /// A solution from a file is known at these points only; null: everywhere.
  std::shared_ptr<const Quadrature> only_at = {};
};

/// A curve along which displacement or stress is compared and written as data.
struct SampleLine {
  std::string name; ///< "bottom"
  std::vector<Point2> points;
  /// Coordinate axis that runs along it.
  int axis = 0;
};

/// A figure of interest beside the error norms.
struct RequestedQuantity {
  enum class Kind {
    displacement,      ///< component 0, 1, or 2 for the magnitude, at `point`
    stress,            ///< component 0 (11), 1 (22), 2 (12), 3 (von Mises) at `point`
    largest_von_mises, ///< over the points of the error quadrature
    reaction,          ///< component 0, 1 of the force on boundary `id`, N per m of thickness
    strain_energy,     ///< J per m of thickness
  };
  std::string name; ///< "stress_concentration_factor"
  Kind kind = Kind::displacement;
  int component = 0;
  Point2 point{};
  int id = 0;
  /// The value is divided by this: sigma0 makes a concentration factor of a stress.
  double scale = 1;
  /// What it should be, after the division; `<name>_error` is then reported, relative to it.
  std::optional<double> reference = {};
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
  virtual std::vector<RequestedQuantity> quantities() const { return {}; }
  /// What a reader of any result must know: how the geometry was taken, what the reference is.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Errors of one component of the displacement, besides the norms of all methods.
  struct ComponentError {
    enum class Kind {
      largest_relative, ///< largest error over the largest exact value
      largest,          ///< largest error, m
      l2,               ///< square root of the integral of the squared error along the line, m^1.5
    };
    std::string quantity; ///< "u2_max_relative"
    int component = 0;
    std::string line; ///< of sample_lines(); empty: the points of the error quadrature
    Kind kind = Kind::largest_relative;
  };
  virtual std::vector<ComponentError> component_errors() const { return {}; }
};

} // namespace comparisons::problems
