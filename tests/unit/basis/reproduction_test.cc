// SSPH in one to three dimensions, orders 1 to 4: reproduction of polynomials, and agreement with a
// dense solution in long double, on uniform, graded and jittered clouds.

#include "dense_ssph.h"
#include "evaluate_basis.h"

#include "meshless/basis/monomials.h"
#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

namespace {

using namespace meshless;
using evaluate_basis::everything;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

enum class Layout { uniform, graded, jittered };

template <int dim>
cloud::Particles<dim> make_cloud(Layout layout) {
  std::array<int, dim> n;
  n.fill(dim == 1 ? 30 : dim == 2 ? 12 : 6);
  cloud::Point<dim> low{};
  cloud::Point<dim> high;
  high.fill(1);
  switch (layout) {
  case Layout::uniform:
    return sample_clouds::with_mean_lengths<dim>(sample_clouds::grid<dim>(n, low, high));
  case Layout::graded:
    return sample_clouds::with_mean_lengths<dim>(sample_clouds::graded_grid<dim>(n));
  case Layout::jittered:
    break;
  }
  return sample_clouds::with_mean_lengths<dim>(sample_clouds::jittered_grid<dim>(n, low, high, .25, 17));
}

/// Inside, on faces, in corners, and some of the particles.
template <int dim>
std::vector<cloud::Point<dim>> probes(const cloud::Particles<dim> &particles) {
  cloud::Point<dim> low{};
  cloud::Point<dim> high;
  high.fill(1);
  auto points = sample_clouds::random_points<dim>(dim == 3 ? 3 : 12, low, high, 18);
  for (int k = 0; k < dim; ++k)
    for (const double side : {0., 1.})
      for (auto x : sample_clouds::random_points<dim>(dim == 3 ? 1 : 2, low, high, 19)) {
        x[k] = side;
        points.push_back(x);
      }
  for (int corner = 0; corner < 1 << dim; corner += dim == 3 ? 3 : 1) {
    cloud::Point<dim> x;
    for (int k = 0; k < dim; ++k)
      x[k] = (corner >> k) & 1;
    points.push_back(x);
  }
  for (std::size_t i = 0; i < particles.size(); i += particles.size() / 3)
    points.push_back(particles.position(i));
  return points;
}

/// One cloud, one order: all shape functions at the probes, from the library and from the dense solution.
template <int dim>
class SsphCase {
public:
  SsphCase(Layout layout, int order)
      : order_(order), particles_(make_cloud<dim>(layout)), points_(probes(particles_)),
        basis_(basis::make_ssph<dim>(order, kernels::Gauss(order + 2))),
        result_(evaluate_basis::at<dim>(*basis_, particles_, points_, everything(order))) {}

  void check() const {
    for (std::size_t q = 0; q < points_.size(); ++q) {
      const auto dense = dense_ssph::evaluate<dim>(particles_, order_, order_ + 2, points_[q], result_.scale);
      check_quantity(0, q, {}, dense.value, dense.condition);
      for (int k = 0; k < dim; ++k) {
        std::array<int, dim> first{};
        ++first[k];
        check_quantity(1 + k, q, first, dense.gradient[k], dense.condition);
        check_quantity(1 + dim + n_hessian + k, q, first, dense.differentiated_gradient[k], dense.condition);
        for (int l = k; l < dim && order_ >= 2; ++l) {
          auto second = first;
          ++second[l];
          check_quantity(1 + dim + hessian_index(k, l), q, second, dense.hessian[k][l], dense.condition);
        }
      }
    }
  }

private:
  static constexpr int n_hessian = basis::ShapeFunctionValues<dim>::n_hessian;

  /// Order 11, 12, .., 22, ..
  static int hessian_index(int k, int l) {
    int index = l - k;
    for (int i = 0; i < k; ++i)
      index += dim - i;
    return index;
  }

  void check_quantity(int quantity, std::size_t q, const std::array<int, dim> &derivative,
                      const std::vector<dense_ssph::Real> &dense, double condition) const {
    SCOPED_TRACE(testing::Message() << "quantity " << quantity << " at probe " << q << ", condition " << condition);
    expect_dense(quantity, q, dense, condition);
    for (const auto &alpha : dense_ssph::exponents<dim>(order_))
      expect_reproduction(quantity, q, alpha, derivative, condition);
  }

