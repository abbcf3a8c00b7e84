#pragma once

#include "comparisons/methods/cloud_report.h"

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::methods {

/// What one solve took and how it went; read by the study, not by the metrics.
struct SolveRecord {
  std::int64_t n_points = 0; ///< particles or vertices
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
  /// Phases points, neighbours, basis, assembly, solve, in seconds.
  std::map<std::string, double> seconds;
  /// Figures such as backward_error and reciprocal_condition; algebraic_error: an estimate of the error of the solved
  /// system, relative, by tightening.
  std::map<std::string, double> quantities;
  /// "method", "ordering", "preconditioner" of the linear solver, as far as it has them.
  std::map<std::string, std::string> linear_solver;
  std::vector<std::string> warnings;
};

/// Forces on the body by the method's own discrete equations, N per m of thickness: what a method that satisfies
/// equilibrium exactly (finite elements) can say of itself.
struct ForceBalance {
  using Force = std::array<double, 2>;
  /// By boundary id: the support's force where displacement is prescribed, the applied one where traction is.
  std::map<int, Force> boundary;
  Force body{};
};

/// The solution of a method: all that metrics and reports know of it.
class Solution {
public:
  virtual ~Solution() = default;

  /// "displacement" (2 components, m), "stress" (11, 22, 12, Pa) ...
  virtual std::vector<std::string> fields() const = 0;
  virtual std::size_t n_components(std::string_view field) const = 0;

  /// Values at points anywhere in the domain, in one batch.
  /// @param values components of one point together, points.size() x n_components
  /// @throws std::invalid_argument for a field that the solution does not have
  virtual void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                        std::span<double> values) const = 0;

  /// Positions of the particles; empty for a method whose own points are the mesh's.
  virtual std::vector<std::array<double, 2>> own_points() const { return {}; }
  /// Figures at own_points(), such as smoothing_length (m) and n_neighbours, to be shown beside the fields.
  virtual std::map<std::string, std::vector<double>> own_figures() const { return {}; }

  /// How well the particles suit the basis; nothing for a method that has none. Computed at the call.
  virtual std::optional<CloudReport> cloud() const { return {}; }

  /// alpha of the penalty at boundary points, Pa/m: where displacement is prescribed, the discrete equations hold the
  /// body by the traction sigma n - alpha (u - ubar). Nothing: they have no penalty.
  virtual std::vector<double> penalty(std::span<const std::array<double, 2>> points) const {
    (void)points;
    return {};
  }

  /// Nothing: the forces are integrals of the stress over the boundary.
  virtual std::optional<ForceBalance> own_forces() const { return {}; }
  /// J per m of thickness by the method's own quadrature; nothing: an integral of the stress by the quadrature of
  /// the error norms.
  virtual std::optional<double> own_strain_energy() const { return {}; }

  const SolveRecord &record() const { return record_; }

protected:
  SolveRecord record_;
};

} // namespace comparisons::methods
