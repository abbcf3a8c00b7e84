#pragma once

namespace meshless::basis {

/// Whether a particle exactly on the edge of a support belongs to it. W is zero there for most kernels,
/// but W' and W'' are not, so that bases which differentiate the kernel (MSPH, RKPM, MLS ...) depend on it.
enum class EdgeRule { excluded, included };

/// A particle is on the edge if its distance is the support's radius to this relative tolerance: far above
/// the rounding of coordinates, far below any distance that is meant. Decided for the squares.
inline constexpr double edge_tolerance = 1e-12;

struct BasisOptions {
  /// Weigh the particles with their volumes m / rho (Zhang & Batra 2008) or not (Batra & Zhang 2008), for
  /// SSPH and MLS; the other bases always do.
  bool volumes = false;
  EdgeRule edge = EdgeRule::excluded;
};

/// Largest s^2 that counts as inside a support of this radius.
inline double edge_limit(double support, EdgeRule rule) {
  return support * support * (rule == EdgeRule::excluded ? 1 - edge_tolerance : 1 + edge_tolerance);
}

/// Radius up to which candidates must be given, in units of h.
inline double search_radius(double support, EdgeRule rule) {
  return rule == EdgeRule::excluded ? support : support * (1 + edge_tolerance);
}

} // namespace meshless::basis
