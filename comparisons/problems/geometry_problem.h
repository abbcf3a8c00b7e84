#pragma once

#include "comparisons/geometry/plane_geometry.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/geometry_tables.h"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace comparisons::problems {

/// What the files of a scene with a geometry of its own hold, read and checked once.
struct ResolvedGeometry {
  /// The drawing as it is meshed finest without refinement: its boundaries are those of the statement.
  geometry::PlaneGeometry shape;
  /// The mesh of every level of the scene, by the level's text.
  std::map<std::string, Mesh> levels;
  /// The finest of them, from which a reference by finer finite elements is made.
  std::string finest_level;
  PlaneStatement statement;
  /// Empty fields if the reference is to be computed.
  ExactSolution exact;
  /// Particles from a file, for every level; no positions: there is none.
  Cloud cloud;
  /// The file that errors are relative to; empty: there is none.
  std::string reference_file;
  std::vector<SampleLine> lines;
  std::vector<RequestedQuantity> quantities;
  /// Warnings about the geometry, for the report.
  std::vector<std::string> remarks;
};

/// Reads the mesh of a scene with [geometry], holds the names of the scene against it, and makes the problem's parts.
/// Findings, with the place in the scene or the file: unknown groups and regions, regions without material, rigid
/// motions that the conditions leave, prescribed displacements that disagree at a shared corner, expressions that are
/// not finite on their boundary, levels that are too fine.
/// @return null if there is an error among the findings
std::shared_ptr<const ResolvedGeometry> resolve_geometry(const scene::Scene &scene, scene::Diagnostics &diagnostics);

/// Solves a statement on a mesh by finite elements of a degree, "Q3".
using ReferenceSolver =
    std::function<ExactSolution(const PlaneStatement &statement, const Mesh &mesh, const std::string &element)>;

/// The plane elastostatic problem of a geometry of one's own.
class GeometryProblem final : public PlaneProblem {
public:
  /// @param seed of generated clouds
  GeometryProblem(std::shared_ptr<const ResolvedGeometry> geometry, const scene::GeometryTables &tables,
                  std::uint64_t seed, ReferenceSolver solve_reference);

  const PlaneStatement &statement() const override { return geometry_->statement; }
  /// The exact solution, or the finite-element solution on the refined finest mesh, computed at the first call.
  const ExactSolution &exact() const override;
  /// Corners of the level's cells, those on a boundary put on the statement's own pieces; or a generated cloud of as
  /// many particles.
  Cloud cloud(const scene::Level &level) const override;
  Mesh mesh(const scene::Level &level) const override;
  Quadrature quadrature(const scene::Level &level) const override;
  std::vector<SampleLine> sample_lines() const override { return geometry_->lines; }
  std::vector<RequestedQuantity> quantities() const override { return geometry_->quantities; }
  std::vector<std::string> remarks() const override;

private:
  Cloud nodes(const Mesh &mesh) const;
  Cloud generated(const Mesh &mesh, std::size_t n_particles) const;

  std::shared_ptr<const ResolvedGeometry> geometry_;
  bool generated_;
  std::uint64_t seed_;
  std::string element_;
  int refinements_;
  ReferenceSolver solve_reference_;
  mutable ExactSolution computed_;
};

} // namespace comparisons::problems
