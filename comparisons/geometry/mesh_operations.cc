#include "comparisons/geometry/mesh_operations.h"

#include "meshless/linear_algebra/gauss_legendre.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace comparisons::geometry {

namespace {

using problems::Mesh;
using problems::Point2;

std::pair<unsigned, unsigned> key(unsigned a, unsigned b) { return std::minmax(a, b); }

/// Point of the shorter arc from a to b around c, at the part t of its angle.
Point2 on_arc(const Point2 &a, const Point2 &b, const Point2 &c, double t) {
  const Point2 u{a[0] - c[0], a[1] - c[1]};
  const Point2 v{b[0] - c[0], b[1] - c[1]};
  const double angle = t * std::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]);
  return {c[0] + std::cos(angle) * u[0] - std::sin(angle) * u[1],
          c[1] + std::sin(angle) * u[0] + std::cos(angle) * u[1]};
}

/// The parabola through a, m and b at t = 0, 1/2, 1.
Point2 on_parabola(const Point2 &a, const Point2 &m, const Point2 &b, double t) {
  Point2 p{};
  for (std::size_t k = 0; k < 2; ++k)
    p[k] = (1 - t) * (1 - 2 * t) * a[k] + 4 * t * (1 - t) * m[k] + t * (2 * t - 1) * b[k];
  return p;
}

/// Position and derivatives of a cell's map at (s, t): bilinear in the corners, or linear in a triangle with
/// s and t its second and third barycentric coordinate, and a quadratic bump for every curved edge.
struct CellMap {
  const Mesh &mesh;
  const EdgeCurves &curves;
  const Mesh::Cell &cell;

  /// Value and derivatives of one function of (s, t).
  using Function = std::array<double, 3>;

  static Function times(const Function &a, const Function &b, double factor) {
    return {factor * a[0] * b[0], factor * (a[1] * b[0] + a[0] * b[1]), factor * (a[2] * b[0] + a[0] * b[2])};
  }

  std::array<Function, 4> corner_functions(double s, double t) const {
    if (cell.n_vertices == 3)
      return {{{1 - s - t, -1, -1}, {s, 1, 0}, {t, 0, 1}, {}}};
    return {{{(1 - s) * (1 - t), t - 1, s - 1}, {s * (1 - t), 1 - t, -s}, {s * t, t, s}, {(1 - s) * t, -t, 1 - s}}};
  }

  /// The bump of side k, 1 in its middle and 0 on the other sides.
  std::array<Function, 4> side_functions(const std::array<Function, 4> &corners, double s, double t) const {
    if (cell.n_vertices == 3)
      return {times(corners[0], corners[1], 4), times(corners[1], corners[2], 4), times(corners[2], corners[0], 4), {}};
    const Function a{s, 1, 0};
    const Function b{1 - s, -1, 0};
    const Function c{t, 0, 1};
    const Function d{1 - t, 0, -1};
    const Function along_s = times(a, b, 4);
    const Function along_t = times(c, d, 4);
    return {times(along_s, d, 1), times(along_t, a, 1), times(along_s, c, 1), times(along_t, b, 1)};
  }

  /// The point and the determinant of the map's derivatives.
  std::pair<Point2, double> at(double s, double t) const {
    const auto corners = corner_functions(s, t);
    const auto sides = side_functions(corners, s, t);
    Point2 x{};
    std::array<Point2, 2> derivative{};
    const auto add = [&](const Function &f, const Point2 &p) {
      for (std::size_t k = 0; k < 2; ++k) {
        x[k] += f[0] * p[k];
        derivative[0][k] += f[1] * p[k];
        derivative[1][k] += f[2] * p[k];
      }
    };
    for (unsigned k = 0; k < cell.n_vertices; ++k) {
      const unsigned a = cell.vertices[k];
      const unsigned b = cell.vertices[(k + 1) % cell.n_vertices];
      add(corners[k], mesh.vertices[a]);
      if (!curves.is_curved(a, b))
        continue;
      const Point2 m = curves.point(mesh, a, b, 0.5);
      add(sides[k], {m[0] - 0.5 * (mesh.vertices[a][0] + mesh.vertices[b][0]),
                     m[1] - 0.5 * (mesh.vertices[a][1] + mesh.vertices[b][1])});
    }
    return {x, derivative[0][0] * derivative[1][1] - derivative[0][1] * derivative[1][0]};
  }
};

/// Makes the finer mesh.
class Refiner {
public:
  explicit Refiner(const Mesh &mesh) : mesh_(mesh), curves_(mesh) { fine_.vertices = mesh.vertices; }

  Mesh refine() {
    for (const auto &cell : mesh_.cells)
      split(cell);
    for (const auto &edge : mesh_.boundary) {
      const unsigned m = middle(edge.vertices[0], edge.vertices[1]);
      fine_.boundary.push_back({{edge.vertices[0], m}, edge.id, edge.arc_centre});
      fine_.boundary.push_back({{m, edge.vertices[1]}, edge.id, edge.arc_centre});
    }
    for (const auto &edge : mesh_.curved_edges) {
      const unsigned m = middle(edge.vertices[0], edge.vertices[1]);
      const auto quarter = [&](double t) {
        return on_parabola(mesh_.vertices[edge.vertices[0]], edge.midpoint, mesh_.vertices[edge.vertices[1]], t);
      };
      fine_.curved_edges.push_back({{edge.vertices[0], m}, quarter(0.25)});
      fine_.curved_edges.push_back({{m, edge.vertices[1]}, quarter(0.75)});
    }
    return std::move(fine_);
  }

private:
  unsigned middle(unsigned a, unsigned b) {
    const auto [found, is_new] = middles_.emplace(key(a, b), static_cast<unsigned>(fine_.vertices.size()));
    if (is_new)
      fine_.vertices.push_back(curves_.point(mesh_, a, b, 0.5));
    return found->second;
  }

