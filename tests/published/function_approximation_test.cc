// The figures of Zhang & Batra 2008, sections 6.1 and 6.2: what a correct program gets, in both answers to the question
// whether a particle on the edge of a support belongs to it.

#include "comparisons/scene/reader.h"
#include "comparisons/study/catalogue.h"
#include "comparisons/study/run_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace {

using comparisons::reports::Cell;

/// Cells of a shipped scene by label and level; each scene is run once.
const std::map<std::string, Cell> &cells_of(const std::string &scene_name) {
  static std::map<std::string, std::map<std::string, Cell>> cache;
  auto &cells = cache[scene_name];
  if (!cells.empty())
    return cells;
  const auto catalogue = comparisons::study::shipped_catalogue();
  const auto result = comparisons::scene::read_scene(
      std::string(PETROV_SOURCE_DIR "/comparisons/benchmarks/function_approximation/") + scene_name + ".toml", {},
      comparisons::study::vocabulary_of(catalogue));
  EXPECT_TRUE(result.scene) << to_text(result.diagnostics);
  comparisons::study::RunOptions options;
  options.write_series = false;
  for (auto &cell : comparisons::study::run_scene(*result.scene, catalogue, options)) {
    EXPECT_EQ(cell.status, comparisons::reports::Status::ok) << cell.label << ": " << cell.reason;
    cells.emplace(cell.label + "@" + cell.level, cell);
  }
  return cells;
}

double error_of(const std::string &scene, const std::string &label, const std::string &level, const std::string &name) {
  return cells_of(scene).at(label + "@" + level).errors.at(name);
}

double quantity_of(const std::string &scene, const std::string &label, const std::string &level,
                   const std::string &name) {
  return cells_of(scene).at(label + "@" + level).quantities.at(name);
}

struct Row {
  const char *label;
  double l2, h1, h2;
};

/// Half a unit of the last digit that is known.
void expect_row(const Row &row, double tol_l2, double tol_h1, double tol_h2) {
  EXPECT_NEAR(error_of("scene", row.label, "10", "l2_sum"), row.l2, tol_l2) << row.label;
  EXPECT_NEAR(error_of("scene", row.label, "10", "h1_sum"), row.h1, tol_h1) << row.label;
  EXPECT_NEAR(error_of("scene", row.label, "10", "h2_sum"), row.h2, tol_h2) << row.label;
}

TEST(FunctionApproximation, Table1InBothAnswersToTheEdge) {
  expect_row({"ssph", 1.879e-2, 1.2148, 17.179}, 5.1e-6, 5.1e-5, 5.1e-4);
  expect_row({"rkpm", 1.879e-2, 0.730, 16.36}, 5.1e-6, 5.1e-4, 5.1e-3);
  expect_row({"rkpm edge included", 1.879e-2, 0.721, 33.39}, 5.1e-6, 5.1e-4, 5.1e-3);
  expect_row({"msph", 1.930e-2, 1.238, 17.24}, 5.1e-6, 5.1e-4, 5.1e-3);
  expect_row({"msph edge included", 3.670e-2, 1.472, 21.30}, 5.1e-6, 5.1e-4, 5.1e-3);
}

TEST(FunctionApproximation, RkpmEstimatesTheFunctionAsSsphDoes) {
  // (4.14): the same numbers; the bound is rounding of sums of terms of size one.
  EXPECT_NEAR(error_of("scene", "rkpm", "10", "l2_sum"), error_of("scene", "ssph", "10", "l2_sum"), 1e-14);
}

TEST(FunctionApproximation, Table2Slopes) {
  const std::map<std::string, std::array<double, 3>> slopes{{"ssph", {3.541, 1.957, 1.493}},
                                                            {"msph", {3.540, 1.956, 1.493}},
                                                            {"msph edge included", {3.547, 1.941, 1.493}},
                                                            {"rkpm", {3.541, 2.024, 1.488}},
                                                            {"rkpm edge included", {3.541, 1.877, 1.510}}};
  for (const auto &[label, expected] : slopes) {
    const char *names[] = {"l2_sum_slope", "h1_sum_slope", "h2_sum_slope"};
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(quantity_of("convergence", label, "500", names[k]), expected[k], 6e-4) << label << " " << names[k];
  }
}

