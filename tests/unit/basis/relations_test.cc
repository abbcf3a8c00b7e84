// How the bases relate to each other, their derivatives to their values, and what they do with kernels that
// are negative somewhere.

#include "evaluate_basis.h"
#include "line_clouds.h"

#include "meshless/basis/basis_table.h"
#include "meshless/basis/derivative_operators.h"
#include "unit/cloud/sample_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace meshless;
using basis::make_basis;

/// Jittered particles with volumes; equal ones or such as differ by a factor of ten.
template <int dim>
cloud::Particles<dim> make_cloud(bool equal) {
  std::array<int, dim> n;
  n.fill(dim == 1 ? 20 : dim == 2 ? 8 : 5);
  cloud::Point<dim> low{};
  cloud::Point<dim> high;
  high.fill(1);
  auto points = sample_clouds::jittered_grid<dim>(n, low, high, .25, 31);
  const double h = 1. / (n[0] - 1);
  std::vector<double> volumes;
  sample_clouds::Uniform random(32);
  for (std::size_t i = 0; i < points.size(); ++i)
    volumes.push_back(std::pow(h, dim) * (equal ? 1 : random.between(.2, 2)));
  auto lengths = std::vector<double>(points.size(), h);
  return {std::move(points), std::move(lengths), std::move(volumes)};
}

template <int dim>
std::vector<cloud::Point<dim>> inside(std::size_t n) {
  cloud::Point<dim> low{};
  cloud::Point<dim> high;
  high.fill(1);
  return sample_clouds::random_points<dim>(n, low, high, 33);
}

constexpr basis::Wanted all_three{.value = true, .gradient = true, .hessian = true};

/// Largest difference of all quantities [first, last) over the largest entry of each.
template <int dim>
double difference(const basis::ShapeFunctionValues<dim> &a, const basis::ShapeFunctionValues<dim> &b,
                  std::size_t n_particles, std::size_t n_points, int first, int last) {
  double result = 0;
  for (int quantity = first; quantity < last; ++quantity) {
    double largest = 0;
    double differs = 0;
    for (std::size_t j = 0; j < n_particles; ++j)
      for (std::size_t p = 0; p < n_points; ++p) {
        largest = std::max(largest, std::abs(a.row(quantity, j)[p]));
        differs = std::max(differs, std::abs(a.row(quantity, j)[p] - b.row(quantity, j)[p]));
      }
    result = std::max(result, differs / largest);
  }
  return result;
}

template <int dim>
void relate() {
  constexpr int n_quantities = 1 + dim + dim * (dim + 1) / 2;
  const kernels::Gauss kernel(4);
  const auto points = inside<dim>(7);
  for (const bool equal : {true, false}) {
    const auto particles = make_cloud<dim>(equal);
    const auto at = [&](const char *name, bool volumes) {
      return evaluate_basis::at<dim>(*make_basis<dim>(name, 2, kernel, {.volumes = volumes}), particles, points,
                                     all_three);
    };
    const auto ssph = at("ssph", false);
    const auto weighted_ssph = at("ssph", true);
    const auto mls = at("mls", false);
    const auto weighted_mls = at("mls", true);
    const auto rkpm = at("rkpm", false);
    const auto apart = [&](const auto &a, const auto &b, int first, int last) {
      return difference<dim>(a.values, b.values, particles.size(), points.size(), first, last);
    };
    // The same sums in the same order, or up to a common factor: a few roundings at condition numbers below 1e4.
    const double rounding = 1e-12;
    EXPECT_LE(apart(weighted_ssph, rkpm, 0, 1), 1e-15) << "Zhang & Batra 2008, section 4: equal for f itself";
    EXPECT_GT(apart(weighted_ssph, rkpm, 1, n_quantities), .01) << "but not its derivatives";
    EXPECT_LE(apart(ssph, mls, 0, 1), 1e-15);
    EXPECT_EQ(apart(weighted_mls, rkpm, 0, n_quantities), 0);
    if (equal) {
      EXPECT_LT(apart(mls, rkpm, 0, n_quantities), rounding);
      EXPECT_LT(apart(ssph, weighted_ssph, 0, n_quantities), rounding);
    } else {
      EXPECT_GT(apart(mls, rkpm, 0, 1), .01) << "volumes count on irregular clouds";
      EXPECT_GT(apart(ssph, weighted_ssph, 0, 1), .01);
    }
  }
}

TEST(Relations, rkpm_ssph_and_mls) {
  relate<1>();
  relate<2>();
  relate<3>();
}

TEST(Relations, differentiated_gradient_of_ssph_is_the_gradient_of_mls) {
  const auto particles = make_cloud<2>(false);
  const auto points = inside<2>(9);
  const kernels::Gauss kernel(4);
  const auto ssph =
      evaluate_basis::at<2>(*make_basis<2>("ssph", 2, kernel), particles, points, {.differentiated_gradient = true});
  const auto mls = evaluate_basis::at<2>(*make_basis<2>("mls", 2, kernel), particles, points, {.gradient = true});
  for (int k = 0; k < 2; ++k)
    for (std::size_t j = 0; j < particles.size(); ++j)
      for (std::size_t p = 0; p < points.size(); ++p)
        EXPECT_EQ(ssph.values.differentiated_gradient(k, j)[p], mls.values.gradient(k, j)[p]);
}

