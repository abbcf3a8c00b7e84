// Zhang & Batra 2008, section 6: error norms of kernel estimates, and the coefficients c1, c2.

#include "line_clouds.h"

#include "meshless/basis/basis_table.h"
#include "meshless/basis/derivative_operators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace {

using namespace meshless;
using basis::EdgeRule;
using Functions = std::array<std::function<double(double)>, 3>; // f, f', f''

/// Norms of the error of f, f', f'' as sums over the particles (sections 6.1, 6.2).
std::array<double, 3> errors(const basis::ShapeFunctions<1> &shape, const cloud::Particles<1> &particles,
                             const Functions &exact) {
  const auto operators =
      basis::make_derivative_operators<1>(shape, particles, {.value = true, .gradient = true, .hessian = true});
  const linear_algebra::SparseRows *rows[] = {&*operators.value, &operators.gradient[0], &operators.hessian[0]};
  std::vector<double> f;
  for (const auto &x : particles.positions())
    f.push_back(exact[0](x[0]));
  std::array<double, 3> result{};
  std::vector<double> estimate(f.size());
  for (std::size_t k = 0; k < 3; ++k) {
    rows[k]->multiply(f, estimate);
    for (std::size_t i = 0; i < f.size(); ++i)
      result[k] += particles.volumes()[i] * std::pow(estimate[i] - exact[k](particles.position(i)[0]), 2);
    result[k] = std::sqrt(result[k]);
  }
  return result;
}

const Functions sine = {[](double x) { return std::sin(8 * (1 - x)) / std::sin(8.); },
                        [](double x) { return -8 * std::cos(8 * (1 - x)) / std::sin(8.); },
                        [](double x) { return -64 * std::sin(8 * (1 - x)) / std::sin(8.); }};
const Functions bell = {[](double x) { return std::exp(-x * x); }, [](double x) { return -2 * x * std::exp(-x * x); },
                        [](double x) { return (4 * x * x - 2) * std::exp(-x * x); }};

struct TableOne {
  const char *basis;
  EdgeRule edge;
  std::array<double, 3> norms;
};
class TableOneTest : public testing::TestWithParam<TableOne> {};

// The figures of an independent computation with the particles at exactly 2 h left out or counted; the paper's
// own row for MSPH, and for RKPM in H1 and H2, lies between them (its rounding decided particle by particle).
INSTANTIATE_TEST_SUITE_P(ZhangBatra, TableOneTest,
                         testing::Values(TableOne{"ssph", EdgeRule::excluded, {1.879e-2, 1.2148, 17.179}},
                                         TableOne{"ssph", EdgeRule::included, {1.879e-2, 1.2148, 17.179}},
                                         TableOne{"rkpm", EdgeRule::excluded, {1.879e-2, .730, 16.36}},
                                         TableOne{"rkpm", EdgeRule::included, {1.879e-2, .721, 33.39}},
                                         TableOne{"msph", EdgeRule::excluded, {1.930e-2, 1.238, 17.24}},
                                         TableOne{"msph", EdgeRule::included, {3.670e-2, 1.472, 21.30}}));

TEST_P(TableOneTest, norms) {
  const auto particles = line_clouds::cell_centred(10, 1.5);
  const auto shape = basis::make_basis<1>(GetParam().basis, 2, kernels::RevisedGauss(), {.edge = GetParam().edge});
  const auto computed = errors(*shape, particles, sine);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(computed[k], GetParam().norms[k], 7e-4 * GetParam().norms[k]) << k << ": three to five digits given";
}

