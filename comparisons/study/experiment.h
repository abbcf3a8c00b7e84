#pragma once

#include "comparisons/methods/cloud_report.h"
#include "comparisons/reports/results.h"
#include "comparisons/scene/scene.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace comparisons::study {

/// Points, unknowns, bytes and seconds to expect of one cell: rough figures, to tell a second from
/// an hour.
struct Estimate {
  double n_points = 0;
  double n_dofs = 0;
  double bytes = 0;
  double seconds = 0;
};

/// A scene's problem with all that a benchmark does with a method: solve, measure, write curves.
class Experiment {
public:
  virtual ~Experiment() = default;

  /// Solves once and fills the cell's counts, seconds and, `with_errors`, its errors, quantities and
  /// (if `series_directory` is not empty) data files in the folder `series` below it.
  /// @throws methods::Refused, reports::OutputError, or any std::exception for a failure
  virtual void run(const scene::MethodRequest &request, const scene::Level &level, bool with_errors,
                   const std::filesystem::path &series_directory, reports::Cell &cell) const = 0;

  /// Looks at the particles of a cell, and assembles a few of its rows; nothing for a cell without particles in the
  /// plane.
  /// @throws std::exception if the basis does not exist
  virtual std::optional<methods::CloudReport> inspect(const scene::MethodRequest & /*request*/,
                                                      const scene::Level & /*level*/) const {
    return {};
  }

  /// Called once before the cells are run, for what all of them share and is dear, such as a reference solution.
  virtual void prepare() const {}

  /// Also makes the points of the level.
  /// @throws std::exception if the level does not fit
  virtual Estimate estimate(const scene::MethodRequest &request, const scene::Level &level) const = 0;

  /// The same with what `inspect` found, which tells more.
  virtual Estimate estimate(const scene::MethodRequest &request, const scene::Level &level,
                            const methods::CloudReport & /*cloud*/) const {
    return estimate(request, level);
  }

  /// Where a long `run` tells how far it is, a line at a time.
  void report_to(std::function<void(const std::string &)> progress) { progress_ = std::move(progress); }

protected:
  const std::function<void(const std::string &)> &progress() const { return progress_; }

private:
  std::function<void(const std::string &)> progress_;
};

/// Path below the results folder for a curve of a cell: "series/<benchmark>-<scene>-...-<name>.csv".
std::string series_file(const reports::Cell &cell, const std::string &name);

} // namespace comparisons::study
