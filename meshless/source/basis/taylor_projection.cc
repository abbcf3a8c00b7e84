#include "meshless/basis/taylor_projection.h"

#include <algorithm>

namespace meshless::basis {

void TaylorProjection::resize(std::size_t n_terms, std::size_t n_neighbours) {
  n_ = n_terms;
  n_neighbours_ = n_neighbours;
  tests_.resize(n_terms * n_neighbours);
  terms_.resize(n_terms * n_neighbours);
  unknown_.resize(n_terms);
}

double TaylorProjection::factorise() {
  factor_.resize(n_);
  for (std::size_t j = 0; j < n_neighbours_; ++j)
    for (std::size_t a = 0; a < n_; ++a)
      for (std::size_t b = 0; b < n_; ++b)
        factor_(a, b) += tests_[j * n_ + a] * terms_[j * n_ + b];
  return factor_.factorise();
}

std::span<const double> TaylorProjection::coefficients(std::size_t r) {
  std::fill(unknown_.begin(), unknown_.end(), 0.0);
  unknown_[r] = 1;
  factor_.solve_transposed(unknown_);
  return unknown_;
}

void TaylorProjection::shape_functions(std::size_t r, double factor, std::span<double> shape) {
  std::fill(shape.begin(), shape.end(), 0.0);
  // The second pass adds what the first one lacks to sum_J shape_J p_J = e_r.
  for (int pass = 0; pass < 2; ++pass) {
    std::fill(unknown_.begin(), unknown_.end(), 0.0);
    unknown_[r] = factor;
    for (std::size_t j = 0; j < n_neighbours_; ++j)
      for (std::size_t a = 0; a < n_; ++a)
        unknown_[a] -= shape[j] * terms_[j * n_ + a];
    factor_.solve_transposed(unknown_);
    for (std::size_t j = 0; j < n_neighbours_; ++j)
      for (std::size_t a = 0; a < n_; ++a)
        shape[j] += unknown_[a] * tests_[j * n_ + a];
  }
}

} // namespace meshless::basis
