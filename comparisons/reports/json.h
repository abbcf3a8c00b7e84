#pragma once

#include "comparisons/reports/results.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>

namespace comparisons::reports {

/// A results file that cannot be read. `path()` is the place as a JSON path ("$.cells[2].status"),
/// empty if the text is no JSON at all.
class ResultsError : public std::runtime_error {
public:
  ResultsError(std::string path, const std::string &message);
  const std::string &path() const { return path_; }

private:
  std::string path_;
};

/// The number of the schema that this program writes and reads.
inline constexpr int results_schema = 1;

/// results.json as described by results.schema.json beside this file. Errors and quantities of a cell that is not
/// ok, and any value that is not finite, become null: what has no meaning is never written as a number.
nlohmann::ordered_json to_json(const Results &results);

/// The text of results.json: two spaces of indentation, a newline at the end. Bytes that are not UTF-8 are replaced.
std::string json_text(const Results &results);

/// The inverse of to_json. A key of the schema that is missing, a value of the wrong type or out of range, an unknown
/// status or another schema throws ResultsError with the JSON path. Keys that are not in the schema are ignored, so
/// that later programs may add some. A null error or quantity becomes NaN, so that it is written as null again.
Results from_json(const nlohmann::ordered_json &json);

/// Parses and converts; a truncated text or one that holds NaN is no JSON and throws ResultsError.
Results parse_results(std::string_view text);

/// Reads a file; messages begin with its name.
Results read_results(const std::filesystem::path &file);

} // namespace comparisons::reports
