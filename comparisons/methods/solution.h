#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace comparisons::methods {

/// What one solve took and how it went; read by the study, not by the metrics.
struct SolveRecord {
  std::int64_t n_points = 0; ///< particles or vertices
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
  /// Phases points, neighbours, basis, assembly, solve, in seconds.
  std::map<std::string, double> seconds;
  /// Figures such as backward_error and reciprocal_condition.
  std::map<std::string, double> quantities;
  std::vector<std::string> warnings;
};

/// The solution of a method: all that metrics and reports know of it.
class Solution {
public:
  virtual ~Solution() = default;

  /// "displacement" (2 components, m), "stress" (11, 22, 12, Pa) ...
  virtual std::vector<std::string> fields() const = 0;
  virtual std::size_t n_components(std::string_view field) const = 0;

  /// Values at points anywhere in the domain, in one batch.
  /// @param values components of one point together, points.size() x n_components
  /// @throws std::invalid_argument for a field that the solution does not have
  virtual void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                        std::span<double> values) const = 0;

  const SolveRecord &record() const { return record_; }

protected:
  SolveRecord record_;
};

} // namespace comparisons::methods