TEST(FunctionApproximation, Tables3To5) {
  // ||e||_0 / 1e-6 and ||e||_1 / 1e-3 at h = 1.2 D and 1.4 D.
  const std::map<std::string, std::array<double, 4>> table{{"linear", {6.842, 3.125, 7.817, 3.501}},
                                                           {"quadratic", {3.008, 2.119, 4.864, 2.802}},
                                                           {"cubic_spline", {1.603, 1.564, 4.442, 2.197}},
                                                           {"quartic", {2.431, 1.703, 5.427, 2.473}},
                                                           {"revised_gauss", {4.301, 2.192, 6.363, 2.776}},
                                                           {"revised_super_gauss a=1.0", {2.627, 1.803, 5.063, 2.401}},
                                                           {"revised_super_gauss a=1.2", {1.769, 1.640, 4.144, 2.179}},
                                                           {"revised_super_gauss a=1.4", {1.141, 1.522, 3.298, 1.987}},
                                                           {"revised_super_gauss a=1.6", {0.712, 1.440, 2.551, 1.827}}};
  for (const auto &[kernel, expected] : table) {
    std::size_t i = 0;
    for (const char *h : {" h=1.2", " h=1.4"}) {
      EXPECT_NEAR(error_of("kernels", kernel + h, "20", "l2_sum") / 1e-6, expected[i++], 5.1e-4) << kernel << h;
      EXPECT_NEAR(error_of("kernels", kernel + h, "20", "h1_sum") / 1e-3, expected[i++], 5.1e-4) << kernel << h;
    }
  }
}

TEST(FunctionApproximation, CoefficientsFromFormulaAndFromShapeFunctions) {
  // The revised Gauss kernel in closed form: W1 = e^(-1/1.44) - e^-4, W2 = e^(-4/1.44) - e^-4, c2 = W2 / (W2 + W1/4) =
  // .267249, half a unit of the last digit below .2673.
  const std::map<std::string, std::array<double, 2>> table{{"linear", {.01944, .5333}},
                                                           {"quadratic", {.00990, .2462}},
                                                           {"cubic_spline", {.00600, .0863}},
                                                           {"quartic", {.00866, .1267}},
                                                           {"revised_gauss", {.01369, .26725}},
                                                           {"revised_super_gauss a=1.0", {.00914, .1555}},
                                                           {"revised_super_gauss a=1.2", {.00648, .1083}},
                                                           {"revised_super_gauss a=1.4", {.00437, .0741}},
                                                           {"revised_super_gauss a=1.6", {.00281, .0501}}};
  for (const auto &[kernel, expected] : table) {
    const std::string label = kernel + " h=1.2";
    EXPECT_NEAR(quantity_of("kernels", label, "20", "c1"), expected[0], 5.1e-6) << kernel;
    EXPECT_NEAR(quantity_of("kernels", label, "20", "c2"), expected[1], 5.1e-5) << kernel;
    // Both formulas are right as printed: shape functions give the same to rounding.
    EXPECT_NEAR(quantity_of("kernels", label, "20", "c1"), quantity_of("kernels", label, "20", "c1_formula"), 1e-14);
    EXPECT_NEAR(quantity_of("kernels", label, "20", "c2"), quantity_of("kernels", label, "20", "c2_formula"), 1e-13);
  }
}

