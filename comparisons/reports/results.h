#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::reports {

/// Seconds of one phase over the repeats.
struct Spread {
  double median = 0;
  double minimum = 0;
  double maximum = 0;
};

/// Names of the phases of `Cell::seconds` in the order of a run; total is the sum of all but evaluation. `setup` is the
/// ordering and the factors of a linear solver that is timed by itself; elsewhere it is part of `solve`.
inline constexpr std::array<const char *, 9> phases{"points", "neighbours", "basis",      "assembly", "setup",
                                                    "solve",  "recovery",   "evaluation", "total"};

enum class Status { ok, refused, failed, limit };

/// A curve or field written beside the results: path relative to the results file.
struct Series {
  std::string name;
  std::string file;
  std::optional<double> time = {}; ///< s, of a state of a run in time; its first column is the place `x`
};

/// Method x level of one scene (and problem variant), with all that was measured.
struct Cell {
  std::string benchmark;
  std::string scene;   ///< name of the scene within the benchmark
  std::string variant; ///< label of the problem variant, often empty
  std::string method;
  std::string label;
  std::string level;
  int dimension = 2; ///< of the domain: 1, 2 or 3
  std::int64_t n_points = 0;
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  Status status = Status::ok;
  std::string reason; ///< why it is not ok; empty otherwise
  /// Findings that do not change the status (points outside, a doubtful condition ...).
  std::vector<std::string> warnings;
  /// Error name -> value; only finite values of cells with status ok are ever written as numbers.
  std::map<std::string, double> errors;
  std::map<std::string, double> quantities;
  /// "method", "ordering", "preconditioner" of the linear solver that was used; empty if none was.
  std::map<std::string, std::string> linear_solver;
  /// Phases by the names of `phases`, in seconds.
  std::map<std::string, Spread> seconds;
  int repeats = 0;
  std::vector<Series> series;
  std::int64_t memory_bytes = 0;
  /// Time steps taken; 0 for a static cell.
  std::int64_t steps = 0;
  /// Status is the one the scene declares.
  bool expected = true;
};

enum class Kind { value, claim };
enum class Verdict { reproduced, differs, not_reproducible, holds, does_not_hold };

/// One line of the ledger: a number or claim printed in a paper beside what was computed.
struct Published {
  std::string source; ///< "Batra & Zhang 2008"
  std::string entry;  ///< "Table 1, choice 3"
  std::string benchmark;
  std::string scene;
  std::string variant;
  std::string method; ///< label of the cell
  std::string level;
  std::string quantity;
  Kind kind = Kind::value;
  std::optional<double> published;
  std::optional<double> computed;
  std::optional<double> tolerance;
  Verdict verdict = Verdict::differs;
  bool expected = false;
  std::string statement; ///< of a claim: what the paper says
  std::string finding;   ///< what was measured for a claim, or why an entry could not be judged
  std::string remark;
};

/// Seconds (or a reason) that a method needs for a target error, interpolated inside the measured range.
struct EqualError {
  std::string benchmark;
  std::string scene;
  std::string variant;
  std::string error;
  double target = 0;
  std::string method; ///< label of the cells
  std::optional<double> seconds;
  std::string reason; ///< why there are no seconds; empty otherwise
};

struct Program {
  std::string name = "petrov";
  std::string version;
  std::string commit;
  std::string build_type;
  std::string flags;
};

struct Machine {
  std::string cpu;
  int cores = 0;
  std::int64_t memory_bytes = 0;
  double load = 0; ///< one-minute load average at the start
  /// The same at the end; the run itself is part of it.
  std::optional<double> load_at_end = std::nullopt;
  std::string blas;
  int threads = 1;
  int simd_lanes = 1;
  std::map<std::string, std::string> libraries; ///< name -> version
  /// Cores that other processes kept busy while the cells ran, on the average; nothing if the system does not tell.
  std::optional<double> competing_cores = std::nullopt;
};

/// Everything one run has to say; results.json is exactly this.
struct Results {
  Program program;
  Machine machine;
  /// Resolved scenes (one object, or an array when several were run).
  nlohmann::ordered_json scene;
  std::vector<std::string> effects_active;
  std::vector<std::string> effects_absent;
  std::vector<Cell> cells;
  std::vector<Published> published;
  std::vector<EqualError> equal_error;
  /// Reasons why timings of this run must not be compared (Debug build, loaded machine); empty if none.
  std::vector<std::string> not_comparable;
  bool interrupted = false;
};

const char *to_text(Status status);
const char *to_text(Kind kind);
const char *to_text(Verdict verdict);

// The inverse; nullopt for an unknown word.
std::optional<Status> status_from_text(std::string_view text);
std::optional<Kind> kind_from_text(std::string_view text);
std::optional<Verdict> verdict_from_text(std::string_view text);

/// A value of `map` that may be shown as a number: finite, and of a cell with status ok.
std::optional<double> reportable(const Cell &cell, const std::map<std::string, double> &map, std::string_view name);
/// Looks in errors, then in quantities.
std::optional<double> reportable(const Cell &cell, std::string_view name);

/// Median seconds of one phase if measured and finite.
std::optional<double> median_seconds(const Cell &cell, std::string_view phase);

/// Largest minus smallest total over its median; none for a cell that was timed once.
std::optional<double> relative_spread(const Cell &cell);

/// A relative spread above this is flagged in reports.
inline constexpr double wide_spread = 0.1;

/// Spacing that a level stands for, for observed rates: "16x4" -> 1/15 (particles along the first side),
/// "0.005 m" -> 0.005, otherwise n_points^(-1/dimension), on a line 1/(n_points - 1). Only ratios between levels of
/// one label have a meaning.
std::optional<double> relative_spacing(const Cell &cell);

} // namespace comparisons::reports
