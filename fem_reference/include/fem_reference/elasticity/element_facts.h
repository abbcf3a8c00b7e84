#pragma once

#include "fem_reference/elasticity/plane_elasticity.h"

#include <cstdint>
#include <vector>

namespace fem_reference::elasticity {
/// What a discretisation by elements is made of and costs, for a comparison with other methods.
struct ElementFacts {
  /// Which nodes couple: those of row i are columns[row_start[i]] ... columns[row_start[i + 1] - 1], sorted, i
  /// included.
  std::vector<std::int64_t> row_start;
  std::vector<std::int64_t> columns;
  std::size_t n_quadrature_points = 0; ///< of the stiffness, all cells together
  double area = 0;                     ///< of all cells, m^2
  double functions_per_point = 0;      ///< that are not zero there, on the average over the quadrature points
  /// Seconds for the shape functions at all quadrature points, cell by cell as at arbitrary points: without the table
  /// that assembly has for them. The second with their gradients in space, through the Jacobian.
  double value_seconds = 0;
  double gradient_seconds = 0;
};

/// Measured on the mesh of a problem with elements of a degree from 1 to 4; seconds are medians of `repeats` runs.
/// Throws InvalidInput as `solve`.
ElementFacts element_facts(const PlaneProblem &problem, int degree, int repeats = 5);

/// |K - K^T| / |K| in the Frobenius norm, of the stiffness without essential conditions. K enters by its products with
/// vectors of random signs, cell by cell from the stress, for the stored matrix has one half only: the mean of
/// (v K u - u K v)^2 over them is |K - K^T|^2, that of (v K u)^2 is |K|^2. Rounding remains for elements, whose K is
/// symmetric. Throws InvalidInput as `solve`.
double symmetry_defect(const PlaneProblem &problem, int degree);
} // namespace fem_reference::elasticity
