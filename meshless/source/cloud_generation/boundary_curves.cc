#include "boundary_curves.h"

#include "meshless/cloud/point_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <stdexcept>

namespace meshless::cloud_generation {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Two straight pieces that turn by less go on as one curve: cos(20 degrees).
constexpr double straight_on = 0.9396926207859084;

double distance(const Point2 &a, const Point2 &b) { return std::sqrt(cloud::distance_squared<2>(a, b)); }

} // namespace

std::vector<double> Spacing::at(std::span<const Point2> points) const {
  std::vector<double> values(points.size());
  field_(points, values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0) || !std::isfinite(values[i]))
      throw std::invalid_argument(
          fmt::format("the spacing at ({:.6g}, {:.6g}) is {} m; it must be finite and greater than 0", points[i][0],
                      points[i][1], values[i]));
  return values;
}

BoundaryCurves::BoundaryCurves(std::span<const domain::Boundary> regions, const Spacing &spacing,
                               const std::map<int, std::size_t> &n_on_curves) {
  find_vertices(regions);
  find_edges(regions);
  find_corners();
  chain();
  std::set<int> used;
  for (auto &curve : curves_) {
    const int id = edges_[curve.steps[0].edge].piece.id;
    if (const auto given = n_on_curves.find(id); given != n_on_curves.end()) {
      if (given->second < 2)
        throw std::invalid_argument(
            fmt::format("{} particles on a curve of boundary {}; at least its 2 ends carry one", given->second, id));
      curve.n_fixed = given->second - (curve.closed ? 0 : 1);
      used.insert(id);
    }
    integrate(curve, spacing);
  }
  for (const auto &[id, n] : n_on_curves)
    if (!used.contains(id))
      throw std::invalid_argument(fmt::format("a number of particles for boundary {}, which no piece has", id));
}

void BoundaryCurves::find_vertices(std::span<const domain::Boundary> regions) {
  std::vector<Point2> begins;
  for (const auto &region : regions) {
    tolerance_ = std::max(tolerance_, region.tolerance());
    for (const auto &piece : region.pieces())
      begins.push_back(piece.begin);
  }
  const cloud::PointTree<2> tree(begins);
  std::vector<std::size_t> vertex_of(begins.size(), none);
  std::vector<cloud::Index> same;
  for (std::size_t i = 0; i < begins.size(); ++i) {
    if (vertex_of[i] != none)
      continue;
    same.clear();
    tree.append_within(begins[i], 2 * tolerance_, same);
    vertex_of[i] = vertices_.size();
    for (const auto j : same)
      if (vertex_of[static_cast<std::size_t>(j)] == none)
        vertex_of[static_cast<std::size_t>(j)] = vertices_.size();
    vertices_.push_back(begins[i]);
  }
  std::size_t at = 0;
  for (const auto &region : regions) {
    piece_vertices_.emplace_back(vertex_of.begin() + static_cast<std::ptrdiff_t>(at),
                                 vertex_of.begin() + static_cast<std::ptrdiff_t>(at + region.pieces().size()));
    at += region.pieces().size();
  }
}

void BoundaryCurves::find_edges(std::span<const domain::Boundary> regions) {
  // Two arcs may join the same vertices: they differ in the middle.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<std::size_t>> known;
  vertex_edges_.resize(vertices_.size());
  for (std::size_t r = 0; r < regions.size(); ++r) {
    auto &own = region_edges_.emplace_back();
    for (std::size_t i = 0; i < regions[r].pieces().size(); ++i) {
      const auto &piece = regions[r].pieces()[i];
      const std::size_t begin = piece_vertices_[r][i];
      const std::size_t end = piece_vertices_[r][regions[r].next(i)];
      auto &candidates = known[std::minmax(begin, end)];
      const Point2 middle = piece.point(0.5);
      const auto found = std::find_if(candidates.begin(), candidates.end(), [&](std::size_t e) {
        return distance(edges_[e].piece.point(0.5), middle) <= 4 * tolerance_;
      });
      if (found != candidates.end()) {
        own.push_back(*found);
        continue;
      }
      candidates.push_back(edges_.size());
      own.push_back(edges_.size());
      vertex_edges_[begin].push_back(edges_.size());
      vertex_edges_[end].push_back(edges_.size());
      edges_.push_back({piece, begin, end});
    }
  }
}

bool BoundaryCurves::is_corner(std::size_t vertex) const {
  if (vertex_edges_[vertex].size() != 2)
    return true;
  const Edge &a = edges_[vertex_edges_[vertex][0]];
  const Edge &b = edges_[vertex_edges_[vertex][1]];
  if (a.piece.id != b.piece.id || a.piece.arc || b.piece.arc)
    return true;
  const auto away = [&](const Edge &edge) {
    const Point2 &other = edge.begin == vertex ? edge.piece.end : edge.piece.begin;
    const Point2 &here = edge.begin == vertex ? edge.piece.begin : edge.piece.end;
    const double l = edge.piece.length();
    return Point2{(other[0] - here[0]) / l, (other[1] - here[1]) / l};
  };
  const Point2 p = away(a);
  const Point2 q = away(b);
  return -(p[0] * q[0] + p[1] * q[1]) < straight_on;
}

