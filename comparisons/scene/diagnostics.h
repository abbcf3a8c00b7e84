#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::scene {

/// A place in a text file; line and column count from 1, 0 means unknown (`--set`, a missing key).
struct Location {
  std::string file;
  unsigned line = 0;
  unsigned column = 0;

  friend bool operator==(const Location &, const Location &) = default;
};

enum class Severity { error, warning };

/// One finding about a scene: where, what was found, what is allowed, what to change.
struct Diagnostic {
  Severity severity = Severity::error;
  Location location;
  /// The key it is about, as it would be written for `--set`; may be empty.
  std::string key;
  /// What was found and what is allowed.
  std::string message;
  /// A near miss or a remedy; may be empty.
  std::string suggestion;

  friend bool operator==(const Diagnostic &, const Diagnostic &) = default;
};

/// Collects every finding of one pass; nothing throws on the first. After `limit` findings one
/// more says that the rest is left out.
class Diagnostics {
public:
  static constexpr std::size_t limit = 1000;

  void add(Diagnostic diagnostic);
  void error(Location location, std::string key, std::string message, std::string suggestion = {});
  void warning(Location location, std::string key, std::string message, std::string suggestion = {});

  bool has_errors() const;
  const std::vector<Diagnostic> &all() const { return all_; }

private:
  std::vector<Diagnostic> all_;
};

/// `file:line:column: error: key: message (suggestion)`, one line each.
std::string to_text(const Diagnostic &diagnostic);
std::string to_text(const Diagnostics &diagnostics);

/// A user's text in quotes, for messages: control characters replaced, long texts cut.
std::string in_quotes(std::string_view text);

/// The candidate nearest to `word` by edit distance, or empty when none is near.
std::string nearest_name(const std::string &word, const std::vector<std::string> &candidates);

/// "did you mean 'NAME'?", or empty when no candidate is near.
std::string did_you_mean(const std::string &word, const std::vector<std::string> &candidates);

} // namespace comparisons::scene
