#pragma once

#include "meshless/basis/derivative_operators.h"
#include "meshless/basis/ssph.h"
#include "meshless/dynamics/elastic_bar.h"

#include <span>
#include <utility>
#include <vector>

namespace performance {

/// A bar with unit spacing and wave speed, rows of Zhang & Batra 2008, section 6.4; a pulse from the right end.
inline meshless::dynamics::BarOptions bar_options(int n) {
  using namespace meshless;
  dynamics::BarOptions options;
  for (int i = 0; i < n; ++i)
    options.positions.push_back(i);
  options.operators = [](std::span<const double> places) {
    std::vector<cloud::Point<1>> points;
    for (const double x : places)
      points.push_back({x});
    const cloud::Particles<1> particles(points, std::vector<double>(points.size(), 1.2));
    const auto basis = basis::make_ssph<1>(2, kernels::make_kernel("revised_super_gauss", {}, 1.6));
    auto rows = basis::make_derivative_operators<1>(*basis, particles, {.gradient = true, .hessian = true});
    return dynamics::LineOperators{std::move(rows.gradient.front()), std::move(rows.hessian.front())};
  };
  options.right_stress = [](double t) { return t < 50 ? -1.0 : 0.0; };
  return options;
}

} // namespace performance
