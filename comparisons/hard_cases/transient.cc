#include "comparisons/hard_cases/case_table.h"

#include "comparisons/hard_cases/scene_case.h"

#include <fmt/format.h>

#include <cmath>

namespace comparisons::hard_cases {

std::vector<HardCase> transient_cases(const study::Catalogue &catalogue) {
  std::vector<HardCase> cases;
  const auto stress = [](const reports::Cell &cell) { return value_of(cell.errors, "stress_l1"); };
  for (const double h : {1., 1.2, 1.4, 1.6, 1.8, 2., 2.2})
    cases.push_back(
        {"bar wave",
         fmt::format("h = {:g} D", h),
         "a pressure pulse on 200 points of a bar, SSPH rows of the revised super Gauss function; mean error "
         "of the stress over the pulse",
         "d'Alembert",
         .1,
         "10 %: the smeared fronts take a part of it that falls like 1/n",
         {"ssph", "fem"},
         true,
         [&catalogue, h, stress](const std::string &m) {
           return measure_scene(catalogue,
                                bar_scene(m, m == "ssph" ? fmt::format("smoothing_length = {}", h) : "", "", "", 200),
                                stress);
         }});
  for (const double factor : {.5, .99, 1.01, 10.})
    cases.push_back({"time step",
                     fmt::format("bar, dt = {:g} of the limit", factor),
                     "the pulse with this part of the stable step of linear elements, D / c; mean error of the stress",
                     "d'Alembert; above the limit an end by name",
                     .1,
                     "10 %, as above",
                     {"fem"},
                     true,
                     [&catalogue, factor, stress](const std::string &m) {
                       return measure_scene(catalogue, bar_scene(m, "", "", fmt::format("cfl = {}", factor), 200),
                                            stress);
                     }});
  cases.push_back({"time step",
                   "gas, dt = 10 of the limit",
                   "a shock tube with ten times the stable step",
                   "an end by name",
                   .1,
                   "nothing may come out",
                   {"sph"},
                   true,
                   [&catalogue](const std::string &m) {
                     return measure_scene(
                         catalogue, tube_scene(m, "", "", "cfl = 10.0"),
                         [](const reports::Cell &cell) { return value_of(cell.errors, "density_l1"); });
                   }});
  for (const auto *positions : {"reference", "current"})
    cases.push_back({"Swegle",
                     fmt::format("kernels at {} positions", positions),
                     "a stretched bar, held at both ends, with a small disturbance; growth of it less 1",
                     "it must not grow",
                     1.,
                     "twice: it may beat, but not grow",
                     {"sph"},
                     true,
                     [&catalogue, positions](const std::string &m) {
                       return measure_scene(
                           catalogue,
                           bar_scene(m, fmt::format("positions = \"{}\"", positions),
                                     "case = \"stretched\"\nstretch = 0.01", "end = \"67 us\"\ncfl = 0.3", 60),
                           [](const reports::Cell &cell) { return value_of(cell.quantities, "growth") - 1; });
                     }});
  struct Gas {
    const char *name, *problem, *material, *time;
    double scale, threshold;
  };
  const Gas gases[] = {
      {"Sod", "", "", "cfl = 0.3", 1, .05},
      {"Noh",
       "left_velocity = 1.0\nleft_pressure = 1e-6\nright_density = 1.0\nright_velocity = -1.0\nright_pressure = "
       "1e-6\nhalf_length = 1.0\nwindow = 0.3",
       "[material]\ngamma = 1.6666666666666667\n", "end = 0.6\ncfl = 0.3", 4, .1},
      {"123",
       "left_velocity = -2.0\nleft_pressure = 0.4\nright_density = 1.0\nright_velocity = 2.0\nright_pressure = 0.4", "",
       "end = 0.15\ncfl = 0.3", 1, .1},
      {"blast, pressures 1e5:1", "left_pressure = 1000.0\nright_density = 1.0\nright_pressure = 0.01", "",
       "end = 0.012\ncfl = 0.3", 6, .1},
      {"contact at rest", "left_density = 1.0\nright_density = 0.125\nleft_pressure = 1.0\nright_pressure = 1.0", "",
       "end = 0.2\ncfl = 0.3", 1, .05},
      // Until waves from the ends, where the gas does not follow (sound 3.35 in the light one), could be at |x| = .25.
      {"contact that moves",
       "left_density = 1.0\nright_density = 0.125\nleft_pressure = 1.0\nright_pressure = 1.0\nleft_velocity = "
       "1.0\nright_velocity = 1.0\nwindow = 0.25",
       "", "end = 0.06\ncfl = 0.3", 1, .05}};
  for (const auto &gas : gases)
    cases.push_back({"gas",
                     gas.name,
                     "a Riemann problem on 400 points; mean error of the density over its largest value",
                     "the exact solution of the Riemann problem",
                     gas.threshold,
                     "shocks are smeared over a few smoothing lengths, wall heating remains",
                     {"sph", "fem"},
                     true,
                     [&catalogue, gas](const std::string &m) {
                       return measure_scene(catalogue, tube_scene(m, gas.problem, gas.material, gas.time),
                                            [gas](const reports::Cell &cell) {
                                              return value_of(cell.errors, "density_l1") / gas.scale;
                                            });
                     }});
  for (const double jitter : {0., .25})
    cases.push_back(
        {"zero modes",
         fmt::format("free plate, jitter {:g} %", 100 * jitter),
         "eigenvalues of the assembled operator of a plate that nothing holds, 13 x 7 points: the sum of "
         "the third lowest frequency over the first elastic one and the relative error of the fourth",
         "three rigid motions and no further zero: a fourth, such as an hourglass, would have an error of 1",
         .1,
         "10 %: of the first elastic frequency on 13 points",
         {"strong", "weak1", "weak2", "fem Q1", "fem Q2"},
         jitter == 0, // hourglasses live on grids

         [&catalogue, jitter](const std::string &m) {
           return measure_scene(
               catalogue, plate_scene(m, fmt::format("jitter = {}", jitter), "[study]\nlevels = [\"13x7\"]"),
               [](const reports::Cell &cell) {
                 return value_of(cell.quantities, "rigid_over_first") + value_of(cell.errors, "frequency_1_relative");
               });
         }});
  return cases;
}

} // namespace comparisons::hard_cases
