// Points of VTK files, the legacy text format and XML with data as text.

#include "comparisons/problems/cloud_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

namespace comparisons::problems {

namespace {

/// Words of a text with their places.
class Words {
public:
  Words(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

  [[noreturn]] void fail(const std::string &what) const {
    throw CloudFileError(fmt::format("{}:{}:{}: {}", name_, word_line_, word_column_, what));
  }

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_]))
      advance();
    word_line_ = line_;
    word_column_ = column_;
    const std::size_t begin = at_;
    // A tag ends a number in XML.
    while (at_ < text_.size() && !is_space(text_[at_]) && (text_[at_] != '<' || at_ == begin))
      advance();
    return text_.substr(begin, at_ - begin);
  }

  /// What is left of this line.
  std::string_view rest_of_line() {
    word_line_ = line_;
    word_column_ = column_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != '\n')
      advance();
    std::string_view rest = text_.substr(begin, at_ - begin);
    if (at_ < text_.size())
      advance();
    if (!rest.empty() && rest.back() == '\r')
      rest.remove_suffix(1);
    return rest;
  }

  /// The next word as a finite number.
  double number(std::string_view of) {
    const std::string_view word = next();
    if (word.empty())
      fail(fmt::format("the file ends where {} is expected", of));
    std::string_view digits = word;
    if (digits.starts_with('+'))
      digits.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
      fail(fmt::format("{} is '{}'; a finite number is needed", of, word));
    return value;
  }

  /// The next word as a count; no file holds more numbers than half of its bytes.
  std::size_t count(std::string_view of) {
    const double value = number(of);
    if (value < 0 || value != std::floor(value))
      fail(fmt::format("{} is {}; a whole number from 0 on is needed", of, value));
    if (value > static_cast<double>(text_.size()))
      fail(fmt::format("{} is {}, more than the file of {} bytes can hold", of, value, text_.size()));
    return static_cast<std::size_t>(value);
  }

  /// Moves behind the next occurrence of `what`; false if there is none.
  bool skip_past(std::string_view what) {
    const std::size_t found = text_.find(what, at_);
    if (found == std::string_view::npos)
      return false;
    while (at_ < found + what.size())
      advance();
    return true;
  }

  std::string_view until(char end) {
    word_line_ = line_;
    word_column_ = column_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != end)
      advance();
    return text_.substr(begin, at_ - begin);
  }

  std::size_t place() const { return at_; }
  std::string_view text() const { return text_; }

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void advance() {
    if (text_[at_++] == '\n') {
      ++line_;
      column_ = 1;
    } else
      ++column_;
  }

  std::string_view text_;
  std::string name_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t column_ = 1;
  std::size_t word_line_ = 1;
  std::size_t word_column_ = 1;
};

void read_points(Words &words, std::size_t n, CloudFile &cloud) {
  for (std::size_t i = 0; i < n; ++i) {
    Point2 x{};
    x[0] = words.number(fmt::format("x of point {}", i));
    x[1] = words.number(fmt::format("y of point {}", i));
    const double z = words.number(fmt::format("z of point {}", i));
    if (z != 0)
      words.fail(fmt::format("point {} has z = {}; a plane cloud has z = 0", i, z));
    cloud.positions.push_back(x);
  }
}

/// Takes the values of an array if its name is one of a cloud's, else reads over them.
void read_array(Words &words, std::string_view name, std::size_t n, std::size_t n_components, CloudFile &cloud) {
  const bool wanted = name == "h" || name == "volume" || name == "region";
  if (wanted && n_components != 1)
    words.fail(fmt::format("{} has {} components; it is one number a point", name, n_components));
  if (wanted && n != cloud.positions.size())
    words.fail(fmt::format("{} values of {} for {} points", n, name, cloud.positions.size()));
  if (wanted && (name == "h"        ? !cloud.spacing.empty()
                 : name == "volume" ? !cloud.volumes.empty()
                                    : !cloud.regions.empty()))
    words.fail(fmt::format("the array {} stands twice", name));
  for (std::size_t i = 0; i < n * n_components; ++i) {
    const double value = words.number(fmt::format("{} of point {}", name, i / n_components));
    if (!wanted)
      continue;
    if (name == "region") {
      if (value < 0 || value > 1e6 || value != std::floor(value))
        words.fail(fmt::format("region of point {} is {}; it is a whole number from 0 on", i, value));
      cloud.regions.push_back(static_cast<int>(value));
      continue;
    }
    if (!(value > 0))
      words.fail(fmt::format("{} of point {} is {}; it must be greater than 0", name, i, value));
    (name == "h" ? cloud.spacing : cloud.volumes).push_back(value);
  }
}

