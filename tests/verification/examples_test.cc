// The shipped examples of a geometry of one's own: their figures against the known ones, by every method.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace scene_runs;

scene::Scene read_example(const std::string &name, const Overrides &overrides = {}) {
  const auto file = std::filesystem::path(PETROV_SOURCE_DIR) / "comparisons/examples" / name;
  auto result = scene::read_scene(file, overrides, study::vocabulary_of(study::shipped_catalogue()));
  if (!result.scene)
    throw std::runtime_error(scene::to_text(result.diagnostics));
  return std::move(*result.scene);
}

/// However singular the stress at a corner is, what is left of the forces is less than the error of stress as a whole.
void expect_balance(const reports::Cell &cell) {
  if (cell.method == "fem") {
    EXPECT_LT(cell.quantities.at("force_imbalance"), 1e-8);
  } else if (cell.errors.contains("stress_l2_relative")) {
    EXPECT_LT(cell.quantities.at("force_imbalance"), cell.errors.at("stress_l2_relative"));
  }
}

/// The figure of every cell at the finer level is within its method's share of the known one.
void expect_figure(const std::string &example, const std::string &quantity, double fem, double meshless) {
  const auto scene = read_example(example);
  for (const auto &cell : run(scene)) {
    SCOPED_TRACE(example + ": " + name_of(cell));
    ASSERT_EQ(cell.status, reports::Status::ok);
    expect_balance(cell);
    // Q2 is there for comparison: its stress at a point is of second order only.
    if (cell.level != "mesh/2" || cell.label.find("element=Q2") != std::string::npos)
      continue;
    EXPECT_LT(cell.quantities.at(quantity + "_error"), cell.method == "fem" ? fem : meshless)
        << quantity << " = " << cell.quantities.at(quantity);
  }
}

// 23.968, an extrapolation printed with five digits.
TEST(Examples, cooks_membrane) { expect_figure("cooks_membrane/scene.toml", "tip", 1e-3, 1e-2); }
// 92.66 MPa, four digits.
TEST(Examples, nafems_le1) { expect_figure("nafems_le1/scene.toml", "s22_at_D", 1e-3, 2e-2); }
// Five digits, of the gross section.
TEST(Examples, strip_of_half_its_width) {
  expect_figure("strip_with_hole/scene.toml", "stress_concentration_factor", 1e-3, 2e-2);
}
TEST(Examples, strip_of_a_fifth_of_its_width) {
  expect_figure("strip_with_hole/diameter_0.2.toml", "stress_concentration_factor", 1e-3, 2e-2);
}
TEST(Examples, strip_of_a_tenth_of_its_width) {
  expect_figure("strip_with_hole/diameter_0.1.toml", "stress_concentration_factor", 1e-3, 2e-2);
}
// 1 + 2 a / b.
TEST(Examples, elliptic_hole) { expect_figure("elliptic_hole/scene.toml", "stress_concentration_factor", 2e-3, 5e-2); }
TEST(Examples, slender_elliptic_hole) {
  expect_figure("elliptic_hole/slender.toml", "stress_concentration_factor", 2e-3, 5e-2);
}
TEST(Examples, thick_cylinder) { expect_figure("thick_cylinder/scene.toml", "hoop_stress", 1e-3, 2e-2); }

/// Two layers against Lame's solution: the stress jumps at the interface, and both methods converge in it nevertheless.
/// One at the interface that shared its strain between the layers would be wrong in stress by a third there.
TEST(Examples, layered_cylinder) {
  expect_figure("thick_cylinder/layered.toml", "hoop_stress", 1e-3, 2e-2);
  const auto cells = run(read_example("thick_cylinder/layered.toml"));
  for (const auto *label : {"weak1 order=2", "weak1 order=3", "fem element=Q2", "fem element=Q3"}) {
    const double ratio = find(cells, label, "mesh").errors.at("stress_l2_relative") /
                         find(cells, label, "mesh/2").errors.at("stress_l2_relative");
    EXPECT_GT(std::log2(ratio), 1.8) << label;
  }
}

/// Two materials against finer finite elements; what the bolts hold is what the lip carries.
TEST(Examples, bracket) {
  for (const auto &cell : run(read_example("bracket/scene.toml"))) {
    SCOPED_TRACE(name_of(cell));
    ASSERT_EQ(cell.status, reports::Status::ok);
    const bool fem = cell.method == "fem";
    EXPECT_LT(cell.quantities.at("bolt_force_error"), fem ? 1e-8 : 0.02);
    expect_balance(cell);
    EXPECT_LT(l2(cell), fem ? 2e-3 : 0.1);
  }
}

/// The displacement of the singular field converges at a rate of about 2 lambda = 1.09, whatever the degree.
TEST(Examples, l_shape) {
  const auto cells = run(read_example("l_shape/scene.toml"));
  for (const auto *label : {"fem element=Q2", "fem element=Q3"}) {
    const double ratio = l2(find(cells, label, "mesh")) / l2(find(cells, label, "mesh/2"));
    EXPECT_NEAR(std::log2(ratio), 2 * 0.544483737, 0.1) << label;
  }
}

} // namespace
