#include "comparisons/geometry/mesh_file.h"
#include "comparisons/geometry/mesh_scanner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <span>
#include <vector>

namespace comparisons::geometry {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30;

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  return first == std::string_view::npos ? std::string_view{}
                                         : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The words of a line.
std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  while (!(line = trimmed(line)).empty()) {
    const auto end = std::min(line.find_first_of(" \t"), line.size());
    result.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return result;
}

template <typename T>
std::optional<T> number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

/// Walks through the sections of a .msh file; throws StructureError at the first fault.
class MeshStructure {
public:
  explicit MeshStructure(std::string_view bytes) : scan_(bytes) {}

  void check() {
    read_format();
    bool nodes = false;
    bool elements = false;
    while (!scan_.at_end()) {
      const unsigned line = scan_.line();
      const auto name = trimmed(scan_.read_line());
      if (name.empty())
        continue;
      if (!name.starts_with('$'))
        fail(line, fmt::format("expected a section such as $Nodes, found {}", scene::in_quotes(name)));
      const std::string section(name.substr(1));
      nodes = nodes || section == "Nodes";
      elements = elements || section == "Elements";
      read_section(section, line);
    }
    if (!nodes || !elements)
      fail(0,
           fmt::format("the file has no section ${}: it is truncated or holds no mesh", nodes ? "Elements" : "Nodes"),
           "mesh the drawing in Gmsh (Mesh, 2D) and save it again");
  }

private:
  [[noreturn]] static void fail(unsigned line, std::string message, std::string suggestion = {}) {
    throw StructureError{line, std::move(message), std::move(suggestion)};
  }

  void read_format() {
    std::string_view first;
    unsigned line = 1;
    while (first.empty() && !scan_.at_end()) {
      line = scan_.line();
      first = trimmed(scan_.read_line());
    }
    if (first != "$MeshFormat")
      fail(line, fmt::format("no Gmsh mesh: it begins with {}, not with $MeshFormat", scene::in_quotes(first)),
           "name a .msh file saved by Gmsh, or a .geo drawing");
    line = scan_.line();
    const auto format = words(scan_.read_line());
    const std::string version(format.empty() ? "" : format[0]);
    if (format.size() != 3 || (version != "2.2" && version != "4.1"))
      fail(line, fmt::format("mesh format {}; versions 2.2 and 4.1 are taken", scene::in_quotes(version)),
           "save it with Gmsh as version 4.1: gmsh FILE -save -format msh41");
    version_ = version == "2.2" ? 2 : 4;
    binary_ = format[1] == "1";
    if ((format[1] != "0" && format[1] != "1") || format[2] != "8")
      fail(line, fmt::format("file type {} with numbers of {} bytes; 0 (text) or 1 (binary) with 8 are taken",
                             scene::in_quotes(format[1]), scene::in_quotes(format[2])));
    if (binary_ && scan_.read_binary<std::int32_t>().value_or(0) != 1)
      fail(line, "a binary mesh of another byte order", "save it as text on the machine that wrote it");
    if (!scan_.skip_to("$EndMeshFormat"))
      fail(line, "$MeshFormat has no $EndMeshFormat: the file is truncated");
    scan_.read_line();
  }

  void read_section(const std::string &name, unsigned line) {
    const std::string end = "$End" + name;
    // Parallel partitions and the like are Gmsh's business; these three decide what a file can hold.
    if (name == "Nodes")
      version_ == 2 ? nodes_2(line) : nodes_4(line);
    else if (name == "Elements")
      version_ == 2 ? elements_2(line) : elements_4(line);
    else if (name == "PhysicalNames")
      physical_names(line);
    else if (!scan_.skip_to(end))
      truncated(name, line);
    // What follows a section of known length must be its end.
    const unsigned end_line = scan_.line();
    std::string_view found;
    while (found.empty() && !scan_.at_end())
      found = trimmed(scan_.read_line());
    if (found.empty())
      truncated(name, line);
    if (found != end)
      fail(binary_ ? 0 : end_line, fmt::format("expected {}, found {}: the count of ${} in line {} is too small", end,
                                               scene::in_quotes(found), name, line + 1));
  }

