#include "comparisons/problems/cloud_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace comparisons::problems {

namespace {

constexpr std::size_t most_faults = 20;

enum class Column { x, y, h, volume, region };
constexpr std::pair<std::string_view, Column> column_names[] = {
    {"x", Column::x}, {"y", Column::y}, {"h", Column::h}, {"volume", Column::volume}, {"region", Column::region}};

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

class CsvReader {
public:
  CsvReader(std::string_view text, const std::string &name) : text_(text), name_(name) {}

  CloudFile read() {
    while (next_line()) {
      if (columns_.empty()) {
        read_names();
        if (columns_.empty())
          break;
      } else
        read_particle();
      if (faults_.size() >= most_faults)
        break;
    }
    if (faults_.empty() && columns_.empty())
      fault(1, "the file holds nothing; its first line names the columns: x, y and, if wanted, h, volume, region");
    if (faults_.empty() && cloud_.positions.empty())
      fault(1, "the file has no particles after its line of names");
    if (faults_.empty())
      check_places();
    if (faults_.empty())
      return std::move(cloud_);
    std::string message;
    for (const auto &line : faults_)
      message += (message.empty() ? "" : "\n") + line;
    throw CloudFileError(message);
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

  void read_names() {
    std::vector<Column> columns;
    for (const Entry &entry : split(line_)) {
      const auto known = std::find_if(std::begin(column_names), std::end(column_names),
                                      [&](const auto &c) { return c.first == entry.text; });
      if (known == std::end(column_names)) {
        double number = 0;
        const bool numeric = parse(entry.text, number);
        fault(entry.column, numeric ? fmt::format("the number {} where the columns are named; write a first line x,y "
                                                  "(and, if wanted, h, volume, region)",
                                                  entry.text)
                                    : fmt::format("the column '{}'; allowed are x, y, h, volume, region", entry.text));
        return;
      }
      if (std::find(columns.begin(), columns.end(), known->second) != columns.end()) {
        fault(entry.column, fmt::format("the column '{}' stands twice", entry.text));
        return;
      }
      columns.push_back(known->second);
    }
    for (const Column needed : {Column::x, Column::y})
      if (std::find(columns.begin(), columns.end(), needed) == columns.end()) {
        fault(1, fmt::format("the column {} is missing; a cloud needs x and y", needed == Column::x ? "x" : "y"));
        return;
      }
    columns_ = columns;
  }

  static bool parse(std::string_view text, double &value) {
    if (text.starts_with('+'))
      text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  }

  void read_particle() {
    const auto entries = split(line_);
    if (entries.size() != columns_.size()) {
      fault(entries.size() > columns_.size() ? entries[columns_.size()].column : line_.size() + 1,
            fmt::format("{} entries; the line of names has {}", entries.size(), columns_.size()));
      return;
    }
    Point2 position{};
    std::size_t place = 1;
    for (std::size_t c = 0; c < entries.size(); ++c) {
      const auto &name = column_names[static_cast<std::size_t>(columns_[c])].first;
      double value = 0;
      if (!parse(entries[c].text, value)) {
        fault(entries[c].column, fmt::format("{} is '{}'; a number such as 0.25 is needed", name, entries[c].text));
        return;
      }
      if (!std::isfinite(value)) {
        fault(entries[c].column, fmt::format("{} is {}; it must be finite", name, entries[c].text));
        return;
      }
      switch (columns_[c]) {
      case Column::x:
        position[0] = value;
        place = entries[c].column;
        break;
      case Column::y:
        position[1] = value;
        break;
      case Column::h:
      case Column::volume:
        if (!(value > 0)) {
          fault(entries[c].column, fmt::format("{} is {}; it must be greater than 0", name, entries[c].text));
          return;
        }
        (columns_[c] == Column::h ? cloud_.spacing : cloud_.volumes).push_back(value);
        break;
      case Column::region:
        if (value < 0 || value > 1e6 || value != std::floor(value)) {
          fault(entries[c].column, fmt::format("region is {}; it is a whole number from 0 on", entries[c].text));
          return;
        }
        cloud_.regions.push_back(static_cast<int>(value));
        break;
      }
    }
    cloud_.positions.push_back(position);
    places_.emplace_back(number_, place);
  }

  /// Two particles of an interface share their place, but not their region.
  void check_places() {
    std::map<std::pair<Point2, int>, std::size_t> known;
    for (std::size_t i = 0; i < cloud_.positions.size() && faults_.size() < most_faults; ++i) {
      const int region = cloud_.regions.empty() ? 0 : cloud_.regions[i];
      const auto [first, is_new] = known.try_emplace({cloud_.positions[i], region}, i);
      if (is_new)
        continue;
      number_ = places_[i].first;
      fault(places_[i].second,
            fmt::format("a particle at ({}, {}), where line {} has one already", cloud_.positions[i][0],
                        cloud_.positions[i][1], places_[first->second].first));
    }
  }

  std::string_view text_;
  const std::string &name_;
  std::size_t at_ = 0;
  std::size_t number_ = 0;
  std::string_view line_;
  std::vector<Column> columns_;
  std::vector<std::pair<std::size_t, std::size_t>> places_; ///< line and column of every particle
  std::vector<std::string> faults_;
  CloudFile cloud_;
};

} // namespace

CloudFile parse_cloud_csv(std::string_view text, const std::string &name) { return CsvReader(text, name).read(); }

CloudFile read_cloud_csv(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || std::filesystem::is_directory(path) || !(text << file.rdbuf()))
    throw CloudFileError(fmt::format("{}:1:1: the file cannot be read, or is empty", path.string()));
  return parse_cloud_csv(text.str(), path.string());
}

std::string cloud_csv(const Cloud &cloud, std::string_view comment) {
  std::string text = comment.empty() ? "" : fmt::format("# {}\n", comment);
  text += cloud.regions.empty() ? "x,y,h\n" : "x,y,h,region\n";
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    text += fmt::format("{},{},{}", cloud.positions[i][0], cloud.positions[i][1], cloud.spacing[i]);
    text += cloud.regions.empty() ? "\n" : fmt::format(",{}\n", cloud.regions[i]);
  }
  return text;
}

} // namespace comparisons::problems
