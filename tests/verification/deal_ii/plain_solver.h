#pragma once

#include "fem_reference/elasticity/plane_elasticity.h"

#include <map>
#include <span>
#include <vector>

/// A second finite-element program for the same statement, on nothing but deal.II's own classes.
namespace plain_deal_ii {

/// Solves a problem of one material by FESystem(FE_Q(p), 2) and MappingQ(p) (quadrilaterals; arcs by
/// SphericalManifold) or by FE_SimplexP and MappingFE (straight triangles, p <= 2), UMFPACK, and returns the
/// displacement at every vertex of the mesh, m.
std::vector<fem_reference::elasticity::Vector> displacement_at_vertices(
    const fem_reference::elasticity::PlaneProblem &problem, unsigned degree);

} // namespace plain_deal_ii
