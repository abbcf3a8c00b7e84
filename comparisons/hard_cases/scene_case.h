#pragma once

#include "comparisons/hard_cases/hard_case.h"
#include "comparisons/reports/results.h"
#include "comparisons/study/catalogue.h"

#include <functional>
#include <map>
#include <string>

namespace comparisons::hard_cases {

/// What `run` gives; where a method's own guards end it, with time, place and reason, that is a refusal.
/// @throws NamedRefusal; what else the method throws
Measurement with_named_ends(const std::function<Measurement()> &run);

/// Runs the scene of this text, one method on one level, with_named_ends.
/// @throws NamedRefusal; std::logic_error for a scene that is not valid; what the method throws
Measurement measure_scene(const study::Catalogue &catalogue, const std::string &text,
                          const std::function<double(const reports::Cell &)> &error);

/// Not a number if there is no value of that name.
double value_of(const std::map<std::string, double> &values, const std::string &name);

// Texts of scenes of the benchmarks; `keys` are of the method, `problem`, `time` and `material` lines of these tables.
std::string bar_scene(const std::string &method, const std::string &keys, const std::string &problem,
                      const std::string &time, int level);
std::string tube_scene(const std::string &method, const std::string &problem, const std::string &material,
                       const std::string &time);
/// @param method "weak1", "fem Q2"
/// @param rest further tables, the level among them
std::string plate_scene(const std::string &method, const std::string &problem, const std::string &rest);

} // namespace comparisons::hard_cases
