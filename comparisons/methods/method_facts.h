#pragma once

#include "comparisons/methods/method_table.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace comparisons::methods {

/// What a method's discretisation is made of and costs: the measurable part of Zhang & Batra 2008, Table 7, that a
/// solution does not tell. What a method does not have is absent.
struct MethodFacts {
  /// Which particles or nodes couple, compressed rows, sorted.
  std::vector<std::int64_t> row_start;
  std::vector<std::int64_t> columns;
  /// |K - K^T| / |K| (Frobenius): of the system as assembled (elements: without essential conditions), and of the rows
  /// and columns of particles inside the domain.
  std::optional<double> symmetry_defect;
  std::optional<double> symmetry_defect_inside;
  /// Discs or cells that integrals are taken over, and the quadrature points in all of them; 0 for collocation.
  std::optional<double> n_integrated_domains;
  std::optional<double> n_quadrature_points;
  double n_subdomains = 0; ///< supports or cells
  /// Supports or cells over a point, and shape functions that are not zero there, on the average.
  std::optional<double> subdomains_per_point;
  std::optional<double> functions_per_point;
  /// Seconds for one shape function at one point, and with its gradient.
  std::optional<double> value_seconds;
  std::optional<double> gradient_seconds;
  /// Largest step of central differences with lumped mass for a density of 1 kg/m^3, s; the seconds to find it; or why
  /// there is none.
  std::optional<double> critical_step;
  double critical_step_seconds = 0;
  std::string no_critical_step;
};

/// Measures a method by its name; takes several times as long as a solve.
/// @param points where shape functions of particles are evaluated; elements take their quadrature points
/// @throws Refused, or what the method throws
MethodFacts method_facts(const SolveRequest &request, const std::string &method,
                         std::span<const problems::Point2> points);

} // namespace comparisons::methods