TEST(FunctionApproximation, Table6Slopes) {
  const std::map<std::string, std::array<double, 2>> table{
      {"linear", {1.9902, 1.9882}},        {"quadratic", {2.0006, 1.9926}},
      {"cubic_spline", {2.0141, 1.9993}},  {"quartic", {2.0096, 1.9956}},
      {"revised_gauss", {1.9993, 1.9927}}, {"revised_super_gauss a=1.6", {2.0189, 2.0064}}};
  for (const auto &[kernel, expected] : table) {
    EXPECT_NEAR(quantity_of("kernel_convergence", kernel + " h=1.2", "500", "h1_sum_slope"), expected[0], 2e-4)
        << kernel;
    EXPECT_NEAR(quantity_of("kernel_convergence", kernel + " h=1.4", "500", "h1_sum_slope"), expected[1], 2e-4)
        << kernel;
  }
}

/// What the reader says of a scene with this body.
std::string findings(const std::string &body) {
  const auto catalogue = comparisons::study::shipped_catalogue();
  const auto result =
      comparisons::scene::read_scene_text("schema = 1\ntitle = \"t\"\nbenchmark = \"function_approximation\"\n" + body,
                                          "scene.toml", {}, comparisons::study::vocabulary_of(catalogue));
  EXPECT_FALSE(result.scene);
  return to_text(result.diagnostics);
}

TEST(FunctionApproximation, RefusesByNameBeforeComputing) {
  const std::string method = "[[method]]\nname = \"estimate\"\n";
  const auto contains = [](const std::string &text, const std::string &part) {
    return text.find(part) != std::string::npos;
  };
  const auto linear = findings(method + "basis = \"msph\"\nkernel = \"linear\"\n[study]\nlevels = [10]\n");
  EXPECT_TRUE(contains(linear, "msph") || contains(linear, "MSPH")) << linear;
  EXPECT_TRUE(contains(linear, "linear")) << linear;
  const auto no_parse = findings("[problem]\nfunction = \"sin(8*(1-x)\"\n" + method + "[study]\nlevels = [10]\n");
  EXPECT_TRUE(contains(no_parse, "scene.toml:5:")) << no_parse;
  EXPECT_TRUE(contains(no_parse, "is no function of x")) << no_parse;
  const auto infinite = findings("[problem]\nfunction = \"1/x\"\n" + method + "[study]\nlevels = [10]\n");
  EXPECT_TRUE(contains(infinite, "not finite at (0,")) << infinite;
  const auto variable = findings("[problem]\nfunction = \"x*y\"\n" + method + "[study]\nlevels = [10]\n");
  EXPECT_TRUE(contains(variable, "is no function of x")) << variable;
  const auto few = findings(method + "[study]\nlevels = [2]\n");
  EXPECT_TRUE(contains(few, "at least 3")) << few;
}

TEST(FunctionApproximation, IndefiniteMomentMatricesAreNoticedAndSolved) {
  std::size_t noticed = 0;
  for (const auto &[name, cell] : cells_of("indefinite")) {
    for (const auto &warning : cell.warnings)
      noticed += warning.find("not positive definite") != std::string::npos;
    // Reproduction of quadratics holds whatever the sign of the weights: the estimate stays one.
    EXPECT_LT(cell.errors.at("l2_sum"), 1e-2) << name;
  }
  EXPECT_GT(noticed, 0u);
}

TEST(FunctionApproximation, InterpolantsConvergeAsTheorySays) {
  // Lagrange interpolation of degree p: h^(p+1), h^p, h^(p-1) in L2, H1, H2 (true integrals).
  for (int p = 1; p <= 3; ++p) {
    const std::string label = "fem Q" + std::to_string(p);
    const double coarse = 50;
    const double fine = 500;
    const double spacing = std::log(fine / coarse);
    const auto rate = [&](const char *name) {
      return std::log(error_of("convergence", label, "50", name) / error_of("convergence", label, "500", name)) /
             spacing;
    };
    EXPECT_NEAR(rate("l2"), p + 1, .1) << label;
    EXPECT_NEAR(rate("h1"), p, .1) << label;
    EXPECT_NEAR(rate("h2"), p - 1, .1) << label;
  }
}

} // namespace