double slope(const char *name, EdgeRule edge, std::size_t norm) {
  const auto shape = basis::make_basis<1>(name, 2, kernels::RevisedGauss(), {.edge = edge});
  std::vector<double> x;
  std::vector<double> y;
  for (const int n : {10, 20, 30, 50, 100, 250, 500}) {
    x.push_back(std::log(1. / n));
    y.push_back(std::log(errors(*shape, line_clouds::cell_centred(n, 1.5), sine)[norm]));
  }
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const auto n = static_cast<double>(x.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

TEST(TableTwo, slopes) {
  struct Row {
    const char *basis;
    EdgeRule edge;
    std::array<double, 3> slopes;
  };
  const Row rows[] = {{"ssph", EdgeRule::excluded, {3.541, 1.957, 1.493}},
                      {"msph", EdgeRule::excluded, {3.540, 1.956, 1.493}},
                      {"msph", EdgeRule::included, {3.547, 1.941, 1.493}},
                      {"rkpm", EdgeRule::excluded, {3.541, 2.024, 1.488}},
                      {"rkpm", EdgeRule::included, {3.541, 1.877, 1.510}}};
  for (const auto &row : rows)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(slope(row.basis, row.edge, k), row.slopes[k], 1e-3)
          << row.basis << " " << static_cast<int>(row.edge) << " " << k << ": digits given";
}

struct KernelRow {
  const char *kernel;
  std::optional<double> parameter;
  std::array<double, 2> at12; ///< ||e||_0 / 1e-6, ||e||_1 / 1e-3 for h = 1.2 D
  std::array<double, 2> at14;
  double c1; ///< for h = 1.2 D
  double c2;
};
const KernelRow kernel_rows[] = {
    {"linear", {}, {6.842, 3.125}, {7.817, 3.501}, .01944, .5333},
    {"quadratic", {}, {3.008, 2.119}, {4.864, 2.802}, .00990, .2462},
    {"cubic_spline", {}, {1.603, 1.564}, {4.442, 2.197}, .00600, .0863},
    {"quartic", {}, {2.431, 1.703}, {5.427, 2.473}, .00866, .1267},
    {"revised_gauss", {}, {4.301, 2.192}, {6.363, 2.776}, .01369, .2673},
    {"revised_super_gauss", 1.0, {2.627, 1.803}, {5.063, 2.401}, .00914, .1555},
    {"revised_super_gauss", 1.2, {1.769, 1.640}, {4.144, 2.179}, .00648, .1083},
    {"revised_super_gauss", 1.4, {1.141, 1.522}, {3.298, 1.987}, .00437, .0741},
    {"revised_super_gauss", 1.6, {.712, 1.440}, {2.551, 1.827}, .00281, .0501},
};

TEST(TablesThreeToFive, norms_of_all_kernels) {
  for (const auto &row : kernel_rows) {
    const auto shape = basis::make_basis<1>("ssph", 2, kernels::make_kernel(row.kernel, {}, row.parameter));
    for (const bool wide : {false, true}) {
      const auto computed = errors(*shape, line_clouds::cell_centred(20, wide ? 1.4 : 1.2), bell);
      const auto &expected = wide ? row.at14 : row.at12;
      EXPECT_NEAR(computed[0] * 1e6, expected[0], 6e-4) << row.kernel << " " << wide << ": three decimals given";
      EXPECT_NEAR(computed[1] * 1e3, expected[1], 6e-4) << row.kernel << " " << wide;
    }
  }
}

TEST(Coefficients, c1_and_c2_are_those_of_the_shape_functions) {
  // (6.13): the value of particle i + 2 is -3 c1; (6.14): its first derivative is c2 / (4 D).
  const int n = 21;
  const auto particles = line_clouds::cell_centred(n, 1.2);
  for (const auto &row : kernel_rows) {
    const auto kernel = kernels::make_kernel(row.kernel, {}, row.parameter);
    const auto W = [&](double s) { return std::visit([=](const auto &k) { return k.value(s * s); }, kernel); };
    const double W0 = W(0), W1 = W(1 / 1.2), W2 = W(2 / 1.2);
    const double c1 = W2 / W0 / (1 + 16 * W2 / W1 + 18 * W2 / W0);
    const double c2 = W2 / W1 / (W2 / W1 + .25);
    // Four digits given; c2 of the revised Gauss is .26725, between two of them.
    EXPECT_NEAR(c1, row.c1, 5.1e-6) << row.kernel;
    EXPECT_NEAR(c2, row.c2, 5.2e-5) << row.kernel;
    const auto shape = basis::make_basis<1>("ssph", 2, kernel);
    const auto operators = basis::make_derivative_operators<1>(*shape, particles, {.value = true, .gradient = true});
    std::vector<double> unit(n, 0);
    unit[12] = 1;
    std::vector<double> column(n);
    operators.value->multiply(unit, column);
    EXPECT_NEAR(column[10], -3 * c1, 4e-15) << row.kernel; // a few roundings at condition 50
    operators.gradient[0].multiply(unit, column);
    EXPECT_NEAR(column[10], c2 * n / 4, 4e-15 * n) << row.kernel;
  }
}

} // namespace
