#pragma once

#include "meshless/domain/local_subdomain.h"
#include "meshless/elasticity/weak_form/consistent_gradient.h"
#include "meshless/kernels/kernel_table.h"

#include <array>
#include <span>
#include <vector>

namespace meshless::elasticity::weak_form {

using domain::Point2;

/// W_I at points, and its gradient unless that is null, for a kernel stretched so that its support ends at the edge of
/// the disc or ellipse.
void evaluate_test_function(const kernels::Kernel &kernel, const Point2 &centre, const domain::Ellipse &shape,
                            std::span<const double> x, std::span<const double> y, std::vector<double> &test,
                            std::array<std::vector<double>, 2> *gradient);

/// W_I and its gradient at the points of the whole disc of radius 1, computed once: on every other whole disc W_I is
/// the same and its gradient that over the radius; likewise on whole ellipses, stretched.
struct UnitDiscTest {
  std::vector<double> test;
  std::array<std::vector<double>, 2> gradient;

  void stretch(const domain::Ellipse &shape, std::vector<double> &to_test,
               std::array<std::vector<double>, 2> &to_gradient) const;
};

/// Quadrature of one subdomain, W_I at its points and those of its edge, and the corrected gradient.
struct ConsistentPoints {
  domain::SubdomainQuadrature quadrature;
  std::vector<double> test;
  std::vector<double> edge_test;
  std::array<std::vector<double>, 2> gradient;
};

/// Builds the subdomains of one region with consistent integration.
class ConsistentSubdomain {
public:
  /// @param boundary, visibility kept by reference
  /// @param order m of the basis of displacement
  ConsistentSubdomain(const domain::Boundary &boundary, const domain::Visibility &visibility,
                      const kernels::Kernel &test_function, int order);

  /// A narrow wedge may need more points before the correction exists: their number is doubled there.
  /// @throws std::invalid_argument naming the particle if that does not help
  void build(const Point2 &centre, const domain::Ellipse &shape, ConsistentPoints &points);

private:
  const domain::Boundary *boundary_;
  const domain::Visibility *visibility_;
  kernels::Kernel test_function_;
  int order_;
  domain::SubdomainRule rule_;
  ConsistentGradient correction_;
  UnitDiscTest whole_; ///< corrected
};

} // namespace meshless::elasticity::weak_form