void BoundaryCurves::find_corners() {
  corners_.resize(vertices_.size());
  for (std::size_t v = 0; v < vertices_.size(); ++v)
    corners_[v] = is_corner(v);
}

void BoundaryCurves::chain() {
  std::vector<std::size_t> curve_of(edges_.size(), none);
  const auto follow = [&](std::size_t edge, std::size_t from) {
    Curve curve;
    curve.begin = from;
    std::size_t vertex = from;
    while (curve_of[edge] == none) {
      curve_of[edge] = curves_.size();
      curve.steps.push_back({edge, edges_[edge].begin == vertex});
      vertex = edges_[edge].begin == vertex ? edges_[edge].end : edges_[edge].begin;
      if (corners_[vertex])
        break;
      const auto &pair = vertex_edges_[vertex];
      edge = pair[0] == edge ? pair[1] : pair[0];
    }
    curve.end = vertex;
    curve.closed = !corners_[vertex];
    curves_.push_back(std::move(curve));
  };
  for (std::size_t e = 0; e < edges_.size(); ++e)
    for (const std::size_t v : {edges_[e].begin, edges_[e].end})
      if (curve_of[e] == none && corners_[v])
        follow(e, v);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    if (curve_of[e] == none)
      follow(e, edges_[e].begin);
  for (const auto &edges : region_edges_) {
    std::set<std::size_t> own;
    for (const std::size_t e : edges)
      own.insert(curve_of[e]);
    region_curves_.emplace_back(own.begin(), own.end());
  }
}

Point2 BoundaryCurves::point(const Curve &curve, double parameter) const {
  const auto k = std::min(static_cast<std::size_t>(parameter), curve.steps.size() - 1);
  const double t = parameter - static_cast<double>(k);
  const Step &step = curve.steps[k];
  return edges_[step.edge].piece.point(step.forwards ? t : 1 - t);
}

void BoundaryCurves::integrate(Curve &curve, const Spacing &spacing) const {
  // Halved until no part holds more than a twentieth of a particle; a part sees the spacing in its middle.
  std::size_t parts = std::max<std::size_t>(1, 64 / curve.steps.size());
  for (;; parts *= 2) {
    const std::size_t n = parts * curve.steps.size();
    std::vector<Point2> middles(n);
    for (std::size_t i = 0; i < n; ++i)
      middles[i] = point(curve, (static_cast<double>(i) + 0.5) / static_cast<double>(parts));
    const auto s = spacing.at(middles);
    curve.parameters.assign(1, 0);
    curve.integrals.assign(1, 0);
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double length = edges_[curve.steps[i / parts].edge].piece.length() / static_cast<double>(parts);
      largest = std::max(largest, length / s[i]);
      curve.parameters.push_back(static_cast<double>(i + 1) / static_cast<double>(parts));
      curve.integrals.push_back(curve.integrals.back() + length / s[i]);
    }
    if (largest <= 0.05 || n > 2'000'000)
      return;
  }
}

std::size_t BoundaryCurves::n_intervals(const Curve &curve, double scale) {
  if (curve.n_fixed)
    return *curve.n_fixed;
  const double wanted = std::round(curve.integrals.back() / scale);
  if (wanted > 1e7)
    throw std::invalid_argument(fmt::format("{:.3g} particles on one curve of the boundary; at most 1e7", wanted));
  return std::max<std::size_t>(curve.closed ? 3 : 1, static_cast<std::size_t>(wanted));
}

std::size_t BoundaryCurves::n_particles(std::size_t region, double scale) const {
  std::size_t n = 0;
  std::set<std::size_t> ends;
  for (const std::size_t c : region_curves_[region]) {
    n += n_intervals(curves_[c], scale) - 1;
    ends.insert(curves_[c].begin);
    ends.insert(curves_[c].end);
  }
  return n + ends.size();
}

std::vector<Point2> BoundaryCurves::particles(std::size_t region, double scale) const {
  std::vector<Point2> points;
  std::set<std::size_t> ends;
  for (const std::size_t c : region_curves_[region]) {
    ends.insert(curves_[c].begin);
    ends.insert(curves_[c].end);
  }
  for (const std::size_t v : ends)
    points.push_back(vertices_[v]);
  for (const std::size_t c : region_curves_[region]) {
    const Curve &curve = curves_[c];
    const std::size_t n = n_intervals(curve, scale);
    for (std::size_t i = 1; i < n; ++i) {
      const double wanted = curve.integrals.back() * static_cast<double>(i) / static_cast<double>(n);
      const auto upper = std::upper_bound(curve.integrals.begin(), curve.integrals.end(), wanted);
      const auto k = std::clamp<std::size_t>(static_cast<std::size_t>(upper - curve.integrals.begin()), 1,
                                             curve.integrals.size() - 1);
      const double part = (wanted - curve.integrals[k - 1]) / (curve.integrals[k] - curve.integrals[k - 1]);
      points.push_back(point(curve, curve.parameters[k - 1] + part * (curve.parameters[k] - curve.parameters[k - 1])));
    }
  }
  return points;
}

} // namespace meshless::cloud_generation
