#pragma once

#include <optional>
#include <string>
#include <vector>

namespace comparisons::program {

/// Options that every command which runs scenes takes.
struct CommonOptions {
  std::optional<std::string> output;
  std::vector<std::string> formats;
  std::vector<std::string> sets; ///< KEY=VALUE
  std::optional<int> threads;
  std::optional<int> repeats;
  bool quiet = false;
  bool isolate = false;
  bool resume = false;

  /// The options as overrides of a scene's keys, after the user's own.
  std::vector<std::string> overrides() const;
};

enum ExitCode {
  all_as_expected = 0,
  usage_error = 2,
  invalid_scene = 3,
  cell_failed = 4,
  published_missed = 5,
  limit_reached = 6,
  interrupted = 130,
};

} // namespace comparisons::program
