// Vibrating plates through scenes: particles beside finite elements, and what ends a run.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace scene_runs;

std::string modes(const std::string &supports, const std::string &level) {
  return "schema = 1\nbenchmark = \"plate_vibration\"\n[problem]\nsupports = \"" + supports +
         "\"\n[[method]]\nname = \"weak1\"\n[[method]]\nname = \"weak2\"\n[[method]]\nname = \"fem\"\nlevels = "
         "[\"33x17\"]\n[study]\nlevels = [\"" +
         level + "\"]\n";
}

void expect_frequencies(const std::vector<reports::Cell> &cells) {
  for (const auto &cell : cells) {
    // The promise of one per cent between particles and elements; quadratic elements have 2e-5.
    for (int k = 1; k <= 6; ++k)
      EXPECT_LT(error_of(cell, "frequency_" + std::to_string(k) + "_relative"), cell.method == "fem" ? 1e-4 : 0.01)
          << name_of(cell) << ", mode " << k;
    EXPECT_EQ(cell.quantities.at("n_negative"), 0) << name_of(cell);
  }
}

TEST(PlateVibration, FreeFrequenciesAgreeAndRigidMotionsHaveNone) {
  const auto cells = run(read(modes("free", "33x17")));
  ASSERT_EQ(cells.size(), 3u);
  expect_frequencies(cells);
  for (const auto &cell : cells) // a root of rounding, eps times the largest over the smallest square, 1e4
    EXPECT_LT(cell.quantities.at("rigid_over_first"), 1e-5) << name_of(cell);
}

TEST(PlateVibration, ClampedFrequenciesAgree) { expect_frequencies(run(read(modes("clamped", "49x25")))); }

const std::string step_load = R"(
schema = 1
benchmark = "plate_vibration"
[problem]
supports = "left"
length = "1 m"
width = "0.2 m"
[[method]]
name = "weak1"
[[method]]
name = "fem"
[[method]]
label = "explicit"
name = "fem"
mass = "lumped"
integration = "central_difference"
[[method]]
name = "strong"
[time]
end = "20 ms"
cfl = 4
[study]
analysis = "transient"
levels = ["21x5"]
)";

TEST(PlateVibration, ElementsKeepEnergyAndGrowthEndsTheCell) {
  const auto cells = run(read(step_load));
  const auto &fem = find(cells, "fem", "21x5");
  EXPECT_EQ(fem.status, reports::Status::ok) << fem.reason;
  EXPECT_LT(error_of(fem, "energy_relative"), 1e-10);
  // Newmark's period is longer by (omega dt)^2 / 12, 1e-4; the crossings of higher modes blur it by a per cent.
  EXPECT_LT(error_of(fem, "period_relative"), 0.01);
  EXPECT_LT(error_of(fem, "mean_deflection_relative"), 0.01);
  const auto &weak1 = find(cells, "weak1", "21x5");
  EXPECT_EQ(weak1.status, reports::Status::failed);
  for (const auto *part : {"at t = 0.01", "energy grows", "complex", "imaginary part", "1/s"})
    EXPECT_NE(weak1.reason.find(part), std::string::npos) << weak1.reason;
  EXPECT_EQ(find(cells, "strong", "21x5").status, reports::Status::refused);
  // Four spacings over the wave speed are ten times the stable step.
  const auto &explicit_fem = find(cells, "explicit", "21x5");
  EXPECT_EQ(explicit_fem.status, reports::Status::failed);
  EXPECT_NE(explicit_fem.reason.find("above the stable one"), std::string::npos) << explicit_fem.reason;
}

TEST(PlateVibration, ShorterRunsReportDriftAndSpectrum) {
  const auto cells = run(read(step_load, {"time.end=8 ms"}));
  const auto &weak1 = find(cells, "weak1", "21x5");
  ASSERT_EQ(weak1.status, reports::Status::ok) << weak1.reason;
  EXPECT_GT(std::abs(weak1.quantities.at("energy_drift")), 1e-6); // not what elements have
  EXPECT_LT(error_of(weak1, "energy_relative"), 0.2);
  EXPECT_GT(weak1.quantities.at("imaginary_part"), 0);
  EXPECT_GT(weak1.quantities.at("growth_rate"), 0);
  EXPECT_EQ(weak1.quantities.at("n_eigenvalues"), 210);
}

TEST(PlateVibration, DampingLeadsToTheStaticDeflection) {
  // Four times the first frequency: over-damped, exp(-omega^2 t / rate) = exp(-15) at the end.
  const auto cells = run(read(step_load + "[effects]\nelasticity = true\ninertia = true\n[effects.damping]\nrate = "
                                          "\"4000 1/s\"\n",
                              {"time.end=60 ms"}));
  const auto &fem = find(cells, "fem", "21x5");
  ASSERT_EQ(fem.status, reports::Status::ok) << fem.reason;
  EXPECT_NEAR(fem.quantities.at("last_deflection") / fem.quantities.at("static_deflection"), 1, 1e-3);
  EXPECT_EQ(fem.errors.count("energy_relative"), 0u);
}

