// Random scenes that are valid by construction: each cell ends with finite numbers or refuses by name, and what must
// not change a relative error changes none. The seeds are fixed; a failure prints its seed and the whole scene.

#include "unit/cloud/sample_clouds.h"
#include "verification/scene_runs.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace scene_runs;

/// A scene whose load and material can be multiplied.
class RandomScene {
public:
  explicit RandomScene(std::uint64_t seed) : random_(seed) {
    // Spacings of both directions differ by a quarter at most: the default supports then hold enough particles.
    const double spacing = std::pow(10, random_.between(-3, 3));
    const int n1 = whole(8, 15);
    const int n2 = whole(6, 9);
    ring_ = seed % 4 == 3;
    nu_ = random_.between(-.5, .48);
    strain_ = coin();
    youngs_modulus_ = std::pow(10, random_.between(-3, 12));
    load_ = youngs_modulus_ * std::pow(10, random_.between(-6, -3));
    seed_ = whole(1, 1000);
    if (ring_) {
      problem_ = fmt::format("radius = {:.17g}\nhalf_length = {:.17g}\nhalf_width = {:.17g}\n", spacing,
                             spacing * random_.between(2.5, 3.5), spacing * random_.between(2.5, 3.5));
      problem_ += fmt::format("cloud = \"generated\"\ncloud_seed = {}\n", whole(1, 1000));
      level_ = fmt::format("{}", whole(150, 220));
    } else {
      const char *solutions[] = {"bending", "linear", "trigonometric"};
      solution_ = solutions[whole(0, 2)];
      problem_ =
          fmt::format("length = {:.17g}\nwidth = {:.17g}\nsolution = \"{}\"\njitter = {:.3f}\n", spacing * (n1 - 1),
                      spacing * (n2 - 1) * random_.between(.8, 1.25), solution_, coin() ? 0 : random_.between(0, .3));
      level_ = fmt::format("\"{}x{}\"", n1, n2);
    }
    add_methods();
  }

  /// With `factor` times the load and `stiffness` times Young's modulus.
  std::string text(double factor = 1, double stiffness = 1) const {
    std::string scene =
        fmt::format("schema = 1\nbenchmark = \"{}\"\n[problem]\n{}{} = {:.17g}\n",
                    ring_ ? "plate_with_hole" : "cantilever", problem_, ring_ ? "stress" : "force", factor * load_);
    scene += fmt::format("[material]\nE = {:.17g}\nnu = {:.17g}\nmodel = \"plane {}\"\n", stiffness * youngs_modulus_,
                         nu_, strain_ ? "strain" : "stress");
    if (solution_ == "trigonometric")
      scene += "[effects]\nelasticity = true\nbody_force = true\n";
    return scene + methods_ + fmt::format("[study]\nlevels = [{}]\nseed = {}\n", level_, seed_);
  }

  bool patch_test() const { return solution_ == "linear"; }

private:
  int whole(int least, int most) { return least + static_cast<int>(random_() * (most - least + 1)); }
  bool coin() { return random_() < .5; }

  void add_methods() {
    for (const char *name : {"strong", "weak1", "weak2", "hybrid", "mixed"}) {
      const std::string method = name;
      const int order = whole(2, 3);
      methods_ += fmt::format("[[method]]\nname = \"{}\"\norder = {}\n", name, order);
      const char *bases[] = {"ssph", "mls", "rkpm", "msph", "cspm"};
      methods_ += fmt::format("basis = \"{}\"\n", bases[whole(0, method == "weak2" || order > 2 ? 2 : 3)]);
      if (order == 2) { // of the others the support is fixed and holds too few for order 3
        const char *kernels[] = {"gauss", "revised_super_gauss", "revised_gauss"};
        methods_ += fmt::format("kernel = \"{}\"\n", kernels[whole(0, 2)]);
      }
      if (method == "weak1" || method == "weak2") {
        const char *tests[] = {"gauss", "revised_gauss", "quartic", "heaviside"};
        methods_ += fmt::format("test_function = \"{}\"\n", tests[whole(0, 3)]);
      }
    }
    const char *elements[] = {"Q1", "Q2", "Q3", "Q2Q1"};
    methods_ += fmt::format("[[method]]\nname = \"fem\"\nelement = \"{}\"\n", elements[whole(0, 3)]);
  }

  sample_clouds::Uniform random_;
  bool ring_ = false, strain_ = false;
  double nu_ = 0, youngs_modulus_ = 0, load_ = 0;
  int seed_ = 0;
  std::string problem_, level_, methods_, solution_;
};

class RandomScenes : public testing::TestWithParam<int> {};

} // namespace

TEST_P(RandomScenes, end_with_finite_numbers_or_a_named_refusal_and_obey_scaling_and_symmetry) {
  const auto seed = static_cast<std::uint64_t>(GetParam());
  const RandomScene scene(seed);
  SCOPED_TRACE(fmt::format("seed {}\n{}", seed, scene.text()));
  const auto cells = run(read(scene.text()));
  ASSERT_EQ(cells.size(), 6u);
  int n_ok = 0;
  for (const auto &cell : cells) {
    ASSERT_TRUE(cell.status == reports::Status::ok || cell.status == reports::Status::refused) << name_of(cell);
    if (cell.status == reports::Status::refused) {
      EXPECT_GT(cell.reason.size(), 20u) << name_of(cell);
      continue;
    }
    ++n_ok;
    EXPECT_FALSE(cell.errors.empty()) << name_of(cell);
    for (const auto *numbers : {&cell.errors, &cell.quantities})
      for (const auto &[name, value] : *numbers)
        EXPECT_TRUE(std::isfinite(value)) << name_of(cell) << ": " << name;
    // Every method here is exact for a uniform strain but for the penalty, 1e-5, and for quadrature.
    if (scene.patch_test()) {
      EXPECT_LT(l2(cell), 1e-2) << name_of(cell);
    }
  }
  EXPECT_GE(n_ok, 4) << "most cells must be of use";

  // Linear elasticity: the solution is proportional to the load and to 1 / E, and of the other sign for the opposite
  // load. With powers of two no rounding differs, so neither may a bit of what is relative.
  // The finite elements' libraries promise no bits.
  const auto opposite = run(read(scene.text(-4)));
  const auto softer = run(read(scene.text(1, .125)));
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (const auto *other : {&opposite[i], &softer[i]}) {
      ASSERT_EQ(other->status, cells[i].status) << name_of(*other);
      for (const auto &[name, value] : cells[i].errors)
        if (name.ends_with("_relative")) {
          const double allowed = cells[i].label == "fem" ? 1e-9 * value + 1e-11 : 0;
          EXPECT_NEAR(value, error_of(*other, name), allowed) << name_of(cells[i]) << ", " << name;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::Range(1, 9));
