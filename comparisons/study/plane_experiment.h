#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/study/experiment.h"

#include <memory>
#include <vector>

namespace comparisons::study {

/// What a scene may ask for beside errors and seconds.
struct PlaneExtras {
  /// The solution on the particles or elements: series "vtu" (for ParaView) and "field" (the same as a table).
  bool fields = false;
  /// What Zhang & Batra 2008, Table 7, compares in words: see method_comparison.h.
  bool facts = false;
};

/// By the scene's formats (vtu) and its [study] (facts).
PlaneExtras extras_of(const scene::Scene &scene);

/// Plane elastostatics: every method of the table on the same statement, errors on one quadrature a
/// level, displacement and stress along the problem's sample lines.
/// @param methods kept by reference
std::unique_ptr<Experiment> make_plane_experiment(std::unique_ptr<problems::PlaneProblem> problem,
                                                  const std::vector<methods::Method> &methods,
                                                  const PlaneExtras &extras = {});

} // namespace comparisons::study
