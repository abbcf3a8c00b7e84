#include "meshless/elasticity/field_energy.h"

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/cloud/candidate_search.h"

#include <array>

namespace meshless::elasticity {

namespace {

using linear_algebra::SparseRows;

/// Rows of value and slopes at the points, in their order.
std::array<SparseRows, 3> rows_at(const EquationsOfMotion &equations, std::span<const Point2> points) {
  const auto &particles = *equations.particles;
  const auto &surroundings = *equations.surroundings;
  const bool direct = equations.derivatives == DerivativeRule::direct;
  struct Row {
    std::vector<std::int64_t> columns;
    std::array<std::vector<double>, 3> values;
  };
  std::vector<Row> rows(points.size());
  const cloud::CandidateSearch<2> search(particles, equations.basis->support());
  for (std::size_t region = 0; region < surroundings.n_regions(); ++region) {
    std::vector<Point2> own;
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (surroundings.region_of(points[i]) == region) {
        own.push_back(points[i]);
        numbers.push_back(i);
      }
    RegionFilter filter(surroundings, particles, region);
    const basis::GroupedEvaluation<2> evaluation(*equations.basis, search, surroundings.simple() ? nullptr : &filter);
    if (own.empty())
      continue;
    evaluation.visit(
        own, {.value = true, .gradient = direct, .differentiated_gradient = !direct}, [&](const auto &group) {
          for (std::size_t p = 0; p < group.points.size(); ++p) {
            Row &row = rows[numbers[group.points[p]]];
            for (std::size_t j = 0; j < group.n_neighbours(p); ++j) {
              row.columns.push_back(group.neighbour(j, p));
              row.values[0].push_back(group.values.value(j)[p]);
              for (int k = 0; k < 2; ++k)
                row.values[static_cast<std::size_t>(1 + k)].push_back(
                    direct ? group.values.gradient(k, j)[p] : group.values.differentiated_gradient(k, j)[p]);
            }
          }
        });
  }
  const auto n = static_cast<std::int64_t>(particles.size());
  std::array<SparseRows, 3> result{SparseRows(n), SparseRows(n), SparseRows(n)};
  for (const auto &row : rows)
    for (std::size_t k = 0; k < 3; ++k)
      result[k].append_row(row.columns, row.values[k]);
  return result;
}

/// Component d of the field at the points of the rows.
std::vector<double> apply(const SparseRows &rows, std::span<const double> coefficients, std::size_t d) {
  std::vector<double> component(coefficients.size() / 2);
  for (std::size_t i = 0; i < component.size(); ++i)
    component[i] = coefficients[2 * i + d];
  std::vector<double> values(static_cast<std::size_t>(rows.n_rows()));
  rows.multiply(component, values);
  return values;
}

} // namespace

FieldEnergy::FieldEnergy(const EquationsOfMotion &equations, std::span<const double> densities,
                         const Quadrature &quadrature)
    : value_(0), slope_1_(0), slope_2_(0), force_value_(0), weights_(quadrature.weights), forces_(quadrature.forces) {
  auto rows = rows_at(equations, quadrature.points);
  value_ = std::move(rows[0]);
  slope_1_ = std::move(rows[1]);
  slope_2_ = std::move(rows[2]);
  force_value_ = std::move(rows_at(equations, quadrature.force_points)[0]);
  for (const auto &point : quadrature.points) {
    const std::size_t region = equations.surroundings->region_of(point);
    materials_.push_back(equations.surroundings->material(region));
    densities_.push_back(densities[region]);
  }
}

double FieldEnergy::kinetic(std::span<const double> velocity) const {
  double sum = 0;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto v = apply(value_, velocity, d);
    for (std::size_t q = 0; q < v.size(); ++q)
      sum += 0.5 * weights_[q] * densities_[q] * v[q] * v[q];
  }
  return sum;
}

double FieldEnergy::strain(std::span<const double> displacement) const {
  const auto u11 = apply(slope_1_, displacement, 0);
  const auto u12 = apply(slope_2_, displacement, 0);
  const auto u21 = apply(slope_1_, displacement, 1);
  const auto u22 = apply(slope_2_, displacement, 1);
  double sum = 0;
  for (std::size_t q = 0; q < weights_.size(); ++q) {
    const auto &d = materials_[q];
    const double gamma = u12[q] + u21[q];
    sum += 0.5 * weights_[q] *
           (d.axial() * (u11[q] * u11[q] + u22[q] * u22[q]) + 2 * d.coupling() * u11[q] * u22[q] +
            d.shear() * gamma * gamma);
  }
  return sum;
}

double FieldEnergy::work(std::span<const double> displacement) const {
  double sum = 0;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto u = apply(force_value_, displacement, d);
    for (std::size_t q = 0; q < u.size(); ++q)
      sum += forces_[q][d] * u[q];
  }
  return sum;
}

} // namespace meshless::elasticity
