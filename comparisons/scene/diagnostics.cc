#include "comparisons/scene/diagnostics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace comparisons::scene {

namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Edit distance with transpositions of neighbours (optimal string alignment).
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), current(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j)
    previous[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    current[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = previous[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      current[j] = std::min({previous[j] + 1, current[j - 1] + 1, replaced});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        current[j] = std::min(current[j], before[j - 2] + 1);
    }
    std::swap(before, previous);
    std::swap(previous, current);
  }
  return previous[b.size()];
}

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](char c) { return lower(c); });
  return result;
}

/// A candidate that holds the word, or begins with it: "hole" for "plate_with_hole".
std::string containing_name(const std::string &word, const std::vector<std::string> &candidates) {
  const std::string wanted = lower(word);
  for (const auto &candidate : candidates) {
    const auto place = lower(candidate).find(wanted);
    if ((place == 0 && wanted.size() >= 3) || (place != std::string::npos && wanted.size() >= 4))
      return candidate;
  }
  return {};
}

} // namespace

void Diagnostics::add(Diagnostic diagnostic) {
  if (all_.size() < limit)
    all_.push_back(std::move(diagnostic));
  else if (all_.size() == limit)
    all_.push_back({.severity = Severity::error,
                    .location = {.file = all_.front().location.file},
                    .key = {},
                    .message = fmt::format("more than {} findings; the rest is left out", limit),
                    .suggestion = {}});
}

void Diagnostics::error(Location location, std::string key, std::string message, std::string suggestion) {
  add({Severity::error, std::move(location), std::move(key), std::move(message), std::move(suggestion)});
}

void Diagnostics::warning(Location location, std::string key, std::string message, std::string suggestion) {
  add({Severity::warning, std::move(location), std::move(key), std::move(message), std::move(suggestion)});
}

bool Diagnostics::has_errors() const {
  return std::ranges::any_of(all_, [](const auto &d) { return d.severity == Severity::error; });
}

std::string to_text(const Diagnostic &diagnostic) {
  std::string text = diagnostic.location.file;
  if (diagnostic.location.line > 0)
    text += fmt::format(":{}:{}", diagnostic.location.line, diagnostic.location.column);
  if (!text.empty())
    text += ": ";
  text += diagnostic.severity == Severity::error ? "error: " : "warning: ";
  if (!diagnostic.key.empty())
    text += diagnostic.key + ": ";
  text += diagnostic.message;
  if (!diagnostic.suggestion.empty())
    text += " (" + diagnostic.suggestion + ")";
  return text;
}

std::string to_text(const Diagnostics &diagnostics) {
  std::string text;
  for (const auto &diagnostic : diagnostics.all())
    text += to_text(diagnostic) + "\n";
  return text;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  const bool cut = text.size() > longest;
  if (cut) {
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U)
      --end; // never inside a UTF-8 sequence
    text = text.substr(0, end);
  }
  std::string result = "'";
  for (const char c : text)
    result += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? '?' : c;
  return result + (cut ? "...'" : "'");
}

std::string nearest_name(const std::string &word, const std::vector<std::string> &candidates) {
  constexpr std::size_t longest = 80; // the distance costs the product of the lengths
  if (word.empty() || word.size() > longest)
    return {};
  const std::string *best = nullptr;
  std::pair<std::size_t, std::size_t> best_distance{};
  for (const auto &candidate : candidates) {
    if (candidate.size() > longest)
      continue;
    const std::size_t distance = edit_distance(lower(word), lower(candidate));
    const std::size_t allowed = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
    if (distance > allowed || distance >= std::min(word.size(), candidate.size()))
      continue;
    // The case of letters only decides between equals: "mpa" is nearer to "mPa" than to "MPa".
    const std::pair rank{distance, edit_distance(word, candidate)};
    if (best == nullptr || rank < best_distance) {
      best = &candidate;
      best_distance = rank;
    }
  }
  return best != nullptr ? *best : containing_name(word, candidates);
}

std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates) {
  const std::string near = nearest_name(word, candidates);
  return near.empty() ? std::string{} : "did you mean " + in_quotes(near) + "?";
}

} // namespace comparisons::scene
