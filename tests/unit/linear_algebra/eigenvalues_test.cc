#include "meshless/linear_algebra/eigenvalues.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace {

using meshless::linear_algebra::eigenvalues;
using meshless::linear_algebra::largest_imaginary_part;
constexpr double eps = std::numeric_limits<double>::epsilon();

TEST(Eigenvalues, TridiagonalToeplitzHasTheClosedForm) {
  // Rows (a, b, c): b + 2 sqrt(a c) cos(k pi / (n + 1)). With a != c it is not symmetric, but similar to a
  // symmetric matrix: all eigenvalues are real.
  constexpr std::size_t n = 30;
  constexpr double a = 2, b = -1, c = .5;
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    matrix[i * n + i] = b;
    if (i > 0)
      matrix[i * n + i - 1] = a;
    if (i + 1 < n)
      matrix[i * n + i + 1] = c;
  }
  const auto values = eigenvalues(matrix, n);
  ASSERT_EQ(values.size(), n);
  // Condition of an eigenvalue: the similarity diag((a/c)^(i/2)), 2^29 at most; far less in effect.
  for (std::size_t k = 0; k < n; ++k)
    EXPECT_NEAR(values[n - 1 - k].real(),
                b + 2 * std::sqrt(a * c) * std::cos(static_cast<double>(k + 1) * std::numbers::pi / (n + 1)),
                std::ldexp(3 * eps, 29));
}

TEST(Eigenvalues, ARotationHasAConjugatePair) {
  const double angle = .3;
  const std::vector<double> matrix{std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, -2};
  const auto values = eigenvalues(matrix, 3);
  EXPECT_NEAR(values[0].real(), -2, 10 * eps);
  EXPECT_EQ(values[0].imag(), 0);
  EXPECT_NEAR(values[1].real(), std::cos(angle), 10 * eps);
  EXPECT_NEAR(values[1].imag(), -std::sin(angle), 10 * eps);
  EXPECT_EQ(values[2], std::conj(values[1]));
  EXPECT_NEAR(largest_imaginary_part(values), std::sin(angle), 10 * eps);
}

TEST(Eigenvalues, RowsAreRows) {
  // Triangular: the diagonal, whatever stands above it.
  const std::vector<double> matrix{3, 100, 7, 0, -1, 5, 0, 0, 2};
  const auto values = eigenvalues(matrix, 3);
  EXPECT_EQ(values[0].real(), -1);
  EXPECT_EQ(values[1].real(), 2);
  EXPECT_EQ(values[2].real(), 3);
}

TEST(Eigenvalues, RefusesWhatHasNone) {
  EXPECT_THROW(eigenvalues({}, 0), std::invalid_argument);
  EXPECT_THROW(eigenvalues(std::vector<double>(3), 2), std::invalid_argument);
  const std::vector<double> bad{1, 2, std::nan(""), 4};
  try {
    eigenvalues(bad, 2);
    FAIL();
  } catch (const std::invalid_argument &error) {
    EXPECT_NE(std::string(error.what()).find("row 1, column 0"), std::string::npos) << error.what();
  }
}

} // namespace
