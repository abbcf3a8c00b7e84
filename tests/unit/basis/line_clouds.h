#pragma once

#include "meshless/cloud/particles.h"

#include <vector>

/// The one-dimensional clouds of the papers.
namespace line_clouds {

using meshless::cloud::Particles;
using meshless::cloud::Point;

/// Zhang & Batra 2008, section 6: x_i = (i - 1/2) / n on [0, 1], h = factor / n, volumes 1 / n.
inline Particles<1> cell_centred(int n, double factor) {
  std::vector<Point<1>> positions;
  for (int i = 0; i < n; ++i)
    positions.push_back({(i + .5) / n});
  const auto size = positions.size();
  return {std::move(positions), std::vector<double>(size, factor / n), std::vector<double>(size, 1. / n)};
}

/// Asprone, Auricchio & Reali 2010, section 5: n particles on [0, 1], both ends included, h = spacing, volumes
/// all equal to it.
inline Particles<1> rod(int n) {
  std::vector<Point<1>> positions;
  const double spacing = 1. / (n - 1);
  for (int i = 0; i < n; ++i)
    positions.push_back({i * spacing});
  const auto size = positions.size();
  return {std::move(positions), std::vector<double>(size, spacing), std::vector<double>(size, spacing)};
}

} // namespace line_clouds
