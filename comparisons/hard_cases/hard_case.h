#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace comparisons::hard_cases {

/// What a method made of a case.
struct Measurement {
  /// Relative to the reference, or what the case's `meaning` says; the threshold is for it.
  double error = 0;
  /// The figure that the reference is of, if there is one.
  std::optional<double> value = {};
  /// What the method itself said: warnings of the cell, from theory or from its own checks.
  std::vector<std::string> warnings = {};
  /// Measures of the error that need no exact solution (metrics::error_indicators), to be compared with it.
  std::map<std::string, double> indicators = {};
};

/// One hard case: what it is, what the answer must be, and who takes it.
struct HardCase {
  std::string family;               ///< "incompressibility"
  std::string name;                 ///< "cook nu=.4999"
  std::string meaning;              ///< what is solved, and what the error is of
  std::string reference;            ///< the answer and where it is known from
  double threshold = 0;             ///< an error up to this holds
  std::string reason;               ///< why this threshold
  std::vector<std::string> methods; ///< labels of solvers (solvers.h), or of the case's own
  bool quick = true;
  /// @throws methods::Refused or an exception with a reason of the library: a refusal; anything else is a failure
  std::function<Measurement(const std::string &method)> run;
};

/// Thrown by a case for an outcome that is no number by the method's own word.
class NamedRefusal : public std::exception {
public:
  explicit NamedRefusal(std::string reason) : reason_(std::move(reason)) {}
  const char *what() const noexcept override { return reason_.c_str(); }

private:
  std::string reason_;
};

} // namespace comparisons::hard_cases
