#include "comparisons/study/effect_table.h"

namespace comparisons::study {

namespace {

const scene::Range not_negative{.lower = 0, .upper = 100};

std::vector<scene::Declaration> viscosity_keys() {
  return {{.name = "linear",
           .range = not_negative,
           .default_value = 0.05,
           .meaning = "factor b of b c D rho v_x in solids (c wave speed, D spacing), alpha of Monaghan's in gases"},
          {.name = "quadratic",
           .range = not_negative,
           .default_value = 0.0,
           .meaning = "factor beta of Monaghan's viscosity in gases; solids have none"}};
}

std::vector<scene::Declaration> heat_conduction_keys() {
  return {{.name = "linear",
           .range = not_negative,
           .default_value = 0.1,
           .meaning = "factor g1 of the diffusivity h (g1 c + g2 |v_ij|)"},
          {.name = "quadratic", .range = not_negative, .default_value = 1.0, .meaning = "factor g2 of the same"}};
}

std::vector<scene::Declaration> burn_keys() {
  return {{.name = "speed",
           .dimension = scene::dimensions::velocity,
           .range = {.lower = 0, .lower_open = true},
           .default_value = 6930.0,
           .meaning = "speed D of the front x = D t, m/s; not below the Chapman-Jouguet speed"},
          {.name = "ramp",
           .range = {.lower = 0, .upper = 1000},
           .default_value = 0.0,
           .meaning = "width of the front in spacings over which the pressure rises; 0: at once"}};
}

} // namespace

const std::vector<scene::EffectDescription> &effect_table() {
  static const std::vector<scene::EffectDescription> effects{
      {"elasticity", "linear elastic solid, small strain"},
      {"body_force", "force per volume"},
      {"inertia", "mass times acceleration"},
      {"artificial_viscosity", "viscous pressure that smooths shocks", viscosity_keys()},
      {"damping",
       "force against velocity",
       {{.name = "rate",
         .dimension = {.time = -1},
         .range = {.lower = 0},
         .default_value = 0.0,
         .meaning = "force per mass and velocity, 1/s"}}},
      {"thermal_expansion", "strain by temperature"},
      {"gas_pressure", "pressure of a gas by its equation of state"},
      {"heat_conduction", "artificial heat conduction of gases", heat_conduction_keys()},
      {"programmed_burn", "energy release at a prescribed detonation front", burn_keys()},
  };
  return effects;
}

} // namespace comparisons::study
