#pragma once

#include "comparisons/problems/csv_table.h"
#include "comparisons/problems/plane_problem.h"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons::problems {

/// A solution at points, from elsewhere: another code or an experiment.
struct ReferenceFile {
  std::vector<Point2> points;
  std::vector<Vector2> displacement; ///< m
  std::vector<Stress2> stress;       ///< Pa; empty if the file has none
  std::vector<double> weights;       ///< m^2; empty if the file has none
  /// Line and place of every point in the file.
  std::vector<std::pair<std::size_t, std::size_t>> places;
};

/// Reads columns x, y (m), u1, u2 (m) and, if wanted, s11, s22, s12 (Pa; all or none) and weight (m^2, the area that a
/// point stands for).
///
/// @param name stands for the file in messages
/// @throws CsvError as parse_csv, for a stress with components missing, a weight not above 0, or a repeated point
ReferenceFile parse_reference_csv(std::string_view text, const std::string &name);

/// The file as a solution that is known at its points only, in equal parts of `area` if it has no weights.
/// @param regions of the points; empty: all in the first
ExactSolution known_at_points(const ReferenceFile &file, double area, std::vector<int> regions);

} // namespace comparisons::problems