CloudFile read_legacy(Words &words) {
  CloudFile cloud;
  words.rest_of_line(); // version
  words.rest_of_line(); // title
  if (const auto form = words.next(); form != "ASCII")
    words.fail(fmt::format("the data are '{}'; only ASCII is read", form));
  bool has_points = false;
  bool of_points = false;
  std::size_t n_values = 0;
  for (auto word = words.next(); !word.empty(); word = words.next()) {
    if (word == "POINTS") {
      if (has_points)
        words.fail("POINTS stands twice");
      const std::size_t n = words.count("the number of points");
      words.next(); // type
      read_points(words, n, cloud);
      has_points = true;
    } else if (word == "POINT_DATA" || word == "CELL_DATA") {
      if (!has_points)
        words.fail("there are no POINTS before this; POLYDATA and UNSTRUCTURED_GRID have them");
      of_points = word == "POINT_DATA";
      n_values = words.count("the number of values");
    } else if (word == "SCALARS" && of_points) {
      const std::string name(words.next());
      const std::string rest(words.rest_of_line());
      std::istringstream type(rest);
      std::string type_name;
      std::size_t n_components = 1;
      type >> type_name >> n_components;
      if (const auto table = words.next(); table != "LOOKUP_TABLE")
        words.fail(fmt::format("'{}' where LOOKUP_TABLE is expected after SCALARS", table));
      words.next();
      read_array(words, name, n_values, type.fail() && !type.eof() ? 1 : std::max<std::size_t>(1, n_components), cloud);
    } else if (word == "FIELD") {
      words.next();
      const std::size_t n_arrays = words.count("the number of arrays");
      for (std::size_t k = 0; k < n_arrays; ++k) {
        const std::string name(words.next());
        const std::size_t n_components = words.count("the number of components");
        const std::size_t n = words.count("the number of values");
        words.next(); // type
        if (n_components > 0 && n > words.text().size() / n_components)
          words.fail("an array that is larger than the file");
        if (of_points)
          read_array(words, name, n, n_components, cloud);
        else
          for (std::size_t i = 0; i < n * n_components; ++i)
            words.next();
      }
    }
    // Everything else, such as cells, is passed over word by word.
  }
  if (!has_points)
    words.fail("there are no POINTS; POLYDATA and UNSTRUCTURED_GRID have them");
  return cloud;
}

std::optional<std::string> attribute(std::string_view tag, const std::string &name) {
  const std::size_t at = tag.find(" " + name + "=\"");
  if (at == std::string_view::npos)
    return {};
  const std::size_t begin = at + name.size() + 3;
  return std::string(tag.substr(begin, tag.find('"', begin) - begin));
}

/// The points of the only piece, and the arrays of its PointData.
CloudFile read_xml(Words &words) {
  CloudFile cloud;
  if (!words.skip_past("<Piece"))
    words.fail("there is no <Piece>; PolyData and UnstructuredGrid have one");
  const std::string piece(words.until('>'));
  const auto count = attribute(" " + piece, "NumberOfPoints");
  if (!count)
    words.fail("<Piece> has no NumberOfPoints");
  std::size_t n = 0;
  const auto [end_of_count, error] = std::from_chars(count->data(), count->data() + count->size(), n);
  if (error != std::errc{} || end_of_count != count->data() + count->size() || n > words.text().size())
    words.fail(fmt::format("NumberOfPoints is '{}', which is no count that the file of {} bytes can hold", *count,
                           words.text().size()));
  const std::string_view text = words.text();
  if (text.find("<Piece", words.place()) != std::string_view::npos)
    words.fail("there are several pieces; only one is read");

  const auto arrays_of = [&](const std::string &section, const auto &take) {
    Words inside = words;
    if (!inside.skip_past("<" + section + ">") && !inside.skip_past("<" + section + " "))
      return false;
    const std::size_t end = text.find("</" + section + ">", inside.place());
    if (end == std::string_view::npos)
      inside.fail(fmt::format("<{}> is not closed", section));
    while (text.find("<DataArray", inside.place()) < end) {
      inside.skip_past("<DataArray");
      const std::string tag(inside.until('>'));
      if (tag.ends_with('/'))
        continue;
      if (const auto format = attribute(tag, "format"); format && *format != "ascii")
        inside.fail(fmt::format("the data are '{}'; only format=\"ascii\" is read", *format));
      inside.skip_past(">");
      take(inside, tag);
    }
    return true;
  };
  bool has_points = false;
  arrays_of("Points", [&](Words &inside, const std::string &) {
    if (!has_points)
      read_points(inside, n, cloud);
    has_points = true;
  });
  if (!has_points)
    words.fail("there are no <Points>");
  arrays_of("PointData", [&](Words &inside, const std::string &tag) {
    const std::string name = attribute(tag, "Name").value_or("");
    if (name == "h" || name == "volume" || name == "region")
      read_array(inside, name, n, attribute(tag, "NumberOfComponents").value_or("1") == "1" ? 1 : 2, cloud);
  });
  return cloud;
}

} // namespace

CloudFile parse_cloud_vtk(std::string_view text, const std::string &name) {
  Words words(text, name);
  CloudFile cloud;
  if (text.starts_with("# vtk DataFile"))
    cloud = read_legacy(words);
  else if (text.find("<VTKFile") < 1000)
    cloud = read_xml(words);
  else
    words.fail("neither a legacy VTK file (its first line begins with '# vtk DataFile') nor XML with <VTKFile>");
  if (cloud.positions.empty())
    words.fail("the file has no points");
  std::map<std::pair<Point2, int>, std::size_t> known;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
    const auto [first, is_new] =
        known.try_emplace({cloud.positions[i], cloud.regions.empty() ? 0 : cloud.regions[i]}, i);
    if (!is_new)
      words.fail(fmt::format("points {} and {} are both at ({}, {})", first->second, i, cloud.positions[i][0],
                             cloud.positions[i][1]));
  }
  return cloud;
}

CloudFile read_cloud_vtk(const std::filesystem::path &path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (!file || std::filesystem::is_directory(path) || !(text << file.rdbuf()))
    throw CloudFileError(fmt::format("{}:1:1: the file cannot be read, or is empty", path.string()));
  return parse_cloud_vtk(text.str(), path.string());
}

} // namespace comparisons::problems
