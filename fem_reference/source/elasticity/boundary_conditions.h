#pragma once

#include "../linear_algebra/block_matrix.h"
#include "discretisation.h"
#include "fem_reference/elasticity/plane_elasticity.h"

#include <map>
#include <vector>

namespace fem_reference::elasticity {
/// Prescribed displacements: for unknown = 2 node + component whether it is prescribed, its value in m (zero
/// elsewhere), and the boundary id that gave it.
struct EssentialData {
  std::vector<char> prescribed;
  std::vector<double> values;
  std::vector<int> ids;
  std::size_t contradicted = 0;
};

/// Each boundary id of the mesh needs a condition, each condition an id of the mesh and a
/// displacement where a component asks for one. Throws InvalidInput.
void check_conditions(const PlaneProblem &problem);

/// Each region of the mesh needs a material, and all materials one plane model. Throws InvalidInput.
void check_materials(const PlaneProblem &problem);

/// Whether a body may be left with rigid motions: in motion it may.
enum class FreeMotions { refused, allowed };

/// Interpolate the prescribed displacements at the nodes of the boundary edges. Throws InvalidInput
/// if a value is not finite or if a connected part of the mesh is left with a free rigid motion.
EssentialData essential_data(const PlaneProblem &problem, const Discretisation &discretisation,
                             FreeMotions free_motions = FreeMotions::refused);

/// Integrals of the shape functions with body force and tractions, and of these alone; N per m of thickness.
struct Loads {
  std::vector<double> nodal;
  std::map<int, Vector> tractions; ///< by boundary id
  Vector body_force{};
  double magnitude = 0; ///< integral of |b_1| + |b_2| and |t_1| + |t_2|
};
Loads loads(const PlaneProblem &problem, const Discretisation &discretisation);

/// Move the prescribed columns to the right-hand side and keep of prescribed rows and columns the
/// diagonal alone: the matrix stays symmetric positive definite and of the same size.
void eliminate(const EssentialData &essential, linear_algebra::BlockMatrix &matrix,
               std::vector<double> &right_hand_side);
} // namespace fem_reference::elasticity
