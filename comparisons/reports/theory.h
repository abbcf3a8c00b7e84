#pragma once

#include "comparisons/reports/results.h"

#include <optional>
#include <string_view>

namespace comparisons::reports {

/// Order of convergence that theory gives for an error of a cell, on smooth solutions and quasi-uniform levels; none
/// where none is known. By the derivative that the error measures (displacement or value 0; strain, stress, energy or
/// first derivative 1; second derivative 2) and the degree p of the elements or the order m of the monomials that was
/// solved:
/// - finite elements: p + 1, p, p - 1 (Ciarlet 1978, Theorem 3.2.5; Aubin-Nitsche for the first);
/// - estimates of a function by a basis that is exact up to m: m + 1 - k for the k-th derivative, Taylor's remainder;
/// - weak2, a Galerkin-like form with differentiated shape functions: as finite elements of degree m;
/// - weak1, whose derivatives are estimates of their own and exact up to m: its stress is consistent to h^m, and so is
///   all that follows from it: m for both;
/// - strong, collocation of second derivatives: m for even m, m - 1 for odd m (Auricchio, Beirao da Veiga, Hughes,
///   Reali & Sangalli 2010 for splines; the odd terms cancel in symmetric neighbourhoods), for stress too.
std::optional<double> theoretical_rate(const Cell &cell, std::string_view error);

} // namespace comparisons::reports
