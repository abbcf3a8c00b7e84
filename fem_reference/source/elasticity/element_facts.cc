#include "fem_reference/elasticity/element_facts.h"

#include "../linear_algebra/block_matrix.h"
#include "../stopwatch.h"
#include "discretisation.h"
#include "stiffness.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
Discretisation discretised(const PlaneProblem &problem, int degree) {
  if (degree < 1 || degree > max_degree)
    throw InvalidInput(fmt::format("element degree {}: expected 1 to {}", degree, max_degree));
  double unused_mesh = 0, unused_numbering = 0;
  return discretise(problem.mesh, degree, unused_mesh, unused_numbering);
}

/// The stored lower triangle holds block rows by column; the pattern is symmetric.
void add_pattern(const Discretisation &discretisation, ElementFacts &facts) {
  const linear_algebra::BlockMatrix matrix(discretisation.n_nodes(), discretisation.cell_start,
                                           discretisation.cell_nodes);
  std::vector<std::vector<std::int64_t>> rows(discretisation.n_nodes());
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (int k = matrix.block_start[j]; k < matrix.block_start[j + 1]; ++k) {
      const auto i = static_cast<std::size_t>(matrix.block_rows[static_cast<std::size_t>(k)]);
      rows[i].push_back(static_cast<std::int64_t>(j));
      if (i != j)
        rows[j].push_back(static_cast<std::int64_t>(i));
    }
  facts.row_start.push_back(0);
  for (auto &row : rows) {
    std::sort(row.begin(), row.end());
    facts.columns.insert(facts.columns.end(), row.begin(), row.end());
    facts.row_start.push_back(static_cast<std::int64_t>(facts.columns.size()));
  }
}

/// Visits all quadrature points; the sum of what it computes is returned, so that nothing of it is optimised away.
double visit_points(const Discretisation &discretisation, bool with_gradients, ElementFacts *facts) {
  const std::array<Quadrature2d, 2> rules{cell_quadrature(3, discretisation.degree() + 1),
                                          cell_quadrature(4, discretisation.degree() + 1)};
  ReferenceElement::Values n{}, d1{}, d2{};
  double sum = 0;
  for (std::size_t c = 0; c < discretisation.n_cells; ++c) {
    const auto &element = discretisation.element_of(c);
    const auto &rule = rules[discretisation.n_vertices[c] - 3U];
    const auto nodes = discretisation.nodes_of(c);
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      element.evaluate(rule.points[q], n, d1, d2);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        sum += n[a];
      if (!with_gradients)
        continue;
      const auto j = discretisation.jacobian(c, d1.data(), d2.data());
      const double determinant = j.determinant();
      for (std::size_t a = 0; a < nodes.size(); ++a)
        sum += (j.j22 * d1[a] - j.j21 * d2[a]) / determinant + (j.j11 * d2[a] - j.j12 * d1[a]) / determinant;
      if (facts != nullptr)
        facts->area += determinant * rule.weights[q];
    }
    if (facts != nullptr) {
      facts->n_quadrature_points += rule.points.size();
      facts->functions_per_point += static_cast<double>(rule.points.size() * nodes.size());
    }
  }
  return sum;
}

double median_seconds(const Discretisation &discretisation, bool with_gradients, int repeats) {
  std::vector<double> samples;
  volatile double keep = 0;
  for (int k = 0; k < std::max(1, repeats); ++k) {
    Stopwatch watch;
    keep = visit_points(discretisation, with_gradients, nullptr);
    samples.push_back(watch.lap());
  }
  (void)keep;
  std::nth_element(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2), samples.end());
  return samples[samples.size() / 2];
}
} // namespace

ElementFacts element_facts(const PlaneProblem &problem, int degree, int repeats) {
  const auto discretisation = discretised(problem, degree);
  ElementFacts facts;
  add_pattern(discretisation, facts);
  visit_points(discretisation, true, &facts);
  facts.functions_per_point /= static_cast<double>(facts.n_quadrature_points);
  facts.value_seconds = median_seconds(discretisation, false, repeats);
  facts.gradient_seconds = median_seconds(discretisation, true, repeats);
  return facts;
}

double symmetry_defect(const PlaneProblem &problem, int degree) {
  const auto discretisation = discretised(problem, degree);
  constexpr int n_probes = 16;
  std::mt19937 random(20080607);
  const auto signs = [&] {
    std::vector<double> x(2 * discretisation.n_nodes());
    for (double &value : x)
      value = random() % 2 == 0 ? -1 : 1;
    return x;
  };
  const auto dot = [](const std::vector<double> &x, const std::vector<double> &y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      sum += x[i] * y[i];
    return sum;
  };
  double difference = 0, whole = 0;
  for (int k = 0; k < n_probes; ++k) {
    const auto u = signs(), v = signs();
    const double forward = dot(v, internal_forces(discretisation, problem.materials, u).forces);
    const double backward = dot(u, internal_forces(discretisation, problem.materials, v).forces);
    difference += (forward - backward) * (forward - backward);
    whole += .5 * (forward * forward + backward * backward);
  }
  return std::sqrt(difference / whole);
}
} // namespace fem_reference::elasticity