  [[noreturn]] static void truncated(const std::string &name, unsigned line) {
    fail(line, fmt::format("${} has no $End{}: the file is truncated", name, name), "save it again");
  }

  /// A count, each item of which takes at least `least` bytes.
  std::uint64_t count(std::string_view text, unsigned line, const char *what, std::size_t least) const {
    const auto n = number<std::uint64_t>(trimmed(text));
    if (!n)
      fail(line, fmt::format("expected the number of {}, found {}", what, scene::in_quotes(text)));
    require_room(*n, line, what, least);
    return *n;
  }

  void require_room(std::uint64_t n, unsigned line, const char *what, std::size_t least) const {
    if (n > scan_.remaining() / least + 1)
      fail(line,
           fmt::format("a count of {} {} is larger than the file can hold ({} bytes are left)", n, what,
                       scan_.remaining()),
           "the file is truncated or damaged; save it again");
  }

  /// One line that belongs to the section; its words.
  std::vector<std::string_view> item(const char *what, std::uint64_t i, std::uint64_t n) {
    const unsigned line = scan_.line();
    if (scan_.at_end())
      fail(line, fmt::format("the file ends after {} of {} {}: it is truncated", i, n, what), "save it again");
    const auto text = scan_.read_line();
    if (text.starts_with('$'))
      fail(line,
           fmt::format("{} after {} of {} {}: the count is too large, or the file is truncated", text, i, n, what));
    return words(text);
  }

  void coordinates(std::span<const std::string_view> texts, unsigned line) const {
    for (const auto text : texts) {
      const auto value = number<double>(text);
      if (!value || !std::isfinite(*value))
        fail(line, fmt::format("expected a coordinate, found {}", scene::in_quotes(text)));
    }
  }

  void physical_names(unsigned section) {
    const unsigned line = scan_.line();
    const auto n = count(scan_.read_line(), line, "physical names", 4);
    for (std::uint64_t i = 0; i < n; ++i)
      item("physical names", i, n);
    if (scan_.at_end())
      truncated("PhysicalNames", section);
  }

  void nodes_2(unsigned section) {
    const unsigned line = scan_.line();
    const auto n = count(scan_.read_line(), line, "nodes", binary_ ? 28 : 8);
    if (binary_) {
      if (!scan_.skip(n, 28))
        truncated("Nodes", section);
      return;
    }
    for (std::uint64_t i = 0; i < n; ++i) {
      const unsigned here = scan_.line();
      const auto node = item("nodes", i, n);
      if (node.size() != 4 || !number<std::uint64_t>(node[0]))
        fail(here, "expected a node: its number and three coordinates");
      coordinates(std::span(node).subspan(1), here);
    }
  }

  void elements_2(unsigned section) {
    const unsigned line = scan_.line();
    const auto n = count(scan_.read_line(), line, "elements", binary_ ? 4 : 6);
    for (std::uint64_t i = 0; i < n;) {
      if (binary_) {
        const auto type = scan_.read_binary<std::int32_t>();
        const auto block = scan_.read_binary<std::int32_t>();
        const auto n_tags = scan_.read_binary<std::int32_t>();
        if (!type || !block || !n_tags)
          truncated("Elements", section);
        const int n_nodes = nodes_of_type(*type);
        if (n_nodes == 0 || *block < 1 || *n_tags < 0)
          fail(0, fmt::format("a block of {} elements of type {}: the file is damaged or of a kind not taken", *block,
                              *type));
        if (!scan_.skip(static_cast<std::uint64_t>(*block), 4 * (1 + static_cast<std::uint64_t>(*n_tags + n_nodes))))
          truncated("Elements", section);
        i += static_cast<std::uint64_t>(*block);
        continue;
      }
      const unsigned here = scan_.line();
      const auto element = item("elements", i, n);
      const auto type = element.size() > 1 ? number<int>(element[1]) : std::nullopt;
      const auto n_tags = element.size() > 2 ? number<std::size_t>(element[2]) : std::nullopt;
      if (!type || !n_tags)
        fail(here, "expected an element: its number, type, tags and nodes");
      const int n_nodes = nodes_of_type(*type);
      if (n_nodes > 0 && element.size() != 3 + *n_tags + static_cast<std::size_t>(n_nodes))
        fail(here, fmt::format("a {} has {} nodes; this line holds {} numbers in place of {}", name_of_type(*type),
                               n_nodes, element.size(), 3 + *n_tags + static_cast<std::size_t>(n_nodes)));
      ++i;
    }
  }

