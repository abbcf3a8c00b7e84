#pragma once

#include "meshless/cloud_generation/generator.h"

#include <vector>

namespace meshless::cloud_generation {

/// Values of the spacing; checked.
class Spacing {
public:
  explicit Spacing(const SpacingField &field) : field_(field) {}
  /// @throws std::invalid_argument naming the first point whose value is not finite and positive
  std::vector<double> at(std::span<const Point2> points) const;

private:
  const SpacingField &field_;
};

/// The boundaries of all regions as curves between corners, each once, so that both regions of an interface see the
/// same particles on it.
class BoundaryCurves {
public:
  /// @param regions kept by reference; must outlive the curves
  BoundaryCurves(std::span<const domain::Boundary> regions, const Spacing &spacing,
                 const std::map<int, std::size_t> &n_on_curves);

  /// Number of particles on the boundary of a region with the spacing scaled by `scale`.
  std::size_t n_particles(std::size_t region, double scale) const;

  /// These particles. Where regions meet they are the same to the last bit.
  std::vector<Point2> particles(std::size_t region, double scale) const;

private:
  /// A piece of the boundary, whatever regions have it.
  struct Edge {
    domain::BoundaryPiece piece;
    std::size_t begin; ///< vertex
    std::size_t end;
  };
  struct Step {
    std::size_t edge;
    bool forwards;
  };
  struct Curve {
    std::vector<Step> steps;
    std::size_t begin = 0; ///< vertex
    std::size_t end = 0;
    bool closed = false;                  ///< no corner on it: its first vertex carries a particle all the same
    std::optional<std::size_t> n_fixed{}; ///< intervals, if the request gives them
    // The integral of 1 / s up to samples of the curve's own parameter (step + part of it).
    std::vector<double> parameters;
    std::vector<double> integrals;
  };

  void find_vertices(std::span<const domain::Boundary> regions);
  void find_edges(std::span<const domain::Boundary> regions);
  void find_corners();
  void chain();
  bool is_corner(std::size_t vertex) const;
  Point2 point(const Curve &curve, double parameter) const;
  void integrate(Curve &curve, const Spacing &spacing) const;
  static std::size_t n_intervals(const Curve &curve, double scale);

  double tolerance_ = 0;
  std::vector<Point2> vertices_;
  /// Vertex where every piece begins, by region.
  std::vector<std::vector<std::size_t>> piece_vertices_;
  std::vector<Edge> edges_;
  std::vector<std::vector<std::size_t>> region_edges_;
  std::vector<std::vector<std::size_t>> vertex_edges_;
  std::vector<bool> corners_;
  std::vector<Curve> curves_;
  std::vector<std::vector<std::size_t>> region_curves_;
};

} // namespace meshless::cloud_generation
