#pragma once

#include "../elasticity/discretisation.h"
#include "transfer.h"

#include <optional>

namespace fem_reference::multigrid {
/// A coarser space and how the finer one follows from it.
struct Coarsening {
  elasticity::Discretisation space;
  Transfer transfer;
};

/// The space of degree p / 2 (even p) or 1 (odd p > 1) on the same quadrilaterals. Its nodes are a subset of those of
/// degree p, which lie at the Gauss-Lobatto points: spaces are nested.
Coarsening coarsen_degree(const elasticity::Discretisation &fine);

/// The mesh of which `fine` (degree 1, quadrilaterals) is the uniform refinement, with bilinear elements on it; none if
/// it is not one, or if a coarse cell would join regions or be inverted.
///
/// Nothing need be known of how the mesh came about. In a refinement every new edge joins the middle of an old edge to
/// an old vertex or to the middle of an old cell, so that vertices fall into two classes, {middles of edges} and {the
/// others}, and the diagonals of the cells split the second into {old vertices} and {middles of cells}. Both splittings
/// are two-colourings of a connected graph; of the four ways to read them at most one has four cells around every
/// middle of a cell and two or four at every middle of an edge.
std::optional<Coarsening> coarsen_mesh(const elasticity::Discretisation &fine);
} // namespace fem_reference::multigrid
