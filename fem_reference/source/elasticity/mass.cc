#include "mass.h"

#include "../parallel/bands.h"

#include <array>

namespace fem_reference::elasticity {
namespace {
using parallel::Band;

/// Determinant of the Jacobian from the slopes of the shape functions at a point.
double jacobian(const Discretisation &discretisation, std::span<const unsigned> nodes, const double *slope_1,
                const double *slope_2) {
  std::array<double, 4> j{};
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    const auto &x = discretisation.positions[nodes[a]];
    j[0] += x[0] * slope_1[a];
    j[1] += x[0] * slope_2[a];
    j[2] += x[1] * slope_1[a];
    j[3] += x[1] * slope_2[a];
  }
  return j[0] * j[3] - j[1] * j[2];
}

/// Calls function(nodes, m) with the consistent mass m[a * n + b] of every cell of one shape that touches the band.
template <typename Function>
void for_each_cell_mass(const ReferenceElement &element, const Discretisation &discretisation,
                        std::span<const double> densities, const Band &band, const Function &function) {
  // Degree 2 p for the product and up to 2 p more for a curved cell's Jacobian.
  const ShapeTable table(element, cell_quadrature(element.n_vertices(), element.degree() + 2));
  const auto n = static_cast<std::size_t>(table.n_nodes);
  std::vector<double> mass(n * n);
  for (const std::size_t c : cells_touching(band, discretisation, element.n_vertices())) {
    const auto nodes = discretisation.nodes_of(c);
    const double density = densities[static_cast<std::size_t>(discretisation.regions[c])];
    mass.assign(n * n, 0);
    for (std::size_t q = 0; q < static_cast<std::size_t>(table.n_points); ++q) {
      const double weight = density * table.weights[q] *
                            jacobian(discretisation, nodes, &table.gradients_1[q * n], &table.gradients_2[q * n]);
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b)
          mass[a * n + b] += weight * table.values[q * n + a] * table.values[q * n + b];
    }
    function(nodes, mass);
  }
}

void lump_quadrilaterals(const Discretisation &discretisation, std::span<const double> densities, const Band &band,
                         std::vector<double> &nodal) {
  const ReferenceElement &element = discretisation.elements[1];
  const auto n = static_cast<std::size_t>(element.n_nodes());
  const ShapeTable table(element, cell_quadrature(4, element.degree() + 1));
  std::vector<double> weights(n, 0); // of the Gauss-Lobatto rule: integrals of its Lagrange polynomials
  for (std::size_t q = 0; q < static_cast<std::size_t>(table.n_points); ++q)
    for (std::size_t a = 0; a < n; ++a)
      weights[a] += table.weights[q] * table.values[q * n + a];
  std::vector<ReferenceElement::Values> slope_1(n), slope_2(n);
  for (std::size_t a = 0; a < n; ++a) {
    ReferenceElement::Values unused;
    element.evaluate(element.nodes()[a], unused, slope_1[a], slope_2[a]);
  }
  for (const std::size_t c : cells_touching(band, discretisation, 4)) {
    const auto nodes = discretisation.nodes_of(c);
    const double density = densities[static_cast<std::size_t>(discretisation.regions[c])];
    for (std::size_t a = 0; a < n; ++a)
      if (band.holds(nodes[a]))
        nodal[nodes[a]] += density * weights[a] * jacobian(discretisation, nodes, slope_1[a].data(), slope_2[a].data());
  }
}

void lump_triangles(const Discretisation &discretisation, std::span<const double> densities, const Band &band,
                    std::vector<double> &nodal) {
  for_each_cell_mass(discretisation.elements[0], discretisation, densities, band,
                     [&](std::span<const unsigned> nodes, const std::vector<double> &mass) {
                       const std::size_t n = nodes.size();
                       double total = 0;
                       double diagonal = 0;
                       for (std::size_t a = 0; a < n; ++a)
                         diagonal += mass[a * n + a];
                       for (const double m : mass)
                         total += m;
                       for (std::size_t a = 0; a < n; ++a)
                         if (band.holds(nodes[a]))
                           nodal[nodes[a]] += mass[a * n + a] * total / diagonal;
                     });
}

/// One cell's mass to the columns of the band.
void add_to_matrix(std::span<const unsigned> nodes, const std::vector<double> &mass, const Band &band,
                   linear_algebra::BlockMatrix &matrix) {
  const std::size_t n = nodes.size();
  for (std::size_t b = 0; b < n; ++b) {
    const unsigned column = nodes[b];
    if (!band.holds(column))
      continue;
    const int first = matrix.block_start[column];
    const int n_blocks = matrix.block_start[column + 1] - first;
    double *column_0 = matrix.values.data() + matrix.first_entry(column);
    double *column_1 = column_0 + 2 * n_blocks - 1; // its row 2 column is not stored
    for (std::size_t a = 0; a < n; ++a) {
      if (nodes[a] < column)
        continue;
      const int k = matrix.find(nodes[a], column) - first;
      column_0[2 * k] += mass[a * n + b];
      column_1[2 * k + 1] += mass[a * n + b];
    }
  }
}
} // namespace

void assemble_mass(const Discretisation &discretisation, std::span<const double> densities,
                   linear_algebra::BlockMatrix &matrix) {
  parallel::for_each_band(discretisation.n_nodes(), [&](const Band &band, int) {
    for (const auto &element : discretisation.elements)
      for_each_cell_mass(element, discretisation, densities, band,
                         [&](std::span<const unsigned> nodes, const std::vector<double> &mass) {
                           add_to_matrix(nodes, mass, band, matrix);
                         });
  });
}

std::vector<double> lumped_mass(const Discretisation &discretisation, std::span<const double> densities) {
  std::vector<double> nodal(discretisation.n_nodes(), 0);
  parallel::for_each_band(discretisation.n_nodes(), [&](const Band &band, int) {
    lump_quadrilaterals(discretisation, densities, band, nodal);
    lump_triangles(discretisation, densities, band, nodal);
  });
  return nodal;
}

void set_diagonal(std::span<const double> nodal_mass, linear_algebra::BlockMatrix &matrix) {
  for (unsigned j = 0; j < nodal_mass.size(); ++j) {
    const auto n_blocks = static_cast<std::size_t>(matrix.block_start[j + 1] - matrix.block_start[j]);
    const std::size_t first = matrix.first_entry(j);
    matrix.values[first] = matrix.values[first + 2 * n_blocks] = nodal_mass[j];
  }
}
} // namespace fem_reference::elasticity
