// [effects.thermal_expansion] in a scene with a geometry of one's own, by every method, against exact solutions.

#include "verification/scene_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>

#include <unistd.h>

namespace {

using namespace scene_runs;

/// A folder of its own for the length of a test.
struct TemporaryFolder {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("petrov_thermal_" + std::to_string(::getpid()));
  TemporaryFolder() { std::filesystem::create_directories(path); }
  ~TemporaryFolder() { std::filesystem::remove_all(path); }
};

const std::string plate = R"(SetFactory("Built-in");
Point(1) = {0, 0, 0, 0.2}; Point(2) = {2, 0, 0, 0.2}; Point(3) = {2, 1, 0, 0.2}; Point(4) = {0, 1, 0, 0.2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("right") = {2}; Physical Curve("top") = {3}; Physical Curve("left") = {4};
Physical Surface("plate") = {1};
)";

std::string scene(const std::string &boundaries, const std::string &effect, const std::string &reference,
                  const std::string &model) {
  std::string text = R"(schema = 1
[geometry]
file = "plate.geo"
size = "0.2 m"
[[material]]
E = "200 GPa"
nu = 0.3
model = ")" + model + "\"\n" +
                     boundaries + "[effects]\nelasticity = true\n" + effect + "[reference]\n" + reference;
  for (const auto *method : {"strong", "weak1", "weak2", "hybrid", "fem"})
    text += std::string("[[method]]\nname = \"") + method + "\"\n";
  return text + "[study]\nlevels = [\"mesh\"]\nrepeats = 1\n";
}

scene::ReadResult read_in(const TemporaryFolder &folder, const std::string &text) {
  std::ofstream(folder.path / "plate.geo") << plate;
  std::ofstream(folder.path / "scene.toml") << text;
  return scene::read_scene(folder.path / "scene.toml", {}, study::vocabulary_of(study::shipped_catalogue()));
}

const std::string rollers = "[[boundary]]\ngroup = \"left\"\nu1 = 0\n[[boundary]]\ngroup = \"bottom\"\nu2 = 0\n";
const std::string warm = "[effects.thermal_expansion]\nexpansion = 1.2e-5\ntemperature = 100\n";

void expect_exact(const std::string &text) {
  const TemporaryFolder folder;
  const auto result = read_in(folder, text);
  ASSERT_TRUE(result.scene) << scene::to_text(result.diagnostics);
  const auto cells = run(*result.scene);
  ASSERT_EQ(cells.size(), 5u);
  for (const auto &cell : cells) {
    ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
    // Linear displacement and uniform strain: the patch test of every method, to rounding times condition.
    EXPECT_LT(l2(cell), 1e-10) << name_of(cell);
  }
}

TEST(ThermalScene, AFreePlateExpands) {
  expect_exact(scene(rollers, warm, "u1 = \"1.2e-3*x\"\nu2 = \"1.2e-3*y\"\ns11 = \"1e-3*x\"\ns22 = 0\ns12 = 0\n",
                     "plane stress"));
}

TEST(ThermalScene, AFreePlateInPlaneStrainExpandsMore) {
  expect_exact(scene(rollers, warm, "u1 = \"1.56e-3*x\"\nu2 = \"1.56e-3*y\"\ns11 = \"1e-3*x\"\ns22 = 0\ns12 = 0\n",
                     "plane strain"));
}

TEST(ThermalScene, APlateHeldAlongOneAxisHasTheStressOfTheory) {
  // sigma_11 = -E alpha T = -240 MPa; across it grows by (1 + nu) alpha T.
  const TemporaryFolder folder;
  const auto result =
      read_in(folder, scene(rollers + "[[boundary]]\ngroup = \"right\"\nu1 = 0\n", warm,
                            "u1 = 0\nu2 = \"1.56e-3*y\"\ns11 = -240e6\ns22 = 0\ns12 = 0\n", "plane stress"));
  ASSERT_TRUE(result.scene) << scene::to_text(result.diagnostics);
  for (const auto &cell : run(*result.scene)) {
    ASSERT_EQ(cell.status, reports::Status::ok) << name_of(cell);
    EXPECT_LT(l2(cell), 1e-10) << name_of(cell);
    EXPECT_LT(stress_l2(cell), 1e-9) << name_of(cell);
  }
}

// Temperatures whose gradient is not zero: the divergence of the thermal stress inside, its traction on the boundary.

TEST(ThermalScene, ALinearTemperatureBendsWithoutStress) {
  // e = a x, a = 1.2e-5 * 100: u1 = a (x^2 - y^2) / 2, u2 = a x y, of second degree and without stress. The value of
  // the reference's stress is the scale of its error.
  const std::string bent = "u1 = \"0.6e-3*(x*x-y*y)\"\nu2 = \"1.2e-3*x*y\"\n";
  expect_exact(scene("[[boundary]]\ngroup = \"left\"\n" + bent,
                     "[effects.thermal_expansion]\nexpansion = 1.2e-5\ntemperature = \"100*x\"\n",
                     bent + "s11 = \"1e-3*x\"\ns22 = 0\ns12 = 0\n", "plane stress"));
}

TEST(ThermalScene, BodyForceAndTractionHoldAPlateOfAnyTemperature) {
  // u1 = a x y, u2 = 0 at the temperature T = 100 (x^2 - x y + 2 y^2), plane stress: with beta = E / (1 - nu) and
  // e = alpha T the stress is s11 = E / (1 - nu^2) a y - beta e, s22 = nu of the first part - beta e, s12 = mu a x, and
  // the body force -s11,1 - s12,2 = beta e,1; -s12,1 - s22,2 = beta e,2 - (mu + nu E / (1 - nu^2)) a.
  constexpr double E = 200e9;
  constexpr double nu = 0.3;
  constexpr double a = 1e-3;
  const double thermal = E / (1 - nu) * 1.2e-3; // beta alpha 100
  const double axial = E / (1 - nu * nu);
  const double mu = E / (2 * (1 + nu));
  const auto number = [](double value) { return fmt::format("({:.17g})", value); };
  const auto temperature = number(thermal) + "*(x*x-x*y+2*y*y)";
  const auto s11 = number(axial * a) + "*y-" + temperature;
  const auto s22 = number(nu * axial * a) + "*y-" + temperature;
  const auto s12 = number(mu * a) + "*x";
  const auto traction = [&](const char *group, const std::string &x, const std::string &y) {
    return fmt::format("[[boundary]]\ngroup = \"{}\"\ntraction = [\"{}\", \"{}\"]\n", group, x, y);
  };
  const std::string field = fmt::format("u1 = \"{:.17g}*x*y\"\nu2 = 0\n", a);
  const std::string boundaries = "[[boundary]]\ngroup = \"left\"\n" + field + traction("right", s11, s12) +
                                 traction("top", s12, s22) + traction("bottom", "-(" + s12 + ")", "-(" + s22 + ")");
  const std::string effects =
      fmt::format("[effects.thermal_expansion]\nexpansion = 1.2e-5\ntemperature = \"100*(x*x-x*y+2*y*y)\"\n"
                  "[effects.body_force]\nforce = [\"{}*(2*x-y)\", \"{}*(4*y-x)-{}\"]\n",
                  number(thermal), number(thermal), number((mu + nu * axial) * a));
  const std::string reference = field + fmt::format("s11 = \"{}\"\ns22 = \"{}\"\ns12 = \"{}\"\n", s11, s22, s12);
  expect_exact(scene(boundaries, effects, reference, "plane stress"));
}

TEST(ThermalScene, BadTablesAreRefused) {
  const std::string reference = "u1 = 0\nu2 = 0\ns11 = 0\ns22 = 0\ns12 = 0\n";
  const TemporaryFolder folder;
  for (const auto *bad : {"thermal_expansion = true\n", "[effects.thermal_expansion]\nexpansion = 1e-5\n",
                          "[effects.thermal_expansion]\nexpansion = 1e-5\ntemperature = \"1/(x-x)\"\n",
                          "[effects.thermal_expansion]\nexpansion = 2\ntemperature = 1\n"}) {
    const auto result = read_in(folder, scene(rollers, bad, reference, "plane stress"));
    EXPECT_FALSE(result.scene) << bad;
    EXPECT_NE(scene::to_text(result.diagnostics).find("thermal_expansion"), std::string::npos) << bad;
  }
  EXPECT_ANY_THROW(read("schema = 1\nbenchmark = \"cantilever\"\n[effects]\nelasticity = true\nthermal_expansion = "
                        "true\n[[method]]\nname = \"fem\"\n[study]\nlevels = [\"16x4\"]\n"));
}

} // namespace
