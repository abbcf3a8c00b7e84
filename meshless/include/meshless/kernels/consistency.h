#pragma once

#include <functional>
#include <span>
#include <vector>

namespace meshless::kernels {

/// A discrete smoothing function at one point of a line, Liu, Liu & Lam 2003, (30).
struct RestoredConsistency {
  std::vector<double> coefficients; ///< b_0 .. b_k of (30)
  std::vector<double> weights;      ///< W(x - x_j) of every particle, window included; times volume they sum to 1
};

/// Restores the consistency of order k at x: W(x - x_j) = sum_l b_l ((x - x_j) / h)^l, times the window if one is given
/// (33), such that sum_j W dx_j = 1 and sum_j ((x - x_j) / h)^l W dx_j = 0 for l = 1 .. k (31), by solving
/// (32). With a window this is the value of RKPM; without one all particles count alike.
/// Values can be negative, not symmetric and not monotone, as the paper warns.
/// @param window of (x - x_j) / h; empty: 1
/// @throws std::invalid_argument for sizes that differ, k < 0 or h <= 0; std::runtime_error for a singular matrix:
/// fewer
///   than k + 1 particles where the window is not zero
RestoredConsistency restore_consistency(double x, std::span<const double> positions, std::span<const double> volumes,
                                        double h, int order, const std::function<double(double)> &window = {});

} // namespace meshless::kernels
