#pragma once

#include "comparisons/hard_cases/hard_case.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace comparisons::hard_cases {

enum class CellVerdict {
  holds,    ///< the error is within the case's threshold
  degrades, ///< above it: said by a warning, or not above `silent_error`
  refused,  ///< the method says by name what it cannot do
  fails,    ///< a crash, a hang, no number, or an error above `silent_error` without a warning
};

/// A relative error above this must not be reported without a warning.
inline constexpr double silent_error = 0.1;

struct MatrixCell {
  std::string family;
  std::string name;
  std::string method;
  CellVerdict verdict = CellVerdict::fails;
  std::optional<double> error;
  std::optional<double> value;
  double threshold = 0;
  std::string reason; ///< why refused or failed
  std::vector<std::string> warnings;
  std::map<std::string, double> indicators;
  double seconds = 0;
};

struct Selection {
  std::vector<std::string> cases;   ///< parts of "family: name"; empty: all
  std::vector<std::string> methods; ///< parts of labels; empty: all
  bool quick = false;               ///< leave out cases that are not quick
};

/// The cases that a selection leaves, with the methods that it leaves.
std::vector<HardCase> select(std::vector<HardCase> cases, const Selection &selection);

/// Seconds of a cell against a hang; with the address sanitizer the same work takes some thirty times as long.
#ifdef __SANITIZE_ADDRESS__
inline constexpr double seconds_of_a_cell = 1800;
#else
inline constexpr double seconds_of_a_cell = 60;
#endif

struct MatrixOptions {
  double max_seconds = seconds_of_a_cell;
  std::function<bool()> stop_requested;
  std::function<void(const std::string &)> progress;
};

/// Runs one in a child process of its own, so that a crash or a hang ends that cell alone.
/// @return none if a stop was requested
std::optional<MatrixCell> run_cell(const HardCase &hard_case, const std::string &method, const MatrixOptions &options);

/// Runs every case x method, as far as no stop is requested.
std::vector<MatrixCell> run_matrix(const std::vector<HardCase> &cases, const MatrixOptions &options);

/// What a method's outcome is worth: see CellVerdict.
CellVerdict judge(const HardCase &hard_case, const Measurement &measurement);

const char *to_text(CellVerdict verdict);
std::map<std::string, int> counts(const std::vector<MatrixCell> &cells);

/// A line for every cell, grouped by family and case, then the reasons and the counts.
std::string text_report(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells);
nlohmann::ordered_json json_report(const std::vector<HardCase> &cases, const std::vector<MatrixCell> &cells);
/// The table of cases: what each is, its reference, its threshold and why.
std::string list_text(const std::vector<HardCase> &cases);

} // namespace comparisons::hard_cases
