#pragma once

#include "meshless/basis/dense_lu.h"

#include <cstddef>
#include <span>
#include <vector>

namespace meshless::basis {

/// A Taylor series projected on test functions at one point: sum_J t_J f_J = (sum_J t_J p_J^T) Q with the terms
/// p_J of the series and the test functions t_J at the neighbours, weights included. The coefficient
/// Q_r = sum_J (u . t_J) f_J with A^T u = e_r, A = sum_J t_J p_J^T.
///
/// Arrays grow to the largest neighbourhood and stay.
class TaylorProjection {
public:
  void resize(std::size_t n_terms, std::size_t n_neighbours);
  std::span<double> tests(std::size_t j) { return {tests_.data() + j * n_, n_}; }
  std::span<double> terms(std::size_t j) { return {terms_.data() + j * n_, n_}; }

  /// @returns regularity of A as DenseLu::factorise
  double factorise();

  /// u of coefficient r.
  std::span<const double> coefficients(std::size_t r);

  /// Shape functions of coefficient r times `factor`, refined once, so that the terms are reproduced to rounding.
  void shape_functions(std::size_t r, double factor, std::span<double> shape);

private:
  std::size_t n_ = 0;
  std::size_t n_neighbours_ = 0;
  std::vector<double> tests_;
  std::vector<double> terms_;
  std::vector<double> unknown_;
  DenseLu factor_;
};

} // namespace meshless::basis
