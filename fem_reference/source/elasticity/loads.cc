#include "boundary_conditions.h"

#include "../parallel/ordered_batches.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
/// Cells handed to a callback at once: enough to amortise the call, few enough for the cache.
constexpr std::size_t cells_per_batch = 128;

void check_finite(const Vector &value, const Point &point, std::string_view what) {
  if (!std::isfinite(value[0]) || !std::isfinite(value[1]))
    throw InvalidInput(fmt::format("{} at ({}, {}) is ({}, {})", what, point[0], point[1], value[0], value[1]));
}

/// Position relative to the origin and JxW of one quadrature point of a cell.
struct MappedPoint {
  Point position;
  double jxw;
};

MappedPoint map_point(const ShapeTable &table, int q, std::span<const unsigned> nodes,
                      const std::vector<Point> &positions) {
  Point x{};
  Vector d1{};
  Vector d2{};
  for (int a = 0; a < table.n_nodes; ++a)
    for (std::size_t d = 0; d < 2; ++d) {
      const int k = q * table.n_nodes + a;
      const double coordinate = positions[nodes[a]][d];
      x[d] += table.values[k] * coordinate;
      d1[d] += table.gradients_1[k] * coordinate;
      d2[d] += table.gradients_2[k] * coordinate;
    }
  return {x, table.weights[q] * (d1[0] * d2[1] - d1[1] * d2[0])};
}

/// Forces of the body force at the quadrature points of some cells, one cell after the other.
std::vector<Vector> point_forces(const VectorField &body_force, const ShapeTable &table,
                                 const Discretisation &discretisation, std::span<const std::size_t> cells) {
  std::vector<Point> points;
  std::vector<double> jxw;
  for (const std::size_t c : cells)
    for (int q = 0; q < table.n_points; ++q) {
      const auto mapped = map_point(table, q, discretisation.nodes_of(c), discretisation.positions);
      points.push_back({discretisation.origin[0] + mapped.position[0], discretisation.origin[1] + mapped.position[1]});
      jxw.push_back(mapped.jxw);
    }
  std::vector<Vector> forces(points.size(), Vector{});
  body_force(points, forces);
  for (std::size_t k = 0; k < points.size(); ++k) {
    check_finite(forces[k], points[k], "the body force");
    for (double &force : forces[k])
      force *= jxw[k];
  }
  return forces;
}

/// The body force on the cells of one shape.
void add_body_force(const VectorField &body_force, const ReferenceElement &element,
                    const Discretisation &discretisation, Loads &loads) {
  const parallel::Band all{0, static_cast<unsigned>(discretisation.n_nodes())};
  const auto cells = cells_touching(all, discretisation, element.n_vertices());
  const ShapeTable table(element, cell_quadrature(element.n_vertices(), element.degree() + 2));
  const auto n_points = static_cast<std::size_t>(table.n_points);
  const auto make = [&](std::size_t begin, std::size_t end) {
    return point_forces(body_force, table, discretisation, std::span(cells).subspan(begin, end - begin));
  };
  const auto take = [&](std::size_t begin, const std::vector<Vector> &forces) {
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const auto nodes = discretisation.nodes_of(cells[begin + k / n_points]);
      const double *shape = table.values.data() + (k % n_points) * nodes.size();
      for (std::size_t d = 0; d < 2; ++d) {
        loads.body_force[d] += forces[k][d];
        loads.magnitude += std::abs(forces[k][d]);
        for (std::size_t a = 0; a < nodes.size(); ++a)
          loads.nodal[2 * std::size_t{nodes[a]} + d] += shape[a] * forces[k][d];
      }
    }
  };
  parallel::in_ordered_batches<std::vector<Vector>>(cells.size(), cells_per_batch, make, take);
}

/// Integrals of the slopes of shape functions with the thermal stress, on the cells of one shape.
void add_thermal_load(const PlaneProblem &problem, const ReferenceElement &element,
                      const Discretisation &discretisation, Loads &loads) {
  const ShapeTable table(element, cell_quadrature(element.n_vertices(), element.degree() + 2));
  const auto n_points = static_cast<std::size_t>(table.n_points);
  const auto n = static_cast<std::size_t>(table.n_nodes);
  std::vector<Point> points(n_points);
  std::vector<double> free(n_points);
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    if (discretisation.n_vertices[c] != element.n_vertices())
      continue;
    const auto nodes = discretisation.nodes_of(c);
    const double modulus = problem.materials[static_cast<std::size_t>(discretisation.regions[c])].thermal_modulus();
    for (std::size_t q = 0; q < n_points; ++q) {
      const auto mapped = map_point(table, static_cast<int>(q), nodes, discretisation.positions);
      points[q] = {discretisation.origin[0] + mapped.position[0], discretisation.origin[1] + mapped.position[1]};
    }
    problem.thermal_strain(points, free);
    for (std::size_t q = 0; q < n_points; ++q) {
      if (!std::isfinite(free[q]))
        throw InvalidInput(fmt::format("the thermal strain at ({}, {}) is {}", points[q][0], points[q][1], free[q]));
      std::array<Vector, 2> dx{}; // dx[i][k] = d x_i / d xi_k
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t i = 0; i < 2; ++i) {
          dx[i][0] += discretisation.positions[nodes[a]][i] * table.gradients_1[q * n + a];
          dx[i][1] += discretisation.positions[nodes[a]][i] * table.gradients_2[q * n + a];
        }
      // The Jacobian in JxW cancels the one that divides the slopes.
      const double stress = table.weights[q] * modulus * free[q];
      for (std::size_t a = 0; a < n; ++a) {
        const double g1 = table.gradients_1[q * n + a];
        const double g2 = table.gradients_2[q * n + a];
        loads.nodal[2 * std::size_t{nodes[a]}] += stress * (dx[1][1] * g1 - dx[1][0] * g2);
        loads.nodal[2 * std::size_t{nodes[a]} + 1] += stress * (dx[0][0] * g2 - dx[0][1] * g1);
      }
    }
  }
}

