#pragma once

#include "meshless/domain/boundary.h"

#include <array>
#include <span>
#include <vector>

namespace meshless::domain {

/// Quadrature of the local subdomain of one particle: a disc cut by the boundary. Coordinates as
/// separate arrays, m; JxW in m^2 inside and m on the boundary.
struct SubdomainQuadrature {
  std::array<std::vector<double>, 2> point;
  std::vector<double> JxW;

  /// Points on one straight part of the boundary inside the disc.
  struct BoundaryPart {
    int id = 0;
    Point2 normal{};
    std::size_t begin = 0; ///< range in boundary_point and boundary_JxW
    std::size_t end = 0;
  };
  std::vector<BoundaryPart> parts;
  std::array<std::vector<double>, 2> boundary_point;
  std::vector<double> boundary_JxW;
  /// True if no boundary comes into the disc.
  bool whole = true;

  void clear();
};

/// Gauss rule of n_radial x 4 n_radial points on discs, cut exactly by straight boundaries
/// (Batra & Zhang 2008, section 3.2.2, 'Evaluation of integrals').
///
/// In polar coordinates about the particle the integrand is smooth only between break points: the
/// directions in which the circle crosses the boundary and those of corners inside the disc. Each
/// wedge between two break points gets Gauss points in the angle, 4 n_radial a full turn but at
/// least n_radial a wedge, and along every ray n_radial Gauss points on each interval inside the
/// domain (a subdomain at a concave corner may have several). Boundary pieces are split where they
/// are nearest to the particle, n_radial points a part. With that the identity
/// integral of W,j = boundary integral of W n_j holds to the accuracy of the Gauss rule.
class SubdomainRule {
public:
  /// @param n_radial nG >= 1
  SubdomainRule(const Boundary &boundary, int n_radial);

  /// Replaces `quadrature` by the rule of the disc around `centre`, reusing its storage.
  void build(const Point2 &centre, double radius, SubdomainQuadrature &quadrature) const;

private:
  struct Scratch;
  void add_whole_disc(const Point2 &centre, double radius, SubdomainQuadrature &quadrature) const;
  void add_wedge(const Point2 &centre, double radius, double begin, double end, std::span<const std::size_t> pieces,
                 SubdomainQuadrature &quadrature) const;
  void add_boundary(const Point2 &centre, double radius, std::size_t piece, SubdomainQuadrature &quadrature) const;

  const Boundary *boundary_;
  int n_radial_;
};

} // namespace meshless::domain