/// Derivatives of shape functions of RKPM and SPH by central differences.
template <int dim>
void differentiate(const char *name, int order) {
  const auto particles = make_cloud<dim>(false);
  // Cut off where the kernel is below 1e-15: its edge is not felt.
  const auto shape = make_basis<dim>(name, order, kernels::Gauss(6));
  const double e = 1e-5;
  for (const auto &x : inside<dim>(3)) {
    std::vector<cloud::Point<dim>> points{x};
    for (int k = 0; k < dim; ++k)
      for (const double side : {-e, e}) {
        points.push_back(x);
        points.back()[k] += side;
      }
    const auto result = evaluate_basis::at<dim>(*shape, particles, points, all_three);
    const auto slope = [&](int quantity, int k, std::size_t j) {
      const double *row = result.values.row(quantity, j);
      return (row[2 * k + 2] - row[2 * k + 1]) / (2 * e);
    };
    const double n = std::pow(static_cast<double>(particles.size()), 1. / dim); // 1 / h
    for (std::size_t j = 0; j < particles.size(); ++j) {
      int kl = 0;
      for (int k = 0; k < dim; ++k) {
        // e^2 n^3 of the third derivative, and rounding 1e-15 / e at condition numbers of some hundred.
        EXPECT_NEAR(result.values.gradient(k, j)[0], slope(0, k, j), 1e-6 * n) << name << " " << j;
        for (int l = k; l < dim; ++l, ++kl)
          EXPECT_NEAR(result.values.hessian(kl, j)[0], slope(1 + l, k, j), 1e-5 * n * n) << name << " " << j;
      }
    }
  }
}

TEST(Derivatives, are_those_of_the_shape_functions) {
  for (const int order : {1, 2, 3}) {
    differentiate<1>("rkpm", order);
    differentiate<2>("rkpm", order);
    differentiate<2>("mls", order);
  }
  differentiate<3>("rkpm", 1);
  differentiate<3>("mls", 2);
  differentiate<1>("sph", 0);
  differentiate<2>("sph", 0);
  differentiate<3>("sph", 0);
}

TEST(Sph, is_the_plain_sum) {
  const auto particles = make_cloud<2>(false);
  const kernels::CubicSpline kernel;
  const auto points = inside<2>(5);
  const auto result = evaluate_basis::at<2>(*make_basis<2>("sph", 0, kernel), particles, points, {.value = true});
  for (std::size_t j = 0; j < particles.size(); ++j)
    for (std::size_t p = 0; p < points.size(); ++p) {
      const double h = particles.smoothing_length(j);
      const double s_squared = cloud::distance_squared<2>(points[p], particles.position(j)) / (h * h);
      const double W = s_squared < 4 ? 10 / (7 * std::numbers::pi) / (h * h) * kernel.value(s_squared) : 0;
      EXPECT_NEAR(result.values.value(j)[p], W * particles.volumes()[j], 1e-15);
    }
}

TEST(Cspm, second_derivative_of_a_quadratic_is_wrong_at_an_end) {
  // The first derivative there lacks f'' times what remains of the second moment, of order h; divided by h in (20) that
  // is of order one, whatever the number of particles: -.1435 instead of 2 for f = x^2.
  double last = 0;
  for (const int n : {20, 40, 80}) {
    const auto particles = line_clouds::rod(n);
    const auto operators =
        basis::make_derivative_operators<1>(*make_basis<1>("cspm", 2, kernels::Gauss(6)), particles, {.hessian = true});
    std::vector<double> f;
    for (const auto &x : particles.positions())
      f.push_back(x[0] * x[0]);
    std::vector<double> second(f.size());
    operators.hessian[0].multiply(f, second);
    EXPECT_GT(std::abs(second[0] - 2), 1) << n;
    EXPECT_NEAR(second[f.size() / 2], 2, 1e-11 * n * n) << "exact inside, where all is symmetric: rounding over h^2";
    if (last != 0) {
      EXPECT_NEAR(second[0], last, 1e-9 * n);
    }
    last = second[0];
  }
}

TEST(SuperGauss, indefinite_moment_matrices_are_noticed_and_solved) {
  // h = .6 D: W(D) = -.017, W(2 D) < 0: the second moments are negative, the zeroth is not.
  const auto particles = line_clouds::cell_centred(20, .6);
  for (const char *name : {"ssph", "mls", "rkpm"}) {
    const auto shape = make_basis<1>(name, 2, kernels::SuperGauss(6));
    const auto operators = basis::make_derivative_operators<1>(*shape, particles, all_three);
    EXPECT_EQ(operators.n_indefinite, 20u) << name;
    // The polynomials are reproduced all the same.
    std::vector<double> f;
    for (const auto &x : particles.positions())
      f.push_back(1 + x[0] - 3 * x[0] * x[0]);
    std::vector<double> estimate(f.size());
    operators.value->multiply(f, estimate);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(estimate[i], f[i], 1e-13) << name;
    operators.hessian[0].multiply(f, estimate);
    for (std::size_t i = 0; i < f.size(); ++i)
      EXPECT_NEAR(estimate[i], -6, 1e-13 * 400 * 10) << name << ": rounding over D^2";
  }
  // A positive kernel never is.
  const auto positive = basis::make_derivative_operators<1>(*make_basis<1>("ssph", 2, kernels::CubicSpline()),
                                                            line_clouds::cell_centred(20, 1.2), all_three);
  EXPECT_EQ(positive.n_indefinite, 0u);
}

} // namespace
