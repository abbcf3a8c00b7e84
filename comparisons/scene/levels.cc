#include "comparisons/scene/levels.h"

#include "comparisons/scene/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

namespace comparisons::scene {

namespace {

constexpr std::int64_t least_count = 2;
constexpr std::int64_t most_count = 1000000000;

/// Reads the items of one list of levels.
class LevelReader {
public:
  LevelReader(const LevelForm &form, const std::string &key, Diagnostics &diagnostics)
      : form_(form), key_(key), diagnostics_(diagnostics) {}

  std::optional<Level> read(const Node &node) const {
    switch (node.kind) {
    case Node::Kind::integer:
      return from_counts(node, {node.integer});
    case Node::Kind::text:
      return from_text(node);
    case Node::Kind::array:
      return from_list(node);
    case Node::Kind::real:
      return fail(node, fmt::format("{} is no level; allowed: {}", describe(node), allowed_levels(form_)),
                  node.real > 0 &&
                          node.real == static_cast<double>(static_cast<std::int64_t>(std::min(node.real, 1e15)))
                      ? fmt::format("a count is written {}", static_cast<std::int64_t>(node.real))
                      : fmt::format("a spacing is written with its unit: \"{} m\"", node.real));
    default:
      return fail(node, fmt::format("{} is no level; allowed: {}", describe(node), allowed_levels(form_)));
    }
  }

private:
  std::nullopt_t fail(const Node &node, std::string message, std::string suggestion = {}) const {
    diagnostics_.error(node.location, key_, std::move(message), std::move(suggestion));
    return std::nullopt;
  }

  std::optional<Level> from_list(const Node &node) const {
    std::vector<std::int64_t> counts;
    for (const Node &item : node.items) {
      if (!item.is(Node::Kind::integer))
        return fail(item, fmt::format("{} in a level; a level in brackets holds whole numbers", describe(item)),
                    "write [16, 4]");
      counts.push_back(item.integer);
    }
    return from_counts(node, counts);
  }

  std::optional<Level> from_counts(const Node &node, const std::vector<std::int64_t> &counts) const {
    const auto n = static_cast<int>(counts.size());
    if (form_.counts_per_level != 0 && n != form_.counts_per_level) {
      const std::string example = form_.counts_per_level == 1 ? "188" : "\"16x4\"";
      return fail(node,
                  fmt::format("a level of {} {}; {} takes {} a level", n, n == 1 ? "count" : "counts", form_.benchmark,
                              form_.counts_per_level),
                  "write for example " + example);
    }
    if (n == 0 || n > 3)
      return fail(node, fmt::format("a level of {} counts; allowed: {}", n, allowed_levels(form_)));
    Level level;
    for (const std::int64_t count : counts) {
      if (count < least_count || count > most_count)
        return fail(node,
                    fmt::format("a count of {} in a level; a count is from {} to {}", count, least_count, most_count));
      level.counts.push_back(static_cast<int>(count));
    }
    level.text = fmt::format("{}", fmt::join(level.counts, "x"));
    return level;
  }

  /// "mesh", "mesh/2", "mesh/4" ...; nothing if the text is of another form.
  static std::optional<Level> mesh_level(const std::string &text) {
    int refinements = 0;
    std::string name = "mesh";
    constexpr int most = 10;
    for (; name != text && refinements < most; ++refinements)
      name = fmt::format("mesh/{}", 2 << refinements);
    if (name != text)
      return std::nullopt;
    Level level;
    level.refinements = refinements;
    level.text = text;
    return level;
  }

