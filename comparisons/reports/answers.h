#pragma once

#include "comparisons/reports/groups.h"
#include "comparisons/reports/results.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// From measured cells to answers: what an error costs, who is on the front, how fast errors fall. Nothing here
/// extrapolates: where the measurements do not reach there is no number, and a reason instead.
namespace comparisons::reports {

/// The cells of one label within a group, from coarse to fine, failed ones included.
struct MethodSeries {
  std::string label;
  std::string method;
  std::vector<const Cell *> cells;
};

std::vector<MethodSeries> series_of(const Group &group);

/// An error that can be a target: a norm of a difference, or a quantity whose name says that it is an error.
/// Logarithms, slopes and single random seeds are none.
bool is_error_target(std::string_view name);

/// |error| of an ok cell, from its errors or quantities; none if it is zero or not finite.
std::optional<double> target_error(const Cell &cell, std::string_view name);

/// All error targets of a group's ok cells: displacement, stress and stress concentration first, the others by name.
std::vector<std::string> error_targets(const Group &group);

/// Those of them that tables show: displacement, stress and stress concentration in the L2 norm or as a single number
/// where there are such, at most three.
std::vector<std::string> headline_errors(const Group &group);

/// True if a label has more than one level: then the group has answers, otherwise only choices.
bool has_several_levels(const Group &group);

/// Seconds for a target error, or why there are none.
struct Cost {
  std::optional<double> seconds;
  std::string reason;
};

/// Seconds (median of the total) that a series needs for |error| = target: log-log interpolation between the two
/// neighbouring levels around it. None outside of the measured range, for an error that does not fall from level to
/// level, and across a level that failed.
Cost seconds_for_error(const MethodSeries &series, std::string_view error, double target);

/// Targets worth a column: powers of ten that at least one series of the group reaches by interpolation, falling.
std::vector<double> equal_error_targets(const Group &group, std::string_view error);

/// The table of equal errors of all groups: headline errors x targets x labels.
std::vector<EqualError> equal_errors(const Results &results);

/// Ok cells of a group that no other cell beats in both seconds and error, by increasing seconds.
std::vector<const Cell *> pareto_front(const Group &group, std::string_view error);

/// 1 / (error x seconds), 1/s.
std::optional<double> efficiency(const Cell &cell, std::string_view error);
/// 1 / (error x 10^6 bytes of peak memory).
std::optional<double> accuracy_per_megabyte(const Cell &cell, std::string_view error);

/// Slope of log(error) against log(spacing) by least squares over the levels whose error is above rounding; none for
/// fewer than three such levels or if a level is not ok.
std::optional<double> least_squares_rate(const MethodSeries &series, std::string_view error);

/// True for cells of finite elements: what the meshless methods are compared with.
bool is_finite_element(const Cell &cell);
bool is_finite_element(const MethodSeries &series);

} // namespace comparisons::reports
