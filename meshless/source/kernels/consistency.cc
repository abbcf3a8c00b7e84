#include "meshless/kernels/consistency.h"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace meshless::kernels {

RestoredConsistency restore_consistency(double x, std::span<const double> positions, std::span<const double> volumes,
                                        double h, int order, const std::function<double(double)> &window) {
  if (positions.size() != volumes.size())
    throw std::invalid_argument(fmt::format("{} positions but {} volumes", positions.size(), volumes.size()));
  if (order < 0 || !(h > 0))
    throw std::invalid_argument(fmt::format("consistency of order {} with the smoothing length {}", order, h));
  const Eigen::Index n = order + 1;
  RestoredConsistency result;
  std::vector<double> windows(positions.size(), 1);
  Eigen::VectorXd moments = Eigen::VectorXd::Zero(2 * n - 1);
  std::size_t n_counted = 0;
  for (std::size_t j = 0; j < positions.size(); ++j) {
    const double s = (x - positions[j]) / h;
    if (window)
      windows[j] = window(s);
    n_counted += windows[j] != 0;
    double term = windows[j] * volumes[j];
    for (Eigen::Index k = 0; k < moments.size(); ++k, term *= s)
      moments[k] += term;
  }
  Eigen::MatrixXd matrix(n, n);
  for (Eigen::Index k = 0; k < n; ++k)
    matrix.row(k) = moments.segment(k, n).transpose();
  Eigen::FullPivLU<Eigen::MatrixXd> factor(matrix);
  factor.setThreshold(1e-13);
  if (!factor.isInvertible())
    throw std::runtime_error(
        fmt::format("no consistency of order {} at {}: {} particles count there, {} distinct ones are "
                    "needed",
                    order, x, n_counted, n));
  const Eigen::VectorXd b = factor.solve(Eigen::VectorXd::Unit(n, 0));
  result.coefficients.assign(b.begin(), b.end());
  for (std::size_t j = 0; j < positions.size(); ++j) {
    const double s = (x - positions[j]) / h;
    double sum = 0;
    for (Eigen::Index k = n; k-- > 0;)
      sum = sum * s + b[k];
    result.weights.push_back(sum * windows[j]);
  }
  return result;
}

} // namespace meshless::kernels