  /// The head of a section of version 4.1: blocks, items, smallest and largest tag.
  std::pair<std::uint64_t, std::uint64_t> head_4(const char *what, const std::string &name, unsigned section,
                                                 std::size_t least) {
    std::array<std::uint64_t, 4> head{};
    const unsigned line = scan_.line();
    if (binary_) {
      for (auto &value : head) {
        const auto read = scan_.read_binary<std::uint64_t>();
        if (!read)
          truncated(name, section);
        value = *read;
      }
    } else {
      const auto texts = words(scan_.read_line());
      for (std::size_t k = 0; k < 4; ++k) {
        const auto value = k < texts.size() ? number<std::uint64_t>(texts[k]) : std::nullopt;
        if (!value)
          fail(line, fmt::format("expected four numbers: blocks, {}, smallest and largest tag", what));
        head[k] = *value;
      }
    }
    require_room(head[0], binary_ ? 0 : line, "blocks", 4);
    require_room(head[1], binary_ ? 0 : line, what, least);
    return {head[0], head[1]};
  }

  struct Block {
    std::array<int, 3> numbers{};
    std::uint64_t n = 0;
    unsigned line = 0;
  };

  Block block_4(const char *what, const std::string &name, unsigned section, std::size_t least) {
    Block block;
    block.line = binary_ ? 0 : scan_.line();
    if (binary_) {
      for (auto &value : block.numbers) {
        const auto read = scan_.read_binary<std::int32_t>();
        if (!read)
          truncated(name, section);
        value = *read;
      }
      const auto n = scan_.read_binary<std::uint64_t>();
      if (!n)
        truncated(name, section);
      block.n = *n;
    } else {
      const auto texts = item("blocks", 0, 1);
      for (std::size_t k = 0; k < 4; ++k) {
        const auto value = k < texts.size() ? number<std::int64_t>(texts[k]) : std::nullopt;
        if (!value || *value < 0)
          fail(block.line, fmt::format("expected the four whole numbers of a block of {}", what));
        if (k < 3)
          block.numbers[k] = static_cast<int>(*value);
        else
          block.n = static_cast<std::uint64_t>(*value);
      }
    }
    require_room(block.n, block.line, what, least);
    return block;
  }

  void nodes_4(unsigned section) {
    const auto [n_blocks, n_nodes] = head_4("nodes", "Nodes", section, binary_ ? 32 : 8);
    std::uint64_t sum = 0;
    for (std::uint64_t b = 0; b < n_blocks; ++b) {
      const auto block = block_4("nodes", "Nodes", section, binary_ ? 32 : 8);
      sum += block.n;
      // With parametric coordinates there are as many more numbers a node as the entity has dimensions.
      const auto extra = static_cast<std::uint64_t>(block.numbers[2] != 0 ? block.numbers[0] : 0);
      if (binary_) {
        if (!scan_.skip(block.n, 8 + 8 * (3 + extra)))
          truncated("Nodes", section);
        continue;
      }
      for (std::uint64_t i = 0; i < block.n; ++i)
        item("numbers of nodes", i, block.n);
      for (std::uint64_t i = 0; i < block.n; ++i) {
        const unsigned here = scan_.line();
        const auto node = item("nodes", i, block.n);
        if (node.size() != 3 + extra)
          fail(here, fmt::format("expected the {} coordinates of a node", 3 + extra));
        coordinates(node, here);
      }
    }
    if (sum != n_nodes)
      fail(binary_ ? 0 : section + 1, fmt::format("$Nodes announces {} nodes and holds {}", n_nodes, sum));
  }

