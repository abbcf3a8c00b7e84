#include "comparisons/problems/csv_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>

namespace comparisons::problems {

namespace {

constexpr std::size_t most_faults = 20;

/// One entry between commas, without the spaces around it.
struct Entry {
  std::string_view text;
  std::size_t column; ///< place of its first character in the line, from 1
};

std::vector<Entry> split(std::string_view line) {
  std::vector<Entry> entries;
  for (std::size_t begin = 0;;) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin;
    std::size_t last = end;
    while (first < last && (line[first] == ' ' || line[first] == '\t'))
      ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t'))
      --last;
    entries.push_back({line.substr(first, last - first), first + 1});
    if (end == line.size())
      return entries;
    begin = end + 1;
  }
}

bool parse(std::string_view text, double &value) {
  if (text.starts_with('+'))
    text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size();
}

bool holds(const std::vector<std::string> &names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

class Reader {
public:
  Reader(std::string_view text, const std::string &name, const CsvFormat &format)
      : text_(text), name_(name), format_(format) {}

  CsvTable read() {
    while (next_line() && faults_.size() < most_faults) {
      if (!table_.names.empty())
        read_row();
      else if (!read_names())
        break;
    }
    if (faults_.empty() && table_.names.empty())
      fault(1, fmt::format("the file holds nothing; its first line names the columns: {} and, if wanted, {}",
                           fmt::join(format_.needed, ", "), fmt::join(format_.optional, ", ")));
    if (faults_.empty() && table_.n_rows() == 0)
      fault(1, fmt::format("the file has no {}s after its line of names", format_.row));
    if (!faults_.empty())
      throw CsvError(fmt::format("{}", fmt::join(faults_, "\n")));
    return std::move(table_);
  }

private:
  /// The next line with something on it.
  bool next_line() {
    while (at_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', at_), text_.size());
      line_ = text_.substr(at_, end - at_);
      at_ = end + 1;
      ++number_;
      if (!line_.empty() && line_.back() == '\r')
        line_.remove_suffix(1);
      if (number_ == 1 && line_.starts_with("\xef\xbb\xbf"))
        line_.remove_prefix(3);
      const std::size_t first = line_.find_first_not_of(" \t");
      if (first != std::string_view::npos && line_[first] != '#')
        return true;
    }
    return false;
  }

  void fault(std::size_t column, const std::string &what) {
    faults_.push_back(fmt::format("{}:{}:{}: {}", name_, std::max<std::size_t>(1, number_), column, what));
  }

  bool read_names() {
    std::vector<std::string> names;
    for (const Entry &entry : split(line_)) {
      if (!holds(format_.needed, entry.text) && !holds(format_.optional, entry.text)) {
        double number = 0;
        fault(entry.column,
              parse(entry.text, number)
                  ? fmt::format("the number {} where the columns are named; write a first line {} (and, if wanted, {})",
                                entry.text, fmt::join(format_.needed, ","), fmt::join(format_.optional, ", "))
                  : fmt::format("the column '{}'; allowed are {}, {}", entry.text, fmt::join(format_.needed, ", "),
                                fmt::join(format_.optional, ", ")));
        return false;
      }
      if (holds(names, entry.text)) {
        fault(entry.column, fmt::format("the column '{}' stands twice", entry.text));
        return false;
      }
      names.emplace_back(entry.text);
    }
    for (const auto &needed : format_.needed)
      if (!holds(names, needed)) {
        fault(1, fmt::format("the column {} is missing; {} needs {}", needed, format_.table,
                             fmt::join(format_.needed, ", ")));
        return false;
      }
    table_.columns.resize(names.size());
    table_.names = std::move(names);
    return true;
  }

  void read_row() {
    const auto entries = split(line_);
    const std::size_t n = table_.names.size();
    if (entries.size() != n) {
      fault(entries.size() > n ? entries[n].column : line_.size() + 1,
            fmt::format("{} entries; the line of names has {}", entries.size(), n));
      return;
    }
    std::vector<double> values(n);
    for (std::size_t c = 0; c < n; ++c) {
      const auto &[text, column] = entries[c];
      const auto &name = table_.names[c];
      if (!parse(text, values[c])) {
        fault(column, fmt::format("{} is '{}'; a number such as 0.25 is needed", name, text));
        return;
      }
      if (!std::isfinite(values[c])) {
        fault(column, fmt::format("{} is {}; it must be finite", name, text));
        return;
      }
      if (const auto wrong = format_.check ? format_.check(name, values[c]) : std::nullopt) {
        fault(column, fmt::format("{} is {}; {}", name, text, *wrong));
        return;
      }
    }
    for (std::size_t c = 0; c < n; ++c)
      table_.columns[c].push_back(values[c]);
    table_.places.emplace_back(number_, entries.front().column);
  }

  std::string_view text_;
  const std::string &name_;
  const CsvFormat &format_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
  std::string_view line_;
  std::vector<std::string> faults_;
  CsvTable table_;
};

} // namespace

std::span<const double> CsvTable::column(std::string_view name) const {
  for (std::size_t c = 0; c < names.size(); ++c)
    if (names[c] == name)
      return columns[c];
  return {};
}

CsvTable parse_csv(std::string_view text, const std::string &name, const CsvFormat &format) {
  return Reader(text, name, format).read();
}

std::string csv_text(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || std::filesystem::is_directory(path) || !(text << file.rdbuf()))
    throw CsvError(fmt::format("{}:1:1: the file cannot be read, or is empty", path.string()));
  return text.str();
}

} // namespace comparisons::problems
