#include "meshless/linear_algebra/generalized_eigenvalues.h"

#include "meshless/linear_algebra/eigenvalues.h"
#include "meshless/linear_algebra/sparse_lu.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace meshless::linear_algebra {

namespace {

using Complex = std::complex<double>;

/// Vectors that the iteration starts from: it finds eigenvalues up to this often repeated, such as the three rigid
/// motions of a plane body.
constexpr Eigen::Index block = 4;

/// theta below this part of the largest is that of an infinite eigenvalue.
constexpr double infinite = 1e-14;

/// (K - shift M)^-1 M
class ShiftedInverse {
public:
  ShiftedInverse(const SparseRows &stiffness, const SparseRows &mass, double shift)
      : mass_(mass), shifted_(combine(1, stiffness, -shift, mass)), divisors_(shifted_.equilibrate_rows()),
        lu_(shifted_), scratch_(divisors_.size()) {}

  std::size_t size() const { return divisors_.size(); }
  void apply(std::span<const double> x, std::span<double> y) {
    mass_.multiply(x, scratch_);
    for (std::size_t i = 0; i < scratch_.size(); ++i)
      scratch_[i] /= divisors_[i];
    lu_.solve(scratch_, y);
  }

private:
  const SparseRows &mass_;
  SparseRows shifted_;
  std::vector<double> divisors_;
  SparseLu lu_;
  std::vector<double> scratch_;
};

void check(const SparseRows &stiffness, const SparseRows &mass) {
  if (stiffness.n_rows() != mass.n_rows() || stiffness.n_columns() != stiffness.n_rows() ||
      mass.n_columns() != mass.n_rows() || mass.n_rows() == 0)
    throw std::invalid_argument(fmt::format("eigenvalues need square matrices of one size; found {} x {} and {} x {}",
                                            stiffness.n_rows(), stiffness.n_columns(), mass.n_rows(),
                                            mass.n_columns()));
}

void sort(std::vector<Complex> &values) {
  std::sort(values.begin(), values.end(), [](const Complex &a, const Complex &b) {
    return a.real() != b.real() ? a.real() < b.real() : a.imag() < b.imag();
  });
}

} // namespace

std::vector<Complex> generalized_eigenvalues(const SparseRows &stiffness, const SparseRows &mass, double shift) {
  check(stiffness, mass);
  ShiftedInverse inverse(stiffness, mass, shift);
  const std::size_t n = inverse.size();
  std::vector<double> transposed(n * n); // the same eigenvalues
  std::vector<double> unit(n, 0);
  for (std::size_t j = 0; j < n; ++j) {
    unit[j] = 1;
    inverse.apply(unit, std::span<double>(transposed).subspan(j * n, n));
    unit[j] = 0;
  }
  const auto thetas = eigenvalues(transposed, n);
  double largest = 0;
  for (const auto &theta : thetas)
    largest = std::max(largest, std::abs(theta));
  std::vector<Complex> result;
  for (const auto &theta : thetas)
    if (std::abs(theta) > infinite * largest)
      result.push_back(shift + 1.0 / theta);
  sort(result);
  return result;
}

std::vector<Complex> nearest_eigenvalues(const SparseRows &stiffness, const SparseRows &mass, double shift,
                                         std::size_t wanted) {
  check(stiffness, mass);
  ShiftedInverse inverse(stiffness, mass, shift);
  const auto n = static_cast<Eigen::Index>(inverse.size());
  const Eigen::Index most = std::min<Eigen::Index>(n - block, 400);
  if (wanted == 0 || static_cast<Eigen::Index>(wanted) > most)
    throw std::invalid_argument(fmt::format("{} eigenvalues of {} rows; from 1 to {} can be found", wanted, n, most));
  Eigen::MatrixXd basis = Eigen::MatrixXd::Zero(n, most + block);
  Eigen::MatrixXd h = Eigen::MatrixXd::Zero(most + block, most);
  Eigen::VectorXd image(n);
  // Takes what `image` has beyond the first columns as the next one; what it had of them is added to `parts`.
  const auto append = [&](Eigen::Index column, Eigen::Ref<Eigen::VectorXd> parts) {
    const double before = image.norm();
    for (int pass = 0; pass < 2; ++pass) {
      const Eigen::VectorXd part = basis.leftCols(column).transpose() * image;
      image -= basis.leftCols(column) * part;
      parts += part;
    }
    const double rest = image.norm();
    if (!(rest > 1e-14 * before))
      return 0.0;
    basis.col(column) = image / rest;
    return rest;
  };
  std::mt19937 random(12345);
  Eigen::VectorXd x(n);
  for (Eigen::Index column = 0; column < block; ++column) {
    for (Eigen::Index i = 0; i < n; ++i)
      x[i] = static_cast<double>(random()) / 4294967296.0 - 0.5;
    inverse.apply({x.data(), inverse.size()}, {image.data(), inverse.size()});
    Eigen::VectorXd unused = Eigen::VectorXd::Zero(column);
    append(column, unused);
  }
  constexpr Eigen::Index between_looks = 10;
  for (Eigen::Index k = 0; k < most; ++k) {
    x = basis.col(k);
    inverse.apply({x.data(), inverse.size()}, {image.data(), inverse.size()});
    h(k + block, k) = append(k + block, h.col(k).head(k + block));
    const auto size = static_cast<std::size_t>(k + 1);
    if (k + 1 < most && (size < 2 * wanted || (k + 1) % between_looks != 0))
      continue;
    const Eigen::EigenSolver<Eigen::MatrixXd> small(h.topLeftCorner(k + 1, k + 1));
    std::vector<Eigen::Index> order(size);
    for (std::size_t i = 0; i < size; ++i)
      order[i] = static_cast<Eigen::Index>(i);
    const auto distance = [&](Eigen::Index i) { return std::abs(small.eigenvalues()[i]); };
    std::sort(order.begin(), order.end(), [&](auto i, auto j) { return distance(i) > distance(j); });
    bool converged = size >= wanted;
    std::vector<Complex> result;
    for (std::size_t i = 0; converged && i < wanted; ++i) {
      const Complex theta = small.eigenvalues()[order[i]];
      const Eigen::VectorXcd y = small.eigenvectors().col(order[i]);
      converged = (h.block(k + 1, 0, block, k + 1) * y).norm() <= 1e-10 * std::abs(theta);
      result.push_back(shift + 1.0 / theta);
    }
    if (converged) {
      sort(result);
      return result;
    }
  }
  throw std::runtime_error(fmt::format("{} eigenvalues of {} rows did not converge in {} vectors", wanted, n, most));
}

} // namespace meshless::linear_algebra
