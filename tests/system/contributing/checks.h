#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

/// What the worked examples of CONTRIBUTING.md share: figures held against theory, one line each.
namespace contributing {

class Checks {
public:
  /// |computed - exact| <= tolerance; prints both.
  void near(const std::string &what, double computed, double exact, double tolerance) {
    const bool holds = std::abs(computed - exact) <= tolerance; // false for what is not a number
    report(holds, fmt::format("{}: {:.10g}, exact {:.10g}, tolerance {:.1e}", what, computed, exact, tolerance));
  }

  void holds(const std::string &what, bool condition) { report(condition, what); }

  /// 0 if all held, else 1.
  int exit_code() const { return n_failed_ == 0 ? 0 : 1; }

private:
  void report(bool holds, const std::string &line) {
    fmt::print("{} {}\n", holds ? "ok    " : "FAILED", line);
    if (!holds)
      ++n_failed_;
  }

  int n_failed_ = 0;
};

} // namespace contributing
