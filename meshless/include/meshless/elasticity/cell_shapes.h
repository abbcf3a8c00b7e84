#pragma once

#include "meshless/elasticity/surroundings.h"

#include <span>
#include <vector>

namespace meshless::elasticity {

/// Supports that fit how particles lie: as cloud::Particles takes them.
struct CellShapes {
  std::vector<double> smoothing_lengths; ///< half of an ellipse's length, m
  std::vector<cloud::Point<2>> flattenings;
  double upper_aspect = 1; ///< length over width that one in ten exceeds
};

/// The second moments of Voronoi cells about their particles, M = 12 / |V| int (x - x_I)(x - x_I)^T, which on a
/// rectangular grid are the squares of its spacings, on edges too (the quarter of a cell in a corner is tilted). Cells
/// are cut off at the boundary: at the tangent where a piece is nearest. M is averaged over the particles around, with
/// weights that fall to zero at two spacings, because single cells tell more of jitter than of spacing; its
/// eigenvectors are the axes of the ellipse, the roots of its eigenvalues half of its length and width.
///
/// Second moments of the nearest particles would not do: those inside a disc lie alike in all directions, however the
/// cloud is stretched.
///
/// @param regions of every particle; empty: all are in the first
CellShapes cell_shapes(const Surroundings &surroundings, std::span<const Point2> positions,
                       std::span<const int> regions);

} // namespace meshless::elasticity
