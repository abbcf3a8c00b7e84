#pragma once

#include "comparisons/methods/solution.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/reports/vtu.h"

#include <vector>

namespace comparisons::study {

/// Particles as points.
reports::FieldGrid grid_of(const std::vector<std::array<double, 2>> &points, const std::vector<int> &regions);

/// Elements of a mesh, every quadrilateral cut into degree x degree parts so that a higher element shows what it has.
/// Elements share no points: stress may jump between them. Curved sides are shown as chords.
reports::FieldGrid grid_of(const problems::Mesh &mesh, int degree);

/// displacement (m), strain (11, 22, 12 of the tensor) and stress (Pa), von_mises (Pa), with an exact solution
/// displacement_error (m) and stress_error (Pa, tensor norm), and the method's own figures.
std::vector<reports::PointField> fields_on(const reports::FieldGrid &grid, const methods::Solution &solution,
                                           const problems::PlaneProblem &problem);

} // namespace comparisons::study