/// Quadrature points on the edges of one boundary id, with what is needed to integrate over them.
struct EdgePoints {
  std::vector<unsigned> nodes; ///< degree + 1 an edge
  std::vector<Point> points;
  std::vector<Vector> normals; ///< outward, of the isoparametric edge
  std::vector<double> jxw;
};

/// Sides run counter-clockwise, so that the outside lies on their right.
EdgePoints edge_points(int id, const Discretisation &discretisation, const Quadrature1d &quadrature,
                       std::span<const LagrangeBasis::Values> shape,
                       std::span<const LagrangeBasis::Values> derivative) {
  const auto n_nodes = static_cast<std::size_t>(discretisation.degree()) + 1;
  EdgePoints result;
  for (const auto &edge : discretisation.edges) {
    if (edge.id != id)
      continue;
    const std::size_t first = result.nodes.size();
    for (unsigned k = 0; k < n_nodes; ++k)
      result.nodes.push_back(discretisation.node_of_side(edge, k));
    for (std::size_t q = 0; q < quadrature.points.size(); ++q) {
      Point x = discretisation.origin;
      Vector tangent{};
      for (std::size_t k = 0; k < n_nodes; ++k)
        for (std::size_t d = 0; d < 2; ++d) {
          const double coordinate = discretisation.positions[result.nodes[first + k]][d];
          x[d] += shape[q][k] * coordinate;
          tangent[d] += derivative[q][k] * coordinate;
        }
      const double length = std::hypot(tangent[0], tangent[1]);
      result.points.push_back(x);
      result.normals.push_back({tangent[1] / length, -tangent[0] / length});
      result.jxw.push_back(quadrature.weights[q] * length);
    }
  }
  return result;
}

/// The traction of one boundary id, in one batch.
void add_traction(int id, const BoundaryCondition &condition, const Discretisation &discretisation, Loads &loads) {
  const auto &basis = discretisation.elements[0].line();
  const auto quadrature = gauss_quadrature(discretisation.degree() + 2);
  const auto n_points = quadrature.points.size();
  const auto n_nodes = static_cast<std::size_t>(discretisation.degree()) + 1;
  std::vector<LagrangeBasis::Values> shape(n_points);
  std::vector<LagrangeBasis::Values> derivative(n_points);
  for (std::size_t q = 0; q < n_points; ++q)
    basis.evaluate(quadrature.points[q], shape[q], derivative[q]);
  const auto [nodes, points, normals, jxw] = edge_points(id, discretisation, quadrature, shape, derivative);

  std::vector<Vector> values(points.size(), Vector{});
  condition.traction(points, normals, values);
  auto &resultant = loads.tractions[id];
  const auto what = fmt::format("boundary id {}: the traction", id);
  for (std::size_t k = 0; k < points.size(); ++k) {
    for (std::size_t d = 0; d < 2; ++d)
      if (condition.kind[d] != ConditionKind::traction)
        values[k][d] = 0;
    check_finite(values[k], points[k], what);
    for (std::size_t d = 0; d < 2; ++d) {
      const double force = jxw[k] * values[k][d];
      resultant[d] += force;
      loads.magnitude += std::abs(force);
      for (std::size_t a = 0; a < n_nodes; ++a)
        loads.nodal[2 * std::size_t{nodes[k / n_points * n_nodes + a]} + d] += shape[k % n_points][a] * force;
    }
  }
}
} // namespace

Loads loads(const PlaneProblem &problem, const Discretisation &discretisation) {
  Loads result;
  result.nodal.assign(2 * discretisation.n_nodes(), 0.);
  if (problem.body_force)
    for (const auto &element : discretisation.elements)
      add_body_force(problem.body_force, element, discretisation, result);
  if (problem.thermal_strain)
    for (const auto &element : discretisation.elements)
      add_thermal_load(problem, element, discretisation, result);
  for (const auto &[id, condition] : problem.boundary)
    if (condition.traction &&
        (condition.kind[0] == ConditionKind::traction || condition.kind[1] == ConditionKind::traction))
      add_traction(id, condition, discretisation, result);
  return result;
}
} // namespace fem_reference::elasticity
