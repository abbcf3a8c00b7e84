#pragma once

#include "comparisons/reports/results.h"

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

/// What papers print, settled against what was computed. The file published.toml of a benchmark:
///
///     schema = 1
///     benchmark = "cantilever"
///     source = "Batra & Zhang 2008"     # for every entry that names none
///
///     [[value]]                         # a printed number
///     entry = "Table 2, s11 = s12 = 0"
///     scene = "corner_natural"          # stem of the scene file
///     label = "s11 s12"                 # or method = "strong"; parameters = {support = 3.0}; variant = "jitter=0"
///     level = "31x7"
///     quantity = "displacement_log10_E" # an error or quantity of the cell, n_points, n_dofs, nonzeros, steps,
///                                       # memory_bytes, or "seconds.total" (any phase)
///     published = -1.215
///     tolerance = 0.001                 # or relative_tolerance = 0.05
///     expect = "reproduced"             # | "differs" | "not reproducible", these with a remark
///     remark = "..."
///
///     [[claim]]                         # a printed statement; all conditions must hold
///     entry = "section 4.1"
///     statement = "weak1 has the least error"
///     scene = "scene"                   # scene, variant, level, quantity: for every operand that names none
///     level = "16x4"
///     quantity = "displacement_l2_relative"
///     expect = "holds"                  # | "does not hold", this with a remark
///     left = {label = "weak1"}
///     relation = "<"                    # < <= > >= within
///     right = {label = "weak2"}         # or a number
///     factor = 1.0                      # right is multiplied by it
///     # several conditions: condition = [{left = {...}, relation = "<", right = {...}}, ...] instead
///
/// `within` needs tolerance (absolute) or relative_tolerance (of right). A value or operand may be a change between two
/// cells: `from = {level = "16x4"}` names what differs in the reference cell, `change` is "difference" (value -
/// reference), "relative" (difference / |reference|), "ratio" or "rate" (observed order: log(reference/value) /
/// log(h_reference/h)).
namespace comparisons::ledger {

enum class Change { none, difference, relative, ratio, rate };
enum class Relation { less, less_or_equal, greater, greater_or_equal, within };

/// Picks one cell of a benchmark. An empty text or absent optional matches anything.
struct Selector {
  std::string scene;
  std::string label;
  std::string method;
  std::string level;
  std::optional<std::string> variant;
  /// Parameters that the cell must have with these values; numbers are compared to 1e-12 of their size.
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
};

/// A number taken from the cells.
struct Operand {
  Selector cell;
  std::string quantity;
  Change change = Change::none;
  Selector from; ///< complete; used if change is not none
};

struct Condition {
  Operand left;
  Relation relation = Relation::less;
  std::variant<double, Operand> right = 0.0;
  double factor = 1;
  std::optional<double> tolerance;
  std::optional<double> relative_tolerance;
};

/// One [[value]] or [[claim]].
struct Entry {
  std::string source;
  std::string entry;
  std::string benchmark;
  reports::Kind kind = reports::Kind::value;
  /// The outcome that the file declares; that one is expected and every other is not.
  reports::Verdict expect = reports::Verdict::reproduced;
  std::string remark;
  // of a value
  Operand value;
  double published = 0;
  double tolerance = 0; ///< absolute
  // of a claim
  std::string statement;
  std::vector<Condition> conditions;
};

/// A published.toml that is not valid; the message has one line "file:line:column: ..." for every fault found.
class PublishedError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// Reads and validates; unknown keys, wrong types, missing keys, unknown words and contradictions are faults.
std::vector<Entry> load_published(const std::filesystem::path &path);

/// What to do with an entry whose scene was run but whose cell is not among the results.
enum class MissingCells {
  count_as_missed, ///< it differs (or does not hold), unexpectedly: for the shipped scenes as they are
  leave_out        ///< it is dropped: for runs that asked for less, e.g. with other levels
};

/// Compares the entries with the cells. An entry of a scene that has no cell at all is left out, so that a run of one
/// scene lists only its own. A cell that is missing, ambiguous, not ok or without a finite value of that name counts as
/// missed and unexpected, with the reason as finding. One exception: a cell whose refusal the scene itself declares
/// fits an entry that is expected to be 'not reproducible'. `finding` of a claim says what was measured, condition by
/// condition.
std::vector<reports::Published> settle(const std::vector<Entry> &entries, const std::vector<reports::Cell> &cells,
                                       MissingCells missing = MissingCells::count_as_missed);

} // namespace comparisons::ledger
