#include "meshless/linear_algebra/eigenvalues.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace meshless::linear_algebra {

std::vector<std::complex<double>> eigenvalues(std::span<const double> matrix, std::size_t n) {
  if (n == 0 || matrix.size() != n * n)
    throw std::invalid_argument(fmt::format("eigenvalues of {} rows need {} entries; {} were given", n,
                                            n == 0 ? "1 or more" : fmt::format("{}", n * n), matrix.size()));
  for (std::size_t k = 0; k < matrix.size(); ++k)
    if (!std::isfinite(matrix[k]))
      throw std::invalid_argument(fmt::format("the entry in row {}, column {} is {}; eigenvalues need finite entries",
                                              k / n, k % n, matrix[k]));
  using Dense = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto size = static_cast<Eigen::Index>(n);
  const Eigen::MatrixXd dense = Eigen::Map<const Dense>(matrix.data(), size, size);
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(dense, false);
  if (solver.info() != Eigen::Success)
    throw std::runtime_error(fmt::format("the QR iteration for the eigenvalues of {} rows does not converge", n));
  std::vector<std::complex<double>> result(solver.eigenvalues().begin(), solver.eigenvalues().end());
  std::sort(result.begin(), result.end(), [](const std::complex<double> &a, const std::complex<double> &b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
  return result;
}

double largest_imaginary_part(std::span<const std::complex<double>> eigenvalues) {
  double largest = 0;
  for (const auto &value : eigenvalues)
    largest = std::max(largest, std::abs(value.imag()));
  return largest;
}

} // namespace meshless::linear_algebra
