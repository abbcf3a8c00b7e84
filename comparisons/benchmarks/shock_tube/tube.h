#pragma once

#include "comparisons/benchmarks/shock_tube/riemann.h"
#include "comparisons/scene/scene.h"
#include "comparisons/study/transient.h"

#include "meshless/hydrodynamics/gas_flow.h"

#include <memory>
#include <optional>
#include <vector>

namespace comparisons::benchmarks::shock_tube {

/// What a scene's [problem], [material] and [effects] say.
struct Tube {
  GasState left, right;
  double gamma = 1.4;
  double half_length = 0.6; ///< the tube is |x| <= half_length, m
  double window = 0.4;      ///< m
  bool walls = false;
  double perturbation = 0; ///< of the particles' places, over their spacing
  std::uint64_t seed = 42;
  std::optional<meshless::effects::MonaghanViscosity> viscosity;
  std::optional<meshless::effects::HeatConduction> conduction;

  Tube(const scene::Scene &scene, const scene::ProblemVariant &variant);

  const GasState &at(double x) const { return x <= 0 ? left : right; }
  /// Internal energy per mass, J/kg.
  double energy(const GasState &state) const { return state.pressure / ((gamma - 1) * state.density); }
};

/// Values at places, ordered by x.
struct Profile {
  std::vector<double> x, weight; ///< m; the length that a value stands for
  std::vector<double> density, pressure, velocity, energy;
};

/// A gas on its way through time.
class GasEvolution : public study::Evolution {
public:
  virtual Profile profile() = 0;
  virtual std::int64_t n_points() const = 0;
  virtual std::int64_t n_dofs() const = 0;
  /// Relative errors of mass, of momentum (over sum |m v|, less what enters at the ends) and of energy; absent where
  /// the ends are open.
  virtual std::map<std::string, double> balances() const = 0;
  /// fem_reference::gas::DiscontinuousGalerkin::n_shrunk_slopes; 0 for particles.
  virtual std::int64_t n_shrunk_slopes() const { return 0; }
};

/// Equal masses: of n particles as many to the left of x = 0 as the left part has of the mass.
meshless::hydrodynamics::GasParticles place_particles(const Tube &tube, int n);

/// The gas as the method's keys say.
meshless::hydrodynamics::GasOptions gas_options(const Tube &tube, const scene::Parameters &method, int n);

std::unique_ptr<GasEvolution> particle_gas(const Tube &tube, const scene::Parameters &method, int n);
std::unique_ptr<GasEvolution> mesh_gas(const Tube &tube, int degree, int n_cells);

} // namespace comparisons::benchmarks::shock_tube
