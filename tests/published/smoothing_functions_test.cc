// The conditions of Liu, Liu & Lam 2003 for the paper's functions, against closed forms.

#include "comparisons/scene/reader.h"
#include "comparisons/study/catalogue.h"
#include "comparisons/study/run_scene.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

namespace {

using comparisons::reports::Cell;

/// Cells of the shipped scene by label and dimension.
const std::map<std::string, Cell> &cells() {
  static const auto all = [] {
    std::map<std::string, Cell> result;
    const auto catalogue = comparisons::study::shipped_catalogue();
    const auto scene =
        comparisons::scene::read_scene(PETROV_SOURCE_DIR "/comparisons/benchmarks/smoothing_functions/scene.toml", {},
                                       comparisons::study::vocabulary_of(catalogue));
    EXPECT_TRUE(scene.scene) << to_text(scene.diagnostics);
    comparisons::study::RunOptions options;
    options.write_series = false;
    for (auto &cell : comparisons::study::run_scene(*scene.scene, catalogue, options)) {
      EXPECT_EQ(cell.status, comparisons::reports::Status::ok) << cell.label << ": " << cell.reason;
      result.emplace(cell.label + "@" + cell.variant, cell);
    }
    return result;
  }();
  return all;
}

double quantity(const std::string &label, int dim, const std::string &name) {
  return cells().at(label + "@dimension=" + std::to_string(dim)).quantities.at(name);
}

TEST(SmoothingFunctions, EveryKernelIsNormalisedInEveryDimension) {
  for (const auto &[name, cell] : cells())
    if (cell.method != "printed") {
      // Gauss quadrature of polynomials and Gaussians, to rounding.
      EXPECT_NEAR(cell.quantities.at("integral"), 1, 1e-12) << name;
    }
}

TEST(SmoothingFunctions, SecondMoments) {
  // Fractions of the polynomials' exact integrals.
  const std::map<std::string, std::array<double, 3>> exact{{"dome", {1.0 / 5, 1.0 / 3, 3.0 / 7}},
                                                           {"cubic_spline", {1.0 / 3, 31.0 / 49, 9.0 / 10}},
                                                           {"quintic", {1.0 / 2, .966179, 7.0 / 5}},
                                                           {"new_quartic", {104.0 / 315, 30.0 / 49, 11.0 / 13}}};
  for (const auto &[kernel, moments] : exact)
    for (int dim = 1; dim <= 3; ++dim) {
      const double tolerance = kernel == "quintic" && dim == 2 ? 1e-6 : 1e-10;
      for (const std::string prefix : {"kernel kernel=", "constructed construct="})
        EXPECT_NEAR(quantity(prefix + kernel, dim, "second_moment"), moments[static_cast<std::size_t>(dim - 1)],
                    tolerance)
            << prefix << kernel << " in " << dim << " dimensions";
    }
}

TEST(SmoothingFunctions, ConstructedFunctionsAreTheKernels) {
  for (const auto &[name, cell] : cells())
    if (cell.method == "constructed") {
      EXPECT_LT(cell.errors.at("difference_from_kernel"), 1e-13) << name;
    }
}

TEST(SmoothingFunctions, TheNewQuarticIsNegativeNearItsEdge) {
  for (int dim = 1; dim <= 3; ++dim) {
    // The root of 1/6 + S/6 - 5 S^2/32 between 1 and 2.
    EXPECT_NEAR(quantity("kernel kernel=new_quartic", dim, "negative_from"), (8 + std::sqrt(304.0)) / 15, 1e-9);
    EXPECT_NEAR(quantity("kernel kernel=new_quartic", dim, "negative_from"), 1.6957, 5e-5);
    EXPECT_NEAR(quantity("kernel kernel=new_quartic", dim, "negative_to"), 2, 1e-9);
    EXPECT_EQ(quantity("kernel kernel=new_quartic", dim, "holds_monotone"), 0);
  }
  EXPECT_NEAR(quantity("kernel kernel=new_quartic", 1, "least_value"), -1.583e-3, 5e-7);
  EXPECT_NEAR(quantity("kernel kernel=new_quartic", 1, "edge_curvature"), -0.25, 1e-9);
}

TEST(SmoothingFunctions, Misprints) {
  const double cubic[] = {1.0278, 1.0833, 1.1667};
  for (int dim = 1; dim <= 3; ++dim)
    EXPECT_NEAR(quantity("printed form=cubic (41)", dim, "integral"), cubic[dim - 1], 5e-5);
  EXPECT_NEAR(quantity("printed form=quintic (42)", 3, "integral"), 1.00279, 5e-6);
}

} // namespace