  void split(const Mesh::Cell &cell) {
    const unsigned n = cell.n_vertices;
    std::array<unsigned, 4> m{};
    for (unsigned k = 0; k < n; ++k)
      m[k] = middle(cell.vertices[k], cell.vertices[(k + 1) % n]);
    if (n == 3) {
      for (unsigned k = 0; k < 3; ++k)
        fine_.cells.push_back({{cell.vertices[k], m[k], m[(k + 2) % 3], 0}, 3, cell.region});
      fine_.cells.push_back({{m[0], m[1], m[2], 0}, 3, cell.region});
      return;
    }
    const Point2 x = CellMap{mesh_, curves_, cell}.at(0.5, 0.5).first;
    const auto centre = static_cast<unsigned>(fine_.vertices.size());
    fine_.vertices.push_back(x);
    for (unsigned k = 0; k < 4; ++k)
      fine_.cells.push_back({{cell.vertices[k], m[k], centre, m[(k + 3) % 4]}, 4, cell.region});
  }

  const Mesh &mesh_;
  EdgeCurves curves_;
  Mesh fine_;
  std::map<std::pair<unsigned, unsigned>, unsigned> middles_;
};

} // namespace

EdgeCurves::EdgeCurves(const Mesh &mesh) {
  for (const auto &edge : mesh.boundary)
    if (edge.arc_centre)
      centres_[key(edge.vertices[0], edge.vertices[1])] = *edge.arc_centre;
  for (const auto &edge : mesh.curved_edges)
    midpoints_[key(edge.vertices[0], edge.vertices[1])] = edge.midpoint;
}

bool EdgeCurves::is_curved(unsigned a, unsigned b) const {
  return centres_.contains(key(a, b)) || midpoints_.contains(key(a, b));
}

Point2 EdgeCurves::point(const Mesh &mesh, unsigned a, unsigned b, double t) const {
  const Point2 &begin = mesh.vertices[a];
  const Point2 &end = mesh.vertices[b];
  if (const auto arc = centres_.find(key(a, b)); arc != centres_.end())
    return on_arc(begin, end, arc->second, t);
  if (const auto parabola = midpoints_.find(key(a, b)); parabola != midpoints_.end())
    return on_parabola(begin, parabola->second, end, t);
  return {(1 - t) * begin[0] + t * end[0], (1 - t) * begin[1] + t * end[1]};
}

Mesh refine(const Mesh &mesh) { return Refiner(mesh).refine(); }

problems::Quadrature cell_quadrature(const Mesh &mesh, int n) {
  const auto gauss = meshless::linear_algebra::gauss_legendre(n);
  const EdgeCurves curves(mesh);
  problems::Quadrature quadrature;
  const std::size_t n_points = mesh.cells.size() * static_cast<std::size_t>(n * n);
  quadrature.points.reserve(n_points);
  quadrature.weights.reserve(n_points);
  quadrature.regions.reserve(n_points);
  for (const auto &cell : mesh.cells) {
    const CellMap map{mesh, curves, cell};
    for (std::size_t i = 0; i < gauss.points.size(); ++i)
      for (std::size_t j = 0; j < gauss.points.size(); ++j) {
        const double s = gauss.points[i];
        // A triangle is a square of which one side has shrunk to a point.
        const double shrink = cell.n_vertices == 3 ? 1 - s : 1;
        const auto [x, determinant] = map.at(s, shrink * gauss.points[j]);
        quadrature.points.push_back(x);
        quadrature.weights.push_back(gauss.weights[i] * gauss.weights[j] * shrink * determinant);
        quadrature.regions.push_back(cell.region);
      }
  }
  return quadrature;
}

std::vector<double> vertex_spacing(const Mesh &mesh) {
  std::vector<double> sum(mesh.vertices.size(), 0);
  std::vector<int> count(mesh.vertices.size(), 0);
  for (const auto &cell : mesh.cells)
    for (unsigned k = 0; k < cell.n_vertices; ++k) {
      const unsigned a = cell.vertices[k];
      const unsigned b = cell.vertices[(k + 1) % cell.n_vertices];
      const double length =
          std::hypot(mesh.vertices[b][0] - mesh.vertices[a][0], mesh.vertices[b][1] - mesh.vertices[a][1]);
      for (const unsigned v : {a, b}) {
        sum[v] += length;
        ++count[v];
      }
    }
  for (std::size_t i = 0; i < sum.size(); ++i)
    sum[i] /= std::max(1, count[i]);
  return sum;
}

std::pair<std::vector<int>, int> components(const Mesh &mesh) {
  // Union of sets of vertices.
  std::vector<unsigned> parent(mesh.vertices.size());
  for (unsigned i = 0; i < parent.size(); ++i)
    parent[i] = i;
  const auto root = [&](unsigned i) {
    while (parent[i] != i)
      i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto &cell : mesh.cells)
    for (unsigned k = 1; k < cell.n_vertices; ++k)
      parent[root(cell.vertices[k])] = root(cell.vertices[0]);
  std::map<unsigned, int> numbers;
  std::vector<int> result;
  for (const auto &cell : mesh.cells)
    result.push_back(numbers.emplace(root(cell.vertices[0]), static_cast<int>(numbers.size())).first->second);
  return {result, static_cast<int>(numbers.size())};
}

} // namespace comparisons::geometry
