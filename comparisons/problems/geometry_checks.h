#pragma once

#include "comparisons/geometry/plane_geometry.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/geometry_tables.h"

namespace comparisons::problems {

/// Rigid motions that the prescribed displacements leave to a part of the domain, as an error that names them.
void check_rigid_motions(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                         const scene::GeometryTables &tables, scene::Diagnostics &diagnostics);

/// Prescribed displacements of two groups that differ where the groups meet.
void check_shared_corners(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                          const scene::GeometryTables &tables, scene::Diagnostics &diagnostics);

/// Conditions and body forces that are not finite where they hold.
void check_finite(const geometry::PlaneGeometry &geometry, const PlaneStatement &statement,
                  const scene::GeometryTables &tables, scene::Diagnostics &diagnostics);

} // namespace comparisons::problems
