#pragma once

#include "comparisons/problems/plane_problem.h"

#include <cstdint>

namespace comparisons::benchmarks::plate_with_hole {

/// Quarter of a plate with a circular hole around the origin: 0 <= x1 <= half_length, 0 <= x2 <= half_width,
/// |x| >= radius.
struct QuarterPlate {
  double radius = 1;
  double half_length = 3;
  double half_width = 3;
};

/// The paper's numbers of the boundaries, Batra & Zhang 2008, Fig. 14a.
enum Side : int { x2_axis = 1, hole = 2, x1_axis = 3, right = 4, top = 5 };

/// Counter-clockwise, from the x1 axis.
std::vector<problems::BoundaryPiece> boundary(const QuarterPlate &plate);

/// Symmetry on the axes, the tractions of `exact` on the outer edges, none at the hole.
problems::PlaneStatement statement(const QuarterPlate &plate, const problems::Material &material,
                                   const problems::ExactSolution &exact);

/// Particles on the quarter circle of a cloud of n: 11 of 188 and 21 of 686, as in the papers.
std::size_t n_on_hole(std::size_t n_particles);

/// A graded, relaxed cloud. The spacing grows outwards by .45 of itself for every radius.
/// @param n_particles exactly; 0: as many as the spacing makes
/// @param hole_spacing at the hole, m; used if n_particles is 0
problems::Cloud generated_cloud(const QuarterPlate &plate, std::size_t n_particles, double hole_spacing,
                                std::uint64_t seed);

/// Moves the particles by up to `amount` spacings, those of the boundary along it.
void jitter(const QuarterPlate &plate, double amount, std::uint64_t seed, problems::Cloud &cloud);

/// Two blocks that meet on the line to the far corner, n_around elements along each half of the hole's edge and
/// n_outwards to the outer edges; the edges at the hole are arcs.
struct Blocks {
  int n_around = 4;
  int n_outwards = 6;
};

/// Blocks with about n vertices and elements that are about square.
Blocks blocks_of(std::size_t n_vertices);

problems::Mesh mesh(const QuarterPlate &plate, const Blocks &blocks);

/// Gauss points, five an axis, on parts of the same two blocks with the hole's edge exactly round.
problems::Quadrature quadrature(const QuarterPlate &plate, int parts);

/// Points (parts + 1)^2 of each block, for data of fields.
std::vector<problems::Point2> field_points(const QuarterPlate &plate, int parts);

} // namespace comparisons::benchmarks::plate_with_hole
