#include "consistent_subdomain.h"

#include "meshless/linear_algebra/floating_point_traps.h"

#include <fmt/format.h>

#include <optional>
#include <stdexcept>

namespace meshless::elasticity::weak_form {

namespace {

/// Doublings of the number of points that are tried.
constexpr int largest_refinement = 3;

} // namespace

void evaluate_test_function(const kernels::Kernel &kernel, const Point2 &centre, const domain::Ellipse &shape,
                            std::span<const double> x, std::span<const double> y, std::vector<double> &test,
                            std::array<std::vector<double>, 2> *gradient) {
  const linear_algebra::FloatingPointTraps traps;
  const std::size_t n = x.size();
  test.resize(n);
  if (gradient != nullptr)
    for (auto &component : *gradient)
      component.resize(n);
  const double inverse_h = kernels::support_of(kernel) / shape.radius;
  const auto &f = shape.flattening;
  std::visit(
      [&](const auto &w) {
        for (std::size_t q = 0; q < n; ++q) {
          const double dx = (x[q] - centre[0]) * inverse_h;
          const double dy = (y[q] - centre[1]) * inverse_h;
          const double along = f[0] * dx + f[1] * dy;
          const double s_squared = dx * dx + dy * dy + along * along;
          test[q] = w.value(s_squared);
          if (gradient != nullptr) {
            const double slope = w.slope(s_squared) * inverse_h;
            (*gradient)[0][q] = slope * (dx + along * f[0]);
            (*gradient)[1][q] = slope * (dy + along * f[1]);
          }
        }
      },
      kernel);
}

void UnitDiscTest::stretch(const domain::Ellipse &shape, std::vector<double> &to_test,
                           std::array<std::vector<double>, 2> &to_gradient) const {
  const linear_algebra::FloatingPointTraps traps;
  to_test.assign(test.begin(), test.end());
  const double inverse = 1 / shape.radius;
  const auto stretching = shape.stretching();
  for (std::size_t k = 0; k < 2; ++k)
    to_gradient[k].resize(test.size());
  for (std::size_t q = 0; q < test.size(); ++q) {
    const Point2 g = stretching({gradient[0][q], gradient[1][q]});
    for (std::size_t k = 0; k < 2; ++k)
      to_gradient[k][q] = inverse * g[k];
  }
}

ConsistentSubdomain::ConsistentSubdomain(const domain::Boundary &boundary, const domain::Visibility &visibility,
                                         const kernels::Kernel &test_function, int order)
    : boundary_(&boundary), visibility_(&visibility), test_function_(test_function), order_(order),
      rule_(boundary, consistent_points(order), &visibility), correction_(order - 1) {
  const auto &disc = rule_.unit_disc();
  evaluate_test_function(test_function_, {0, 0}, 1, disc.point[0], disc.point[1], whole_.test, &whole_.gradient);
  if (!correction_.correct({0, 0}, 1, disc, whole_.test, {}, whole_.gradient))
    throw std::logic_error("the consistent rule has too few points for a whole disc");
}

void ConsistentSubdomain::build(const Point2 &centre, const domain::Ellipse &shape, ConsistentPoints &points) {
  const auto evaluate = [&](domain::SubdomainRule &rule) {
    auto &quadrature = points.quadrature;
    rule.build(centre, shape, quadrature);
    if (quadrature.whole) {
      points.edge_test.clear();
      whole_.stretch(shape, points.test, points.gradient);
      return true;
    }
    evaluate_test_function(test_function_, centre, shape, quadrature.boundary_point[0], quadrature.boundary_point[1],
                           points.edge_test, nullptr);
    evaluate_test_function(test_function_, centre, shape, quadrature.point[0], quadrature.point[1], points.test,
                           &points.gradient);
    return correction_.correct(centre, shape.radius, quadrature, points.test, points.edge_test, points.gradient);
  };
  if (evaluate(rule_))
    return;
  auto numbers = consistent_points(order_);
  for (int refinement = 0; refinement < largest_refinement; ++refinement) {
    numbers.radial *= 2;
    numbers.radial_cut *= 2;
    numbers.angular *= 2;
    domain::SubdomainRule finer(*boundary_, numbers, visibility_);
    if (evaluate(finer))
      return;
  }
  throw std::invalid_argument(fmt::format("the subdomain of the particle at ({:.6g}, {:.6g}), radius {:.3g} m, is too "
                                          "narrow for consistent integration of order {}",
                                          centre[0], centre[1], shape.radius, order_));
}

} // namespace meshless::elasticity::weak_form