  /// The solution of a system with this condition number by a backward stable method.
  void expect_dense(int quantity, std::size_t q, const std::vector<dense_ssph::Real> &dense, double condition) const {
    dense_ssph::Real largest = 0;
    dense_ssph::Real error = 0;
    for (std::size_t j = 0; j < dense.size(); ++j) {
      largest = std::max(largest, std::abs(dense[j]));
      error = std::max(error, std::abs(result_.values.row(quantity, j)[q] - dense[j]));
    }
    EXPECT_LT(error, 20 * epsilon * condition * static_cast<double>(largest));
  }

  /// sum_J phi_J p(xi_J) is the derivative of p at the point, for the monomial p about the point.
  void expect_reproduction(int quantity, std::size_t q, const std::array<int, dim> &alpha,
                           const std::array<int, dim> &derivative, double condition) const {
    int degree = 0;
    double exact = 1;
    for (const int a : derivative) {
      degree += a;
      exact *= a == 2 ? 2 : 1;
    }
    if (alpha != derivative)
      exact = 0;
    double sum = 0;
    double size = exact;
    for (std::size_t j = 0; j < particles_.size(); ++j) {
      std::array<dense_ssph::Real, dim> d;
      for (int k = 0; k < dim; ++k)
        d[k] = (particles_.position(j)[k] - points_[q][k]) / result_.scale;
      const double term = std::pow(result_.scale, degree) * result_.values.row(quantity, j)[q] *
                          static_cast<double>(dense_ssph::monomial<dim>(alpha, d));
      sum += term;
      size += std::abs(term);
    }
    // A sum of up to 216 terms, and what one step of refinement leaves: the square of eps times the
    // condition number.
    const double refined = epsilon * condition;
    EXPECT_NEAR(sum, exact, (250 * epsilon + refined * refined) * size);
  }

  int order_;
  cloud::Particles<dim> particles_;
  std::vector<cloud::Point<dim>> points_;
  std::unique_ptr<basis::ShapeFunctions<dim>> basis_;
  evaluate_basis::Result<dim> result_;
};

class SsphReproduction : public testing::TestWithParam<std::tuple<Layout, int>> {
protected:
  template <int dim>
  static void check() {
    SsphCase<dim>(std::get<0>(GetParam()), std::get<1>(GetParam())).check();
  }
};
INSTANTIATE_TEST_SUITE_P(LayoutsAndOrders, SsphReproduction,
                         testing::Combine(testing::Values(Layout::uniform, Layout::graded, Layout::jittered),
                                          testing::Range(1, 5)));

TEST_P(SsphReproduction, polynomials_and_dense_solution_in_1d) { check<1>(); }
TEST_P(SsphReproduction, polynomials_and_dense_solution_in_2d) { check<2>(); }
TEST_P(SsphReproduction, polynomials_and_dense_solution_in_3d) { check<3>(); }

template <int dim, int order>
void expect_all_monomials() {
  using Terms = basis::Monomials<dim, order>;
  EXPECT_EQ(Terms::size, basis::n_monomials(dim, order));
  auto expected = dense_ssph::exponents<dim>(order);
  EXPECT_EQ(Terms::size, expected.size());
  std::array<double, dim> d;
  for (int k = 0; k < dim; ++k)
    d[k] = 1.5 - k;
  std::array<double, Terms::size> values;
  Terms::evaluate(d, values);
  int last_degree = 0;
  for (std::size_t t = 0; t < Terms::size; ++t) {
    const auto &alpha = Terms::table.exponents[t];
    EXPECT_EQ(std::erase(expected, alpha), 1u) << "each once";
    EXPECT_EQ(Terms::index_of(alpha), t);
    int degree = 0;
    double product = 1;
    for (int k = 0; k < dim; ++k) {
      degree += alpha[k];
      product *= std::pow(d[k], alpha[k]);
    }
    EXPECT_GE(degree, last_degree) << "graded";
    last_degree = degree;
    EXPECT_EQ(values[t], product) << "exact: short binary fractions";
  }
}

TEST(Monomials, are_complete_and_graded) {
  expect_all_monomials<1, 4>();
  expect_all_monomials<2, 1>();
  expect_all_monomials<2, 4>();
  expect_all_monomials<3, 2>();
  expect_all_monomials<3, 4>();
}

} // namespace
