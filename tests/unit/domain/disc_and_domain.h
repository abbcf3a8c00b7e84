#pragma once

#include "disc_and_polygon.h"

#include "meshless/domain/local_subdomain.h"
#include "meshless/kernels/gauss.h"

#include <functional>

/// Integrals over the part of a disc inside any domain, by the divergence theorem: crossings are bisected on fine
/// samples of curve and circle, whether a point is inside is the caller's formula. No code of the subdomains.
namespace disc_and_domain {

using meshless::domain::Boundary;
using meshless::domain::Point2;
using meshless::domain::SubdomainQuadrature;
using Inside = std::function<bool(const Point2 &)>;

/// Calls f(begin, end) for the intervals of [0, 1] on which `holds` is true, as far as n samples show them.
template <typename Holds, typename F>
void for_each_interval(int n, const Holds &holds, const F &f) {
  const auto edge = [&](double a, double b) {
    const bool at_a = holds(a);
    for (int i = 0; i < 60; ++i) {
      const double middle = .5 * (a + b);
      (holds(middle) == at_a ? a : b) = middle;
    }
    return .5 * (a + b);
  };
  double begin = 0;
  // Samples off the symmetric places, where circles touch edges.
  const auto sample = [&](int i) { return i == 0 ? 0. : i == n ? 1. : (i + .137) / n; };
  for (int i = 0; i < n; ++i) {
    const bool here = holds(sample(i));
    const bool next = holds(sample(i + 1));
    if (here == next)
      continue;
    const double at = edge(sample(i), sample(i + 1));
    if (here)
      f(begin, at);
    begin = at;
  }
  if (holds(1.))
    f(begin, 1.);
}

/// Integral of x^a y^b, measured from the centre in units of the radius; m^2.
inline double moment(const Boundary &boundary, const Inside &inside, const Point2 &centre, double radius, int a,
                     int b) {
  const auto flux = [&](const Point2 &x) {
    return disc_and_polygon::power((x[0] - centre[0]) / radius, a + 1) / (a + 1) *
           disc_and_polygon::power((x[1] - centre[1]) / radius, b) * radius;
  };
  double sum = 0;
  for (const auto &piece : boundary.pieces())
    for_each_interval(
        400,
        [&](double t) {
          const auto x = piece.point(t);
          return std::hypot(x[0] - centre[0], x[1] - centre[1]) < radius;
        },
        [&](double begin, double end) {
          sum += (end - begin) * piece.length() * disc_and_polygon::integrate([&](double u) {
                   const double t = begin + u * (end - begin);
                   return flux(piece.point(t)) * piece.normal(t)[0];
                 });
        });
  const auto on_circle = [&](double t) {
    const double angle = 2 * std::numbers::pi * t;
    return Point2{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
  };
  for_each_interval(
      4000, [&](double t) { return inside(on_circle(t)); },
      [&](double begin, double end) {
        sum += (end - begin) * 2 * std::numbers::pi * radius * disc_and_polygon::integrate([&](double u) {
                 const double t = begin + u * (end - begin);
                 return flux(on_circle(t)) * std::cos(2 * std::numbers::pi * t);
               });
      });
  return sum;
}

/// The same by the rule, m^2.
inline double moment(const SubdomainQuadrature &quadrature, const Point2 &centre, double radius, int a, int b) {
  double sum = 0;
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q)
    sum += quadrature.JxW[q] * disc_and_polygon::power((quadrature.point[0][q] - centre[0]) / radius, a) *
           disc_and_polygon::power((quadrature.point[1][q] - centre[1]) / radius, b);
  return sum;
}

/// int W,j - boundary int W n_j for a Gauss function that is not small at the edge of the disc, in metres: all parts
/// count, so the rule must have been asked for its circle.
inline Point2 divergence_defect(const SubdomainQuadrature &quadrature, const Point2 &centre, double radius) {
  const meshless::kernels::Gauss kernel(1);
  const auto offset = [&](const auto &points, std::size_t q) {
    return Point2{(points[0][q] - centre[0]) / radius, (points[1][q] - centre[1]) / radius};
  };
  Point2 defect{};
  for (std::size_t q = 0; q < quadrature.JxW.size(); ++q) {
    const auto d = offset(quadrature.point, q);
    const double slope = kernel.slope(d[0] * d[0] + d[1] * d[1]) / radius;
    for (int k = 0; k < 2; ++k)
      defect[k] += quadrature.JxW[q] * slope * d[k];
  }
  for (const auto &part : quadrature.parts)
    for (std::size_t q = part.begin; q < part.end; ++q) {
      const auto d = offset(quadrature.boundary_point, q);
      for (int k = 0; k < 2; ++k)
        defect[k] -=
            quadrature.boundary_JxW[q] * kernel.value(d[0] * d[0] + d[1] * d[1]) * quadrature.boundary_normal[k][q];
    }
  return defect;
}

} // namespace disc_and_domain