  std::optional<Level> from_text(const Node &node) const {
    if (form_.meshes) {
      if (const auto level = mesh_level(node.text))
        return level;
      if (node.text.starts_with("mesh"))
        return fail(node, fmt::format("{} is no level; allowed: {}", in_quotes(node.text), allowed_levels(form_)),
                    "a refined mesh is \"mesh/2\", \"mesh/4\", ...");
    }
    if (const auto counts = split_counts(node.text))
      return from_counts(node, *counts);
    const auto result = parse_quantity(node.text);
    if (const auto *error = std::get_if<QuantityError>(&result))
      return fail(
          node,
          fmt::format("{} is no level: {}; allowed: {}", in_quotes(node.text), error->message, allowed_levels(form_)),
          error->suggestion);
    const auto &quantity = std::get<Quantity>(result);
    if (!quantity.has_unit)
      return fail(node, fmt::format("{} has no unit; allowed: {}", in_quotes(node.text), allowed_levels(form_)),
                  fmt::format("a count is written without quotes, a spacing \"{} m\"", quantity.value));
    if (quantity.dimension != dimensions::length)
      return fail(
          node,
          fmt::format("{} is a {}; a spacing is a length", in_quotes(node.text), dimension_name(quantity.dimension)),
          "write for example \"5 mm\"");
    if (quantity.value <= 0)
      return fail(node, fmt::format("a spacing of {}; a spacing is greater than 0", in_quotes(node.text)));
    Level level;
    level.spacing = quantity.value;
    level.text = fmt::format("{} m", quantity.value);
    return level;
  }

  /// "16x4", "16 X 4", "2 x 3 x 4"; nothing if the text is of another form.
  static std::optional<std::vector<std::int64_t>> split_counts(std::string_view text) {
    std::vector<std::int64_t> counts;
    const char *const end = text.data() + text.size();
    const char *at = text.data();
    const auto skip_spaces = [&] {
      while (at != end && *at == ' ')
        ++at;
    };
    while (true) {
      skip_spaces();
      std::int64_t count = 0;
      const auto [next, status] = std::from_chars(at, end, count);
      if (status == std::errc::result_out_of_range)
        count = most_count + 1;
      else if (status != std::errc{})
        return std::nullopt;
      counts.push_back(count);
      at = next;
      skip_spaces();
      if (at == end)
        break;
      if (*at != 'x' && *at != 'X')
        return std::nullopt;
      ++at;
    }
    return counts.size() > 1 ? std::optional(counts) : std::nullopt;
  }

  const LevelForm &form_;
  const std::string &key_;
  Diagnostics &diagnostics_;
};

/// True for [16, 4] where a level takes two counts: one level, or two wrong ones?
bool is_ambiguous(const Node &node, const LevelForm &form) {
  return form.counts_per_level == 2 && node.items.size() == 2 && node.items[0].is(Node::Kind::integer) &&
         node.items[1].is(Node::Kind::integer);
}

} // namespace

std::string allowed_levels(const LevelForm &form) {
  if (form.meshes)
    return "\"mesh\" (as in the file), \"mesh/2\" (refined), a spacing such as \"5 mm\", or a count such as 188";
  if (form.counts_per_level == 1)
    return "a count such as 188, or a spacing such as \"5 mm\"";
  if (form.counts_per_level == 2)
    return "two counts such as \"16x4\" or [16, 4], or a spacing such as \"5 mm\"";
  return "a count such as 188, counts such as \"16x4\" or [16, 4], or a spacing such as \"5 mm\"";
}

std::vector<Level> read_levels(const Node &node, const LevelForm &form, const std::string &key,
                               Diagnostics &diagnostics) {
  const LevelReader reader(form, key, diagnostics);
  if (!node.is(Node::Kind::array)) {
    const auto level = reader.read(node);
    return level ? std::vector{*level} : std::vector<Level>{};
  }
  const auto fail = [&](std::string message, std::string suggestion) {
    diagnostics.error(node.location, key, std::move(message), std::move(suggestion));
    return std::vector<Level>{};
  };
  if (node.items.empty())
    return fail("an empty list of levels; a level is " + allowed_levels(form), {});
  if (node.items.size() > most_cells)
    return fail(fmt::format("{} levels; at most {}", node.items.size(), most_cells), {});
  if (is_ambiguous(node, form))
    return fail(fmt::format("[{0}, {1}] may mean one level of {0} by {1} or two levels; {2} takes "
                            "two counts a level",
                            node.items[0].integer, node.items[1].integer, form.benchmark),
                fmt::format("write [[{0}, {1}]] or [\"{0}x{1}\"]", node.items[0].integer, node.items[1].integer));
  std::vector<Level> levels;
  std::set<std::string> texts;
  for (const Node &item : node.items) {
    auto level = reader.read(item);
    if (!level)
      continue;
    if (texts.insert(level->text).second)
      levels.push_back(std::move(*level));
    else
      diagnostics.error(item.location, key, fmt::format("the level {} stands twice", level->text),
                        "remove one of them");
  }
  return levels;
}

} // namespace comparisons::scene
