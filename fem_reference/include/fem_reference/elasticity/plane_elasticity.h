#pragma once

#include "fem_reference/elasticity/material.h"
#include "fem_reference/errors.h"
#include "fem_reference/mesh/plane_mesh.h"

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace fem_reference::elasticity {
using mesh::PlaneMesh;
using mesh::Point; // metres
using Vector = std::array<double, 2>;

/// Batch callback: fills values[k] at points[k], for example a displacement in m or a force in N/m^3.
using VectorField = std::function<void(std::span<const Point> points, std::span<Vector> values)>;

/// Batch callback for a scalar.
using ScalarField = std::function<void(std::span<const Point> points, std::span<double> values)>;

/// As VectorField, with the unit outward normal at each point; values in Pa.
using TractionField =
    std::function<void(std::span<const Point> points, std::span<const Vector> normals, std::span<Vector> values)>;

enum class ConditionKind { displacement, traction };

/// What is prescribed on the edges of one boundary id, component by component.
/// `displacement` is needed where a component is of that kind. An empty `traction` means zero.
struct BoundaryCondition {
  std::array<ConditionKind, 2> kind = {ConditionKind::traction, ConditionKind::traction};
  VectorField displacement = {};
  TractionField traction = {};
};

/// Find u with -div sigma(u) = b in the mesh, u_i given or (sigma n)_i given on each boundary id.
///
/// A node shared by edges of several ids: a component is essential as soon as one of the edges
/// prescribes it; if several do, the lowest id gives the value (PlaneSolution::contradicted_values
/// counts those that differ). Tractions of the other edges act on the components left free.
///
/// Coordinates are shifted to an origin within the mesh before anything is computed, so that a mesh
/// far from the origin loses only what its own coordinates have lost. Callbacks receive, and
/// evaluation expects, the original coordinates.
struct PlaneProblem {
  PlaneMesh mesh;
  /// One for each region of the mesh, all of one plane model. Regions that share nodes are perfectly bonded.
  std::vector<Material> materials;
  /// One condition for each boundary id of the mesh.
  std::map<int, BoundaryCondition> boundary;
  /// N/m^3; may be empty: then nothing is computed for it. Called by several threads at once if set_threads allows.
  VectorField body_force = {};
  /// Free strain by temperature, the same in all directions; may be empty. The stress is then the elastic one less
  /// E / (1 - nu) times it in plane stress, E / (1 - 2 nu) in plane strain.
  ScalarField thermal_strain = {};
};

enum class LinearSolver {
  cholesky, ///< CHOLMOD, supernodal L L^T
  umfpack,  ///< UMFPACK, L U of the full matrix
  multigrid ///< conjugate gradients with geometric multigrid, without a matrix; quadrilaterals only
};

struct Options {
  /// 1 to 4: polynomial degree of displacement and geometry, on triangles and quadrilaterals alike.
  int degree = 2;
  LinearSolver solver = LinearSolver::cholesky;
  /// Steps of iterative refinement with a residual computed cell by cell from the stress. One takes
  /// the time of a substitution and lowers the rounding error, which grows with the condition number
  /// of the matrix, by one to three digits.
  int corrections = 1;
  /// Taylor-Hood elements Q2/Q1, P2/P1: the pressure lambda div u is an unknown, continuous within each region. They do
  /// not lock for nu -> 1/2. Degree 2 and UMFPACK, whatever `solver` says.
  bool mixed = false;
};

/// Wall-clock seconds by phase.
struct Seconds {
  double mesh = 0;               ///< checks and triangulation
  double degrees_of_freedom = 0; ///< numbering, node positions, sparsity pattern
  double assembly = 0;           ///< stiffness, loads, essential data
  double solve = 0;              ///< ordering, factorisation, substitution, residual

  double total() const { return mesh + degrees_of_freedom + assembly + solve; }
};

/// The finite element solution. Cheap to move and to copy (copies share the immutable data).
class PlaneSolution {
public:
  class Implementation;
  explicit PlaneSolution(std::shared_ptr<const Implementation> implementation);

  std::size_t n_cells() const;
  /// Number of unknowns, prescribed ones included.
  std::size_t n_dofs() const;
  /// Entries of the full symmetric matrix, n_dofs() rows; 0 if none was made.
  std::size_t nonzeros() const;
  const Seconds &seconds() const;

  /// ||K u - f||_2 / ||f||_2 after elimination of the essential data. Of multigrid, whose corrections start from the
  /// prescribed displacements continued by zero, over the norm of their residual.
  double relative_residual() const;
  /// Normwise backward error ||K u - f|| / (||K|| ||u|| + ||f||) in the maximum norm: about the
  /// machine precision when the direct solver did all it could. Of multigrid an upper bound of it.
  double backward_error() const;
  /// Estimate of the relative error of the unknowns as a solution of K u = f, in the 2-norm, by tightening: what the
  /// last correction has changed (of an iteration times what it has left of the residual). Of a direct solver that is
  /// an upper bound, since a correction gains a digit or more. Nothing without a correction.
  std::optional<double> algebraic_error() const;
  /// Of an iterative solver, all corrections together; 0 of a direct one.
  int iterations() const;
  /// Nodal components for which boundary ids prescribe different displacements.
  std::size_t contradicted_values() const;

  /// Displacement in m at any points. Both spans have the same length.
  ///
  /// A point on the border of several cells takes the cell of lowest index. A point outside takes the
  /// nearest cell, whose polynomial is continued by at most a quarter of the cell. Cells are those of the
  /// isoparametric geometry: a point between a circle and the polynomial edge that stands for it counts as outside.
  void displacement(std::span<const Point> points, std::span<Vector> values) const;

  /// In-plane stress (sigma_11, sigma_22, sigma_12) in Pa, directly from the strain of the cell that
  /// holds the point (same choice as in `displacement`) and with the material of its region, without smoothing.
  void stress(std::span<const Point> points, std::span<std::array<double, 3>> values) const;

  /// True for Taylor-Hood elements.
  bool has_pressure() const;
  /// p = lambda div u in Pa, positive in tension, the points as in `displacement`. Throws InvalidInput unless
  /// has_pressure().
  void pressure(std::span<const Point> points, std::span<double> values) const;

  /// As `stress`, recovered: in each cell fitted by a polynomial of one degree less at the Gauss points, where it
  /// is superconvergent, extrapolated to the nodes, averaged there over the cells of one region (Hinton & Campbell
  /// 1974), and interpolated by the shape functions. Continuous within a region. The first call computes all nodes.
  void recovered_stress(std::span<const Point> points, std::span<std::array<double, 3>> values) const;

  /// Resultants of the forces that hold the prescribed displacements, by boundary id, N per m of thickness: sums of
  /// the nodal residuals K u - f of the system without essential conditions, over the prescribed components.
  /// A component that several ids prescribe counts for the lowest, which gives its value. With the applied loads
  /// they balance to rounding, on any mesh.
  std::map<int, Vector> reactions() const;
  /// Resultants of the tractions as integrated, by boundary id, of those with a `traction`; N per m.
  const std::map<int, Vector> &applied_tractions() const;
  /// Resultant of the body force as integrated, N per m.
  Vector applied_body_force() const;
  /// Integral of |t_1| + |t_2| and |b_1| + |b_2|, N per m: what resultants compare with.
  double load_magnitude() const;
  /// Half the integral of stress times strain, J per m.
  double strain_energy() const;

  /// How many points of the last evaluation lay outside of all cells, by
  /// more than 1e-10 of a cell.
  std::size_t points_outside() const;

private:
  std::shared_ptr<const Implementation> implementation_;
};

/// Solve by conforming isoparametric elements, Qp on quadrilaterals and Pp on triangles, with nodes at
/// Gauss-Lobatto points on their sides. Stiffness by (p + 1)^2 Gauss points a quadrilateral and the rule of degree
/// 2 p + 1 of Witherden and Vincent (2015) a triangle; loads by one order more. Essential data are interpolated at
/// the nodes and eliminated symmetrically.
///
/// Throws InvalidInput for an invalid mesh, material, degree or boundary condition, including essential
/// conditions that leave rigid motions free; SolveFailure if the factorisation fails.
PlaneSolution solve(const PlaneProblem &problem, const Options &options = {});
} // namespace fem_reference::elasticity
