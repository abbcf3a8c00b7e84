#include "meshless/basis/derivative_operators.h"

#include "meshless/basis/grouped_evaluation.h"

#include <algorithm>
#include <array>
#include <span>
#include <stdexcept>

namespace meshless::basis {

namespace {

using linear_algebra::SparseRows;

/// One row before it has its place in a matrix.
struct Row {
  std::vector<std::int64_t> columns;
  std::vector<double> values;
};

/// Makes the row of particle i one of f - f(x_i).
void subtract_own_value(Row &row, std::int64_t i) {
  double sum = 0;
  for (const double value : row.values)
    sum += value;
  const auto place = std::lower_bound(row.columns.begin(), row.columns.end(), i);
  const auto at = place - row.columns.begin();
  if (place == row.columns.end() || *place != i) {
    row.columns.insert(place, i);
    row.values.insert(row.values.begin() + at, 0.0);
  }
  row.values[static_cast<std::size_t>(at)] -= sum;
}

/// (A B + B A) / 2; equal matrices are multiplied once.
SparseRows symmetric_product(const SparseRows &a, const SparseRows &b) {
  const auto n = static_cast<std::size_t>(a.n_rows());
  SparseRows result(a.n_columns());
  std::vector<double> sums(n, 0.0);
  std::vector<bool> seen(n, false);
  Row row;
  const auto add = [&](const SparseRows &left, const SparseRows &right, std::size_t i, double factor) {
    for (auto p = left.offsets()[i]; p < left.offsets()[i + 1]; ++p) {
      const auto middle = static_cast<std::size_t>(left.columns()[static_cast<std::size_t>(p)]);
      const double entry = factor * left.values()[static_cast<std::size_t>(p)];
      for (auto q = right.offsets()[middle]; q < right.offsets()[middle + 1]; ++q) {
        const auto column = static_cast<std::size_t>(right.columns()[static_cast<std::size_t>(q)]);
        if (!seen[column]) {
          seen[column] = true;
          row.columns.push_back(static_cast<std::int64_t>(column));
        }
        sums[column] += entry * right.values()[static_cast<std::size_t>(q)];
      }
    }
  };
  for (std::size_t i = 0; i < n; ++i) {
    row.columns.clear();
    row.values.clear();
    add(a, b, i, &a == &b ? 1 : .5);
    if (&a != &b)
      add(b, a, i, .5);
    std::sort(row.columns.begin(), row.columns.end());
    for (const auto column : row.columns) {
      row.values.push_back(sums[static_cast<std::size_t>(column)]);
      sums[static_cast<std::size_t>(column)] = 0;
      seen[static_cast<std::size_t>(column)] = false;
    }
    result.append_row(row.columns, row.values);
  }
  return result;
}

/// Rows of several quantities, in the order in which particles are visited; those of a particle have the same columns.
template <int dim>
class VisitedRows {
public:
  static constexpr std::size_t n_quantities = 1 + dim + ShapeFunctionValues<dim>::n_hessian;

  explicit VisitedRows(std::size_t n_particles) : rows_(n_particles) {}

  void add(const typename GroupedEvaluation<dim>::Group &group) {
    for (std::size_t p = 0; p < group.points.size(); ++p) {
      const std::size_t n = group.n_neighbours(p);
      const std::size_t first = columns_.size();
      rows_[group.points[p]] = {first, n};
      for (std::size_t j = 0; j < n; ++j)
        columns_.push_back(group.neighbour(j, p));
      for (std::size_t q = 0; q < n_quantities; ++q)
        if (const int quantity = static_cast<int>(q); group.values.has(quantity))
          for (std::size_t j = 0; j < n; ++j)
            values_[q].push_back(group.values.row(quantity, j)[p]);
    }
  }

  /// @param of_difference of f - f(x_i) instead of f
  SparseRows assemble(std::size_t quantity, bool of_difference) const {
    SparseRows matrix(static_cast<std::int64_t>(rows_.size()));
    matrix.reserve(columns_.size());
    Row row;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const auto columns = std::span(columns_).subspan(rows_[i].first, rows_[i].size);
      const auto values = std::span(values_[quantity]).subspan(rows_[i].first, rows_[i].size);
      if (!of_difference) {
        matrix.append_row(columns, values);
        continue;
      }
      row.columns.assign(columns.begin(), columns.end());
      row.values.assign(values.begin(), values.end());
      subtract_own_value(row, static_cast<std::int64_t>(i));
      matrix.append_row(row.columns, row.values);
    }
    return matrix;
  }

private:
  struct Place {
    std::size_t first = 0;
    std::size_t size = 0;
  };
  std::vector<Place> rows_; ///< of the particles
  std::vector<std::int64_t> columns_;
  std::array<std::vector<double>, n_quantities> values_;
};

} // namespace

template <int dim>
DerivativeOperators<dim> make_derivative_operators(const ShapeFunctions<dim> &basis,
                                                   const cloud::Particles<dim> &particles, const Wanted &wanted) {
  if (wanted.differentiated_gradient)
    throw std::invalid_argument("operators at particles have no derivatives of the shape functions themselves");
  const OperatorRule rule = basis.operator_rule();
  Wanted direct = wanted;
  direct.hessian = wanted.hessian && !rule.reiterate;
  direct.gradient = wanted.gradient || (wanted.hessian && rule.reiterate);

  DerivativeOperators<dim> operators;
  VisitedRows<dim> rows(particles.size());
  const cloud::CandidateSearch<dim> search(particles, basis.support());
  GroupedEvaluation<dim>(basis, search)
      .visit(
          particles.positions(), direct,
          [&](const auto &group) {
            operators.smallest_pivot_ratio =
                std::min(operators.smallest_pivot_ratio, group.regularity.smallest_pivot_ratio);
            operators.n_indefinite += group.regularity.n_indefinite;
            rows.add(group);
          },
          "particle");
  if (wanted.value)
    operators.value = rows.assemble(0, false);
  for (std::size_t k = 0; k < dim && direct.gradient; ++k)
    operators.gradient.push_back(rows.assemble(1 + k, rule.subtract_own_value));
  if (direct.hessian)
    for (std::size_t kl = 0; kl < ShapeFunctionValues<dim>::n_hessian; ++kl)
      operators.hessian.push_back(rows.assemble(1 + dim + kl, false));
  else if (wanted.hessian)
    for (std::size_t k = 0; k < dim; ++k)
      for (std::size_t l = k; l < dim; ++l)
        operators.hessian.push_back(symmetric_product(operators.gradient[k], operators.gradient[l]));
  if (!wanted.gradient)
    operators.gradient.clear();
  return operators;
}

#define INSTANTIATE(dim)                                                                                               \
  template DerivativeOperators<dim> make_derivative_operators<dim>(const ShapeFunctions<dim> &,                        \
                                                                   const cloud::Particles<dim> &, const Wanted &);
INSTANTIATE(1)
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

} // namespace meshless::basis
