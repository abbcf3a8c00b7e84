// A new basis: Shepard's functions behind the interface of all bases, evaluated on an irregular cloud.

#include "meshless/basis/basis_table.h"
#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/shape_functions.h"
#include "meshless/kernels/kernel_table.h"
#include "system/contributing/checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

namespace meshless::basis {

/// Shepard's functions, Shepard 1968, with weights of compact support:
///   phi_J = w_J / S,  w_J = V_J G / h_J^dim W(|xi_J - x| / h_J),
///   phi_J,k = (w_J,k - phi_J S,k) / S,  S = sum_K w_K,
///   phi_J,kl = (w_J,kl - phi_J,k S,l - phi_J,l S,k - phi_J S,kl) / S.
/// They are MLS of order 0: constants are exact, nothing else is.
template <int dim>
class Shepard final : public ShapeFunctions<dim> {
public:
  using typename ShapeFunctions<dim>::Workspace;
  using Values = ShapeFunctionValues<dim>;

  explicit Shepard(const kernels::Kernel &kernel) : kernel_(kernel) {}

  double support() const override { return kernels::support_of(kernel_); }
  int order() const override { return 0; }
  std::size_t n_terms() const override { return 1; }

  Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates, const Wanted &wanted,
                      Values &values, Workspace &workspace) const override {
    values.resize(wanted, candidates.size(), points.stride());
    for (int quantity = 0; quantity < Values::n_quantities; ++quantity)
      for (std::size_t j = 0; j < candidates.size() && values.has(quantity); ++j)
        std::fill_n(values.row(quantity, j), points.stride(), 0.0);
    Regularity regularity;
    if (candidates.size() == 0) // require_regular makes an error of it that names the point
      regularity.smallest_pivot_ratio = 0;
    for (std::size_t i = 0; i < points.size() && candidates.size() > 0; ++i) {
      workspace.neighbours.collect(kernel_, EdgeRule::excluded, points.point(i), candidates, candidates.scale());
      if (workspace.neighbours.all.empty())
        regularity = {.smallest_pivot_ratio = 0, .worst_point = i, .n_neighbours = 0};
      else
        write_point(workspace.neighbours.all, i, 1 / candidates.scale(), values);
    }
    return regularity;
  }

private:
  void write_point(const std::vector<PointNeighbour<dim>> &neighbours, std::size_t i, double per_length,
                   Values &values) const {
    PointNeighbour<dim> sum; // of weights and their derivatives
    for (const auto &neighbour : neighbours) {
      sum.weight += neighbour.weight;
      for (int k = 0; k < dim; ++k)
        sum.gradient[k] += neighbour.gradient[k];
      for (int kl = 0; kl < Values::n_hessian; ++kl)
        sum.hessian[kl] += neighbour.hessian[kl];
    }
    for (const auto &neighbour : neighbours) {
      const auto put = [&](int quantity, double number) {
        if (values.has(quantity))
          values.row(quantity, neighbour.candidate)[i] = number;
      };
      const double phi = neighbour.weight / sum.weight;
      put(0, phi);
      // Neighbours hold derivatives by xi_J, in units of the scale: by x the first ones change their sign.
      std::array<double, dim> phi_k;
      for (int k = 0; k < dim; ++k) {
        phi_k[k] = (neighbour.gradient[k] - phi * sum.gradient[k]) / sum.weight;
        put(1 + k, -phi_k[k] * per_length);
        put(1 + dim + Values::n_hessian + k, -phi_k[k] * per_length); // the differentiated gradient is the same
      }
      for (int k = 0, kl = 0; k < dim; ++k)
        for (int l = k; l < dim; ++l, ++kl)
          put(1 + dim + kl, (neighbour.hessian[kl] - phi_k[k] * sum.gradient[l] - phi_k[l] * sum.gradient[k] -
                             phi * sum.hessian[kl]) /
                                sum.weight * per_length * per_length);
    }
  }

  kernels::Kernel kernel_;
};

/// @throws std::invalid_argument for a kernel with negative values: the sum of the weights could vanish
template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_shepard(const kernels::Kernel &kernel) {
  if (!kernels::describe(kernel).non_negative)
    throw std::invalid_argument(fmt::format("shepard needs a kernel without negative values, and {} has some; choose "
                                            "another, such as cubic_spline",
                                            kernels::describe(kernel).name));
  return std::make_unique<Shepard<dim>>(kernel);
}

/// The line of the table in basis_table.cc.
constexpr BasisDescription shepard_line = {.name = "shepard",
                                           .meaning = "Shepard's functions, MLS of order 0 (Shepard 1968)",
                                           .lowest_order = 0,
                                           .highest_order = 0,
                                           .volumes = VolumeUse::always,
                                           .highest_dimension = 3,
                                           .hessian_anywhere = true,
                                           .differentiable = true};

} // namespace meshless::basis

