#include "comparisons/reports/results.h"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace comparisons::reports {

namespace {

template <typename Enum>
using Word = std::pair<Enum, const char *>;

constexpr std::array<Word<Status>, 4> status_words{
    {{Status::ok, "ok"}, {Status::refused, "refused"}, {Status::failed, "failed"}, {Status::limit, "limit"}}};

constexpr std::array<Word<Kind>, 2> kind_words{{{Kind::value, "value"}, {Kind::claim, "claim"}}};

constexpr std::array<Word<Verdict>, 5> verdict_words{{{Verdict::reproduced, "reproduced"},
                                                      {Verdict::differs, "differs"},
                                                      {Verdict::not_reproducible, "not reproducible"},
                                                      {Verdict::holds, "holds"},
                                                      {Verdict::does_not_hold, "does not hold"}}};

template <typename Words, typename Enum>
const char *word_of(const Words &words, Enum value) {
  for (const auto &[key, word] : words)
    if (key == value)
      return word;
  return "?";
}

template <typename Enum, typename Words>
std::optional<Enum> value_of(const Words &words, std::string_view text) {
  for (const auto &[key, word] : words)
    if (text == word)
      return key;
  return std::nullopt;
}

} // namespace

const char *to_text(Status status) { return word_of(status_words, status); }
const char *to_text(Kind kind) { return word_of(kind_words, kind); }
const char *to_text(Verdict verdict) { return word_of(verdict_words, verdict); }

std::optional<Status> status_from_text(std::string_view text) { return value_of<Status>(status_words, text); }
std::optional<Kind> kind_from_text(std::string_view text) { return value_of<Kind>(kind_words, text); }
std::optional<Verdict> verdict_from_text(std::string_view text) { return value_of<Verdict>(verdict_words, text); }

std::optional<double> reportable(const Cell &cell, const std::map<std::string, double> &map, std::string_view name) {
  if (cell.status != Status::ok)
    return std::nullopt;
  const auto found = map.find(std::string(name));
  if (found == map.end() || !std::isfinite(found->second))
    return std::nullopt;
  return found->second;
}

std::optional<double> reportable(const Cell &cell, std::string_view name) {
  const auto error = reportable(cell, cell.errors, name);
  return error ? error : reportable(cell, cell.quantities, name);
}

std::optional<double> median_seconds(const Cell &cell, std::string_view phase) {
  const auto found = cell.seconds.find(std::string(phase));
  if (found == cell.seconds.end() || !std::isfinite(found->second.median))
    return std::nullopt;
  return found->second.median;
}

std::optional<double> relative_spread(const Cell &cell) {
  const auto total = cell.seconds.find("total");
  if (total == cell.seconds.end() || cell.repeats < 2 || !(total->second.median > 0))
    return std::nullopt;
  const double spread = (total->second.maximum - total->second.minimum) / total->second.median;
  return std::isfinite(spread) ? std::optional(spread) : std::nullopt;
}

std::optional<double> relative_spacing(const Cell &cell) {
  const std::string &level = cell.level;
  const char *const end = level.data() + level.size();
  double first = 0;
  const auto [after, failure] = std::from_chars(level.data(), end, first);
  if (failure == std::errc() && after != end && *after == 'x' && first > 1)
    return 1.0 / (first - 1.0);
  if (failure == std::errc() && std::string_view(after, end) == " m" && first > 0)
    return first;
  const auto n = static_cast<double>(cell.n_points);
  if (cell.dimension == 1)
    return n > 1 ? std::optional(1 / (n - 1)) : std::nullopt;
  if (cell.n_points > 0)
    return cell.dimension == 2 ? 1 / std::sqrt(n) : 1 / std::cbrt(n);
  return std::nullopt;
}

} // namespace comparisons::reports
