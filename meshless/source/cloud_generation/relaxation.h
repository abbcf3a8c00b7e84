#pragma once

#include "boundary_curves.h"

namespace meshless::cloud_generation {

/// Moves the particles inside until they lie evenly: each is repelled by its neighbours, more strongly the nearer
/// they are in units of the wanted spacing, and kept .5 of it away from the boundary where there is room.
/// @param scale of the spacing
/// @param boundary_particles stay where they are
void relax(const domain::Boundary &region, const Spacing &spacing, double scale,
           std::span<const Point2> boundary_particles, std::vector<Point2> &interior);

} // namespace meshless::cloud_generation
