#pragma once

#include "comparisons/reports/groups.h"

#include <array>
#include <string>
#include <vector>

namespace comparisons::reports {

/// A curve of a figure: the levels of one label.
struct Curve {
  std::string label;
  std::size_t style = 0; ///< colour, marker and dash; the same for a label in all figures of a group
  std::vector<std::array<double, 2>> points;
  std::vector<std::string> names; ///< of the points: levels
};

/// A cell that has no place in the figure, and why.
struct NotDrawn {
  std::string label;
  std::size_t style = 0;
  std::string level;
  std::string reason; ///< "refused: singular moment matrix ..."
};

/// A figure on logarithmic axes.
struct Plot {
  std::string name; ///< for file names: "cantilever-convergence-displacement_l2_relative-cost"
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  std::vector<NotDrawn> not_drawn;
};

/// Error against seconds, for the headline errors of a group; empty where fewer than two cells have both.
std::vector<Plot> cost_plots(const Group &group);

/// Error against spacing, for groups with several levels.
std::vector<Plot> convergence_plots(const Group &group);

/// "cantilever-convergence-jitter_0.25", fit for a file's name.
std::string file_stem(const Group &group);

/// Ticks of a logarithmic axis that spans [lower, upper]: powers of ten, with 2 and 5 between if there would be fewer
/// than three.
std::vector<double> logarithmic_ticks(double lower, double upper);

/// "1e-05", "0.01", "50".
std::string tick_text(double value);

} // namespace comparisons::reports
