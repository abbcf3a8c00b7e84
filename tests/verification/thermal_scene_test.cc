// [effects.thermal_expansion] in a scene with a geometry of one's own, by every method, against exact solutions.

#include "verification/scene_runs.h"

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