std::string with_effect(const std::string &effect) {
  return step_load + "[[method]]\nname = \"weak2\"\n[effects]\nelasticity = true\ninertia = true\n" + effect +
         " = true\n";
}

void expect_motion_about(double static_deflection, double tolerance, const std::string &effect) {
  const auto cells = run(read(with_effect(effect), {"problem.shear=0", "time.end=8 ms", "method.0.name=hybrid",
                                                    "method.2.element=Q1", "method.2.levels=[\"41x9\"]"}));
  EXPECT_EQ(find(cells, "strong", "21x5").status, reports::Status::refused);
  for (const auto *label : {"fem", "weak2"}) {
    const auto &cell = find(cells, label, "21x5");
    ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
    EXPECT_NEAR(cell.quantities.at("static_deflection") / static_deflection, 1, tolerance) << effect;
    // One or two swings about the rest position; what higher modes blur.
    EXPECT_LT(error_of(cell, "mean_deflection_relative"), 0.02) << name_of(cell);
    // The loads' work is that of the equations for elements; weak2 has no energy of its own.
    EXPECT_LT(error_of(cell, "energy_relative"), cell.method == "fem" ? 1e-10 : 0.05) << name_of(cell);
  }
}

TEST(PlateVibration, WeightActsFromOneMomentOn) {
  // Timoshenko's beam, shear factor 5/6: w L^4 / (8 E I) + w L^2 / (2 k G A), of slenderness 5.
  const double w = 77e3 * 0.2;
  const double bending = w / (8 * 210e9 * 0.2 * 0.2 * 0.2 / 12);
  const double shearing = w / (2 * 5.0 / 6 * 210e9 / 2.6 * 0.2);
  expect_motion_about(-bending - shearing, 0.01, "body_force");
}

TEST(PlateVibration, ATemperatureThatRisesAcrossBends) {
  // Without stress: curvature a = alpha T / W, u2 = a (y^2 - W^2 / 4 - x^2) / 2 about the middle; the clamp hinders
  // what is within a width of it, a part of (W / L)^2.
  const double a = 1.2e-5 * 100 / 0.2;
  expect_motion_about(-0.5 * a, 0.2 * 0.2, "thermal_expansion");
}

TEST(PlateVibration, ExplicitStepsTakeTheSameLoads) {
  for (const auto *effect : {"body_force", "thermal_expansion"}) {
    // Penalties of the weak form limit its explicit step to .022 spacings over wave speed. At this time the waves of
    // the sudden load cross the plate, which meshes of 5 and 9 points across carry to some per cent.
    const auto cells = run(read(with_effect(effect), {"problem.shear=0", "time.end=0.2 ms", "time.cfl=0.02",
                                                      "method.4.integration=central_difference", "method.2.element=Q1",
                                                      "method.2.levels=[\"41x9\"]"}));
    const auto &fem = find(cells, "fem", "21x5");
    for (const auto &[label, level] : {std::pair{"explicit", "41x9"}, std::pair{"weak2", "21x5"}}) {
      const auto &cell = find(cells, label, level);
      ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
      EXPECT_NEAR(cell.quantities.at("last_deflection") / fem.quantities.at("last_deflection"), 1, 0.1)
          << name_of(cell) << " " << effect;
    }
  }
}

TEST(PlateVibration, KeysOfAbsentEffectsChangeNoBit) {
  const Overrides shorter{"time.end=0.4 ms", "method.0.name=weak2"};
  Overrides other = shorter;
  for (const auto *key : {"problem.weight=1e9", "problem.temperature=1e4", "problem.expansion=1e-3"})
    other.emplace_back(key);
  const auto cells = run(read(step_load, shorter));
  const auto with_keys = run(read(step_load, other));
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_EQ(cells[i].status, reports::Status::ok) << name_of(cells[i]);
    EXPECT_EQ(cells[i].quantities, with_keys[i].quantities) << name_of(cells[i]);
    EXPECT_EQ(cells[i].errors, with_keys[i].errors) << name_of(cells[i]);
  }
}

TEST(PlateVibration, LoadsHaveNoPartInFrequencies) {
  const auto cells =
      run(read(modes("free", "9x5") + "[effects]\nelasticity = true\ninertia = true\nthermal_expansion = true\n"));
  for (const auto &cell : cells) {
    EXPECT_EQ(cell.status, reports::Status::refused) << name_of(cell);
    EXPECT_NE(cell.reason.find("thermal_expansion"), std::string::npos) << cell.reason;
  }
}

TEST(PlateVibration, BadScenesAreRefused) {
  EXPECT_ANY_THROW(read(step_load, {"method.2.mass=consistent"}));
  EXPECT_ANY_THROW(read(step_load, {"study.levels=[\"2x2\"]"}));
  EXPECT_ANY_THROW(read(step_load + "[effects]\nelasticity = true\n"));
}

} // namespace
