#pragma once

#include "meshless/domain/boundary.h"
#include "meshless/domain/ellipse.h"
#include "meshless/domain/visibility.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace meshless::domain {

/// Quadrature of the local subdomain of one particle: a disc or ellipse cut by the boundary. Coordinates as
/// separate arrays, m; JxW in m^2 inside and m on the boundary.
struct SubdomainQuadrature {
  std::array<std::vector<double>, 2> point;
  std::vector<double> JxW;

  enum class PartKind {
    boundary, ///< of the domain
    cut,      ///< through the domain, where what lies behind it is hidden from the particle
    circle,   ///< edge of the disc inside the domain
  };
  /// Points on one part of the subdomain's edge.
  struct Part {
    PartKind kind = PartKind::boundary;
    int id = 0;            ///< of the boundary piece
    std::size_t piece = 0; ///< its index
    std::size_t begin = 0; ///< range in boundary_point, boundary_normal and boundary_JxW
    std::size_t end = 0;
  };
  std::vector<Part> parts;
  std::array<std::vector<double>, 2> boundary_point;
  /// Unit normal, outward of the subdomain.
  std::array<std::vector<double>, 2> boundary_normal;
  std::vector<double> boundary_JxW;
  /// True if no boundary comes into the disc.
  bool whole = true;

  void clear();
};

/// What is asked for; the rest is not computed. The boundary and cuts always are.
struct SubdomainWanted {
  bool interior = true;
  bool circle = false;
};

/// Numbers of points of a rule.
struct SubdomainPoints {
  int radial = 10;   ///< on every interval of a ray inside the domain
  int angular = 40;  ///< in a whole disc, or in every wedge between two break points
  int boundary = 10; ///< on every part of the edge; two more on a whole circle
  /// Gauss points in r^2 instead of r, and equispaced angles on whole discs: exact for polynomials of a higher degree
  /// with the same number of points.
  bool by_area = false;
  int radial_cut = 0; ///< in place of `radial` where the boundary cuts the disc; 0: the same

  /// nG x 4 nG, Batra & Zhang 2008.
  static SubdomainPoints paper(int n_radial) { return {n_radial, 4 * n_radial, n_radial, false, 0}; }
};

/// Gauss rule of n_radial x 4 n_radial points on discs, cut exactly by lines and circular arcs
/// (Batra & Zhang 2008, section 3.2.2, 'Evaluation of integrals').
///
/// In polar coordinates about the particle the integrand is smooth only between break points: the
/// directions in which the circle crosses the boundary, those of corners inside the disc, and those of
/// tangents to an arc. Each wedge between two break points gets 4 n_radial Gauss points in the angle, and
/// along every ray n_radial Gauss points on each interval inside the domain (a subdomain at a concave corner
/// or beside a hole may have several).
///
/// The distance to an arc seen from outside of its circle has a square root at the tangent direction theta_t. A
/// wedge that ends there, or close to it, is integrated over s with theta = theta_t + s^2: the distance is
/// then a smooth function of s and Gauss points converge as fast as elsewhere.
///
/// Boundary pieces are split where they are nearest to the particle and into arcs of a radian at most, n_radial points
/// a part. With that the identity integral of W,j = boundary integral of W n_j holds to the accuracy of the Gauss rule.
///
/// With a visibility, what is hidden from the particle is left out; where a visible wedge lies beside a hidden
/// one inside the domain, the ray between them becomes part of the subdomain's edge, so that the identity remains true.
class SubdomainRule {
public:
  /// The paper's rule.
  /// @param boundary kept by reference
  /// @param n_radial nG >= 1
  /// @param visibility kept by reference; null: everything is visible
  SubdomainRule(const Boundary &boundary, int n_radial, const Visibility *visibility = nullptr)
      : SubdomainRule(boundary, SubdomainPoints::paper(n_radial), visibility) {}
  /// Any other numbers of points, each >= 1.
  SubdomainRule(const Boundary &boundary, const SubdomainPoints &points, const Visibility *visibility = nullptr);
  ~SubdomainRule();
  SubdomainRule(SubdomainRule &&) noexcept;

  /// Replaces `quadrature` by the rule of the disc or ellipse around `centre`, reusing its storage.
  ///
  /// On an ellipse the angular points are those of the disc that it is stretched to; the boundary stays as it is.
  /// @throws std::invalid_argument if the circle of an ellipse is wanted
  void build(const Point2 &centre, const Ellipse &shape, SubdomainQuadrature &quadrature,
             const SubdomainWanted &wanted = {});

  /// Interior points of the whole disc of radius 1 about the origin: those of every whole disc, moved and scaled (and
  /// compressed to an ellipse), in the same order.
  const SubdomainQuadrature &unit_disc() const;

private:
  struct Scratch;
  const Boundary *boundary_;
  const Visibility *visibility_;
  SubdomainPoints points_;
  std::unique_ptr<Scratch> scratch_;
};

} // namespace meshless::domain