  void elements_4(unsigned section) {
    const auto [n_blocks, n_elements] = head_4("elements", "Elements", section, binary_ ? 16 : 4);
    std::uint64_t sum = 0;
    for (std::uint64_t b = 0; b < n_blocks; ++b) {
      const auto block = block_4("elements", "Elements", section, binary_ ? 16 : 4);
      sum += block.n;
      const auto n_nodes = static_cast<std::uint64_t>(nodes_of_type(block.numbers[2]));
      if (n_nodes == 0 && binary_)
        fail(0, fmt::format("elements of type {}: the file is damaged or of a kind not taken", block.numbers[2]));
      if (binary_) {
        if (!scan_.skip(block.n, 8 * (1 + n_nodes)))
          truncated("Elements", section);
        continue;
      }
      for (std::uint64_t i = 0; i < block.n; ++i) {
        const unsigned here = scan_.line();
        const auto element = item("elements", i, block.n);
        if (n_nodes > 0 && element.size() != 1 + n_nodes)
          fail(here, fmt::format("a {} has {} nodes; this line holds {} numbers in place of {}",
                                 name_of_type(block.numbers[2]), n_nodes, element.size(), 1 + n_nodes));
      }
    }
    if (sum != n_elements)
      fail(binary_ ? 0 : section + 1, fmt::format("$Elements announces {} elements and holds {}", n_elements, sum));
  }

  MeshScanner scan_;
  int version_ = 4;
  bool binary_ = false;
};

/// Runs of programs have no place in a drawing that somebody else may have sent.
void check_drawing(std::string_view text) {
  if (text.find('\0') != std::string_view::npos)
    throw StructureError{0, "the file holds a zero byte; a drawing is plain text", {}};
  if (trimmed(text).empty())
    throw StructureError{0, "the file is empty", "save the drawing in Gmsh again"};
  if (text.find("SystemCall") != std::string_view::npos) {
    MeshScanner scan(text);
    scan.skip_to("SystemCall");
    throw StructureError{scan.line(), "SystemCall starts programs; drawings with it are not read", "remove the line"};
  }
  // Gmsh's reader of drawings drops a last line without an end, and with it the mesh.
  if (text.back() != '\n')
    throw StructureError{static_cast<unsigned>(1 + std::ranges::count(text, '\n')),
                         "the last line has no end, and Gmsh would not read it",
                         "add a newline at the end of the file"};
}

std::string contents(const fs::path &path) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status))
    throw StructureError{0, "there is no such file", "the path is relative to the folder of the scene"};
  if (fs::is_directory(status))
    throw StructureError{0, "is a folder, not a file", "name the .msh or .geo file in it"};
  if (!fs::is_regular_file(status))
    throw StructureError{0, "is no regular file", {}};
  const auto extension = path.extension();
  if (extension != ".msh" && extension != ".geo")
    throw StructureError{
        0, fmt::format("a geometry is a Gmsh mesh (.msh) or drawing (.geo), not '{}'", extension.string()),
        "save it in Gmsh: File, Export, .msh"};
  const auto size = fs::file_size(path, error);
  if (size > largest_file)
    throw StructureError{0, fmt::format("{} bytes; at most {} are read", size, largest_file), "use a coarser mesh"};
  std::ifstream stream(path, std::ios::binary);
  std::string bytes(error ? 0 : size, '\0');
  if (!stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw StructureError{0, "the file cannot be read", "check its permissions"};
  if (trimmed(bytes).empty())
    throw StructureError{0, "the file is empty", "mesh the drawing in Gmsh (Mesh, 2D) and save it again"};
  return bytes;
}

} // namespace

void check_structure(const std::filesystem::path &path, scene::Diagnostics &diagnostics) {
  try {
    check_structure(contents(path), path, diagnostics);
  } catch (const StructureError &error) {
    diagnostics.error({path.string(), error.line, error.line > 0 ? 1U : 0U}, {}, error.message, error.suggestion);
  }
}

void check_structure(std::string_view bytes, const std::filesystem::path &path, scene::Diagnostics &diagnostics) {
  try {
    if (path.extension() == ".geo")
      check_drawing(bytes);
    else
      MeshStructure(bytes).check();
  } catch (const StructureError &error) {
    diagnostics.error({path.string(), error.line, error.line > 0 ? 1U : 0U}, {}, error.message, error.suggestion);
  }
}

} // namespace comparisons::geometry
