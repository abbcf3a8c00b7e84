#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/study/experiment.h"

#include <memory>
#include <vector>

namespace comparisons::study {

/// The scene asks for the format vtu.
bool wants_fields(const scene::Scene &scene);

/// Plane elastostatics: every method of the table on the same statement, errors on one quadrature a
/// level, displacement and stress along the problem's sample lines.
/// @param methods kept by reference
/// @param with_fields also write the solution on the particles or elements: series "vtu" (for ParaView) and "field"
///   (the same as a table)
std::unique_ptr<Experiment> make_plane_experiment(std::unique_ptr<problems::PlaneProblem> problem,
                                                  const std::vector<methods::Method> &methods,
                                                  bool with_fields = false);

} // namespace comparisons::study
