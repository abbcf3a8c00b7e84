#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace comparisons::problems {

/// A table that cannot be used; the message has one line "file:line:column: ..." for every fault, at most twenty.
class CsvError : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// What a table of numbers may hold.
struct CsvFormat {
  std::vector<std::string> needed;
  std::vector<std::string> optional;
  /// What a line is: "particle".
  std::string row;
  /// What the table is, with its article: "a cloud".
  std::string table;
  /// Says what is wrong with a finite number of a column: "it must be greater than 0"; nothing if all is well.
  std::function<std::optional<std::string>(std::string_view column, double value)> check = {};
};

/// Numbers in named columns of one length.
struct CsvTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  /// Line and place in it, from 1, of the first column's entry, for every row.
  std::vector<std::pair<std::size_t, std::size_t>> places;

  std::size_t n_rows() const { return places.size(); }
  /// Empty if the table has no such column.
  std::span<const double> column(std::string_view name) const;
};

/// Reads a line of names and then one line of numbers a row, separated by commas. Lines that are empty or begin with #
/// are passed over.
///
/// @param name stands for the file in messages
/// @throws CsvError for an unknown, missing or repeated column, a line with too few or too many entries, a text that is
///   no number, a number that is not finite or that the format's check refuses, or no rows
CsvTable parse_csv(std::string_view text, const std::string &name, const CsvFormat &format);

/// The whole file. @throws CsvError if it cannot be read
std::string csv_text(const std::filesystem::path &path);

} // namespace comparisons::problems
