#pragma once

#include "meshless/linear_algebra/krylov.h"

#include <memory>
#include <vector>

namespace meshless::linear_algebra {

/// What the iterations of one system share.
struct KrylovSystem {
  const LinearOperator &matrix;
  const LinearOperator &preconditioner; ///< from the right
  double norm = 0;                      ///< |A|
  double norm_b = 0;                    ///< |b|
  KrylovTolerance tolerance;

  /// An iterate above this is what a later one is compared with.
  double loose() const { return 100 * tolerance.backward_error; }
};

/// One Krylov method: runs of it, each from the residual that the one before has left.
class KrylovIteration {
public:
  virtual ~KrylovIteration() = default;

  /// x += an approximate solution of A y = residual. Ends when the method's own residual has the wanted backward error,
  /// or when there is no hope. The residual is of no use afterwards.
  /// @param loose the last x above the loose backward error, if there was one
  /// @return iterations, at most `most`
  virtual int run(std::vector<double> &x, std::vector<double> &residual, std::vector<double> &loose, int most) = 0;
};

std::unique_ptr<KrylovIteration> make_bicgstab(const KrylovSystem &system, std::size_t n);
std::unique_ptr<KrylovIteration> make_gmres(const KrylovSystem &system, std::size_t n);

/// Sum of a_i b_i in a fixed order.
double dot(std::span<const double> a, std::span<const double> b);

} // namespace meshless::linear_algebra
