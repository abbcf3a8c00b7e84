#pragma once

#include "fem_reference/errors.h"

#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

/// One-dimensional elasticity: a straight rod of unit cross section under axial forces.
namespace fem_reference::rod {

/// Batch callback: fills values[k] at the places points[k] (m).
using Field = std::function<void(std::span<const double> points, std::span<double> values)>;

enum class EndKind { displacement, traction };

/// What is prescribed at an end of the rod: a displacement (m), or a traction (Pa, positive outwards).
struct EndCondition {
  EndKind kind = EndKind::displacement;
  double value = 0;
};

/// -(E u')' = b between the first and the last vertex.
struct Rod {
  /// Ends of the cells, increasing, m; at least two.
  std::vector<double> vertices;
  /// Pa, > 0
  double youngs_modulus = 1;
  /// kg/m^3, > 0; used by `natural_frequencies` alone.
  double density = 1;
  /// Left and right.
  std::array<EndCondition, 2> ends = {};
  /// b in N/m^3; may be empty: then nothing is computed for it.
  Field body_force = {};
};

/// Lumped: M integrated by the Gauss-Lobatto rule of the element's nodes, which makes it diagonal;
/// for linear elements half the mass of a cell at each end.
enum class Mass { lumped, consistent };

struct Options {
  /// 1, 2 or 3: polynomial degree of the elements.
  int degree = 1;
  Mass mass = Mass::lumped;
};

/// Wall-clock seconds by phase.
struct Seconds {
  double mesh = 0;               ///< triangulation
  double degrees_of_freedom = 0; ///< numbering and sparsity pattern
  double assembly = 0;
  double solve = 0;
};

/// Piecewise polynomial displacement; cheap to copy.
class Solution {
public:
  class Implementation;
  explicit Solution(std::shared_ptr<const Implementation> implementation);

  /// Unknowns, prescribed ones included.
  std::size_t n_dofs() const;
  std::size_t nonzeros() const;
  const Seconds &seconds() const;
  /// |K u - f| / (|K| |u| + |f|) in the maximum norm.
  double backward_error() const;

  /// Displacement in m.
  /// @throws InvalidInput for a point outside the rod
  void displacement(std::span<const double> points, std::span<double> values) const;
  /// u'. At a vertex the mean of both cells.
  void strain(std::span<const double> points, std::span<double> values) const;
  /// u'' (1/m) at both ends of every cell: entries 2 k and 2 k + 1 are those of cell k. Zero for linear elements.
  std::vector<double> second_derivatives_at_cell_ends() const;

private:
  std::shared_ptr<const Implementation> implementation_;
};

/// Static displacement by conforming elements with nodes at the Gauss-Lobatto points; the load by
/// degree + 3 Gauss points a cell. With such a load linear elements are exact at their vertices
/// but for the quadrature, whatever the load (Tong 1969). One step of iterative refinement with a residual computed
/// cell by cell from the strain keeps the rounding error near that of the displacement itself.
/// @throws InvalidInput for vertices that do not increase, a degree other than 1 to 3, a material that is
///   not positive, or a rod that may move freely; SolveFailure if the solution is not finite
Solution solve(const Rod &rod, const Options &options = {});

/// The interpolant of a function at the nodes, as a Solution; nothing is solved.
/// @throws InvalidInput as above, or if the function is not finite at a node
Solution interpolate(const std::vector<double> &vertices, const Field &function, int degree);

/// Natural frequencies of K x = omega^2 M x with the prescribed displacements taken as zero.
struct Frequencies {
  /// Increasing, rad/s.
  std::vector<double> omega;
  std::size_t n_dofs = 0;
  std::size_t nonzeros = 0;
  Seconds seconds;
};

/// All of them, by LAPACK's solver for the dense symmetric generalised problem.
/// @throws InvalidInput as `solve`, or if no unknown is free; SolveFailure if LAPACK fails
Frequencies natural_frequencies(const Rod &rod, const Options &options = {});

} // namespace fem_reference::rod