namespace {

using namespace meshless;

constexpr double spacing = 0.1;

/// 11 x 11 particles on the unit square, moved by up to a fifth of their spacing.
cloud::Particles<2> irregular_particles() {
  std::vector<cloud::Point<2>> positions;
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j)
      positions.push_back(
          {spacing * (i + 0.2 * std::sin(3.0 * i + 5.0 * j)), spacing * (j + 0.2 * std::cos(7.0 * i - 2.0 * j))});
  const std::size_t n = positions.size();
  return {std::move(positions), std::vector<double>(n, 1.2 * spacing), std::vector<double>(n, spacing * spacing)};
}

/// A function estimated at a point, its derivatives, and the least shape function.
struct Estimate {
  double value = 0;
  std::array<double, 2> gradient{};
  std::array<double, 3> hessian{}; ///< 11, 12, 22
  double least = 0;
};

template <typename F>
std::vector<Estimate> estimates(const basis::ShapeFunctions<2> &shape, const cloud::Particles<2> &particles,
                                const std::vector<cloud::Point<2>> &points, const F &f) {
  std::vector<Estimate> result(points.size());
  const cloud::CandidateSearch<2> search(particles, shape.support());
  const basis::GroupedEvaluation<2> evaluation(shape, search);
  evaluation.visit(points, {.value = true, .gradient = true, .hessian = true}, [&](const auto &group) {
    for (std::size_t i = 0; i < group.points.size(); ++i)
      for (std::size_t j = 0; j < group.n_neighbours(i); ++j) {
        auto &estimate = result[group.points[i]];
        const double f_j = f(particles.position(group.neighbour(j, i)));
        estimate.value += group.values.value(j)[i] * f_j;
        for (int k = 0; k < 2; ++k)
          estimate.gradient[k] += group.values.gradient(k, j)[i] * f_j;
        for (int kl = 0; kl < 3; ++kl)
          estimate.hessian[kl] += group.values.hessian(kl, j)[i] * f_j;
        estimate.least = std::min(estimate.least, group.values.value(j)[i]);
      }
  });
  return result;
}

template <typename Error>
bool throws(const auto &action) {
  try {
    action();
  } catch (const Error &) {
    return true;
  }
  return false;
}

void check_shepard(contributing::Checks &checks) {
  const auto particles = irregular_particles();
  const auto shepard = basis::make_shepard<2>(kernels::CubicSpline());
  checks.holds("order as the table says", shepard->order() == basis::shepard_line.highest_order);
  const double e = 1e-5;
  for (const cloud::Point<2> x : {cloud::Point<2>{0.5, 0.5}, {0.03, 0.41}, {0.99, 0.99}}) {
    const auto constant = estimates(*shepard, particles, {x}, [](const auto &) { return 1.0; })[0];
    // A few dozen terms of size 1, 1 / spacing and 1 / spacing^2.
    checks.near("partition of unity", constant.value, 1, 1e-15 * 30);
    checks.near("gradient of a constant", std::hypot(constant.gradient[0], constant.gradient[1]), 0, 1e-14 / spacing);
    for (const double second : constant.hessian)
      checks.near("second derivative of a constant", second, 0, 1e-14 / (spacing * spacing));
    checks.holds("no shape function is negative", constant.least >= 0);

    const auto f = [](const cloud::Point<2> &p) { return 2 * p[0] - p[1]; };
    const auto found =
        estimates(*shepard, particles, {x, {x[0] + e, x[1]}, {x[0] - e, x[1]}, {x[0], x[1] + e}, {x[0], x[1] - e}}, f);
    // A mean of values within the support: |grad f| times its radius.
    checks.near("a linear function", found[0].value, f(x), std::sqrt(5.0) * shepard->support() * 1.2 * spacing);
    // Central differences: e^2 / 6 times the next but one derivative, of about 100 over spacing^2 or ^3, and rounding.
    for (int k = 0; k < 2; ++k) {
      const auto &ahead = found[1 + 2 * k];
      const auto &behind = found[2 + 2 * k];
      checks.near("gradient", found[0].gradient[k], (ahead.value - behind.value) / (2 * e),
                  e * e * 100 / (6 * spacing * spacing) + 1e-15 / e);
      for (int l = 0; l < 2; ++l)
        checks.near("hessian", found[0].hessian[k + l], (ahead.gradient[l] - behind.gradient[l]) / (2 * e),
                    e * e * 100 / (6 * spacing * spacing * spacing) + 1e-15 / (spacing * e));
    }
  }
}

void check_refusals(contributing::Checks &checks) {
  const auto particles = irregular_particles();
  const auto shepard = basis::make_shepard<2>(kernels::CubicSpline());
  checks.holds("a point without neighbours is an error", throws<basis::SingularMomentMatrix>([&] {
                 estimates(*shepard, particles, {{3, 3}}, [](const auto &) { return 1.0; });
               }));
  checks.holds("a kernel with negative values is refused",
               throws<std::invalid_argument>([] { basis::make_shepard<2>(kernels::NewQuartic()); }));
}

} // namespace

int main() {
  contributing::Checks checks;
  check_shepard(checks);
  check_refusals(checks);
  return checks.exit_code();
}
