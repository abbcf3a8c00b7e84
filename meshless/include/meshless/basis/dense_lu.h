#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace meshless::basis {

/// LU factorisation with complete pivoting of a small dense matrix, for moment matrices that are not
/// symmetric or not positive definite. Its arrays grow to the largest matrix and stay.
class DenseLu {
public:
  /// Starts an n x n matrix of zeros.
  void resize(std::size_t n);
  std::size_t size() const { return n_; }
  double &operator()(std::size_t i, std::size_t j) { return data_[i * n_ + j]; }

  /// Rows and columns are first scaled by powers of two to entries of about one.
  /// @returns the smallest pivot over the largest; 0 if the matrix is singular or not finite
  double factorise();

  /// Solves A x = b in place; `factorise` must have returned more than 0.
  void solve(std::span<double> b);
  /// Solves A^T x = b in place.
  void solve_transposed(std::span<double> b);

private:
  std::size_t n_ = 0;
  std::vector<double> data_;
  std::vector<std::size_t> row_;    ///< row of the matrix that step k took its pivot from
  std::vector<std::size_t> column_; ///< likewise its column
  std::vector<double> row_scale_;
  std::vector<double> column_scale_;
  std::vector<double> scratch_;
};

} // namespace meshless::basis
