#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include "meshless/domain/local_subdomain.h"
#include "meshless/linear_algebra/pack.h"
#include "meshless/linear_algebra/sparse_lu.h"
#include "meshless/linear_algebra/sparse_rows.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <algorithm>

namespace meshless::elasticity::weak_form {

namespace {

using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::Stopwatch;

/// Points of one batch: enough to fill SIMD lanes, few enough that the shape functions of a batch
/// stay in the second-level cache.
constexpr std::size_t batch_size = 64;

/// Assembles the two rows of one particle after the other; all scratch is reused.
class Assembler {
public:
  Assembler(const PlaneProblem &problem, const cloud::Particles<2> &particles, const basis::ShapeFunctions<2> &basis,
            const Parameters &parameters)
      : problem_(problem), particles_(particles), basis_(basis), parameters_(parameters),
        rule_(problem.boundary, parameters.quadrature_points), search_(particles, basis.support()),
        alpha_(parameters.penalty * problem.material.plane_modulus() / parameters.characteristic_length) {}

  /// Appends rows 2 I and 2 I + 1.
  void assemble(std::size_t particle, linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
    Stopwatch watch;
    centre_ = particles_.position(particle);
    h_ = particles_.smoothing_length(particle);
    const double radius = parameters_.test_radius * h_;
    test_length_ = radius / kernels::support_of(parameters_.test_function);
    rule_.build(centre_, radius, quadrature_);
    seconds.assembly += watch.lap();
    search_.collect(centre_, radius, candidates_);
    candidate_batch_.assign(particles_, candidates_);
    seconds.neighbours += watch.lap();

    const std::size_t n = candidates_.size();
    for (auto &block : blocks_)
      block.assign(n, 0.0);
    right_ = {0, 0};
    integrate_domain();
    for (const auto &part : quadrature_.parts)
      integrate_boundary(part);
    watch.lap();
    append_rows(matrix, right_hand_side);
    seconds.assembly += watch.lap();
  }

  SolveSeconds seconds;

private:
  /// W_I and grad W_I at the current points.
  void evaluate_test_function(std::span<const double> x, std::span<const double> y, bool with_gradient) {
    const std::size_t n = x.size();
    test_.resize(n);
    if (with_gradient)
      for (auto &component : test_gradient_)
        component.resize(n);
    const double inverse_h = 1 / test_length_;
    std::visit(
        [&](const auto &kernel) {
          for (std::size_t q = 0; q < n; ++q) {
            const double dx = (x[q] - centre_[0]) * inverse_h;
            const double dy = (y[q] - centre_[1]) * inverse_h;
            const double s_squared = dx * dx + dy * dy;
            test_[q] = kernel.value(s_squared);
            if (with_gradient) {
              const double slope = kernel.slope(s_squared) * inverse_h;
              test_gradient_[0][q] = slope * dx;
              test_gradient_[1][q] = slope * dy;
            }
          }
        },
        parameters_.test_function);
  }

  const double *derivative(int k, std::size_t j) const {
    return parameters_.derivatives == DerivativeRule::direct ? values_.gradient(k, j)
                                                             : values_.differentiated_gradient(k, j);
  }

  void evaluate_basis(std::span<const double> x, std::span<const double> y, bool with_value) {
    Stopwatch watch;
    const bool direct = parameters_.derivatives == DerivativeRule::direct;
    batch_.assign(std::array<std::span<const double>, 2>{x, y});
    const auto regularity =
        basis_.evaluate(batch_, candidate_batch_,
                        {.value = with_value, .gradient = direct, .hessian = false, .differentiated_gradient = !direct},
                        values_, workspace_);
    basis::require_regular(regularity, batch_, basis_);
    seconds.basis += watch.lap();
  }

  void integrate_domain() {
    Stopwatch watch;
    const std::span<const double> x = quadrature_.point[0];
    const std::span<const double> y = quadrature_.point[1];
    evaluate_test_function(x, y, true);
    const std::size_t n = candidates_.size();
    sums_.assign(4 * n, Pack(0.0));
    for (std::size_t begin = 0; begin < x.size(); begin += batch_size) {
      const std::size_t size = std::min(batch_size, x.size() - begin);
      seconds.assembly += watch.lap();
      evaluate_basis(x.subspan(begin, size), y.subspan(begin, size), false);
      watch.lap();
      for (int a = 0; a < 2; ++a) {
        weighted_[a].assign(batch_.stride(), 0.0); // padding weighs nothing
        for (std::size_t q = 0; q < size; ++q)
          weighted_[a][q] = quadrature_.JxW[begin + q] * test_gradient_[a][begin + q];
      }
      add_gradient_products(n);
    }
    // sums_[4 j + 2 a + b] = int W,a phi_j,b; the material comes in once per candidate.
    const auto &d = problem_.material;
    for (std::size_t j = 0; j < n; ++j) {
      const double s11 = reduce(sums_[4 * j]);
      const double s12 = reduce(sums_[4 * j + 1]);
      const double s21 = reduce(sums_[4 * j + 2]);
      const double s22 = reduce(sums_[4 * j + 3]);
      blocks_[0][j] += d.axial() * s11 + d.shear() * s22;
      blocks_[1][j] += d.coupling() * s12 + d.shear() * s21;
      blocks_[2][j] += d.shear() * s12 + d.coupling() * s21;
      blocks_[3][j] += d.shear() * s11 + d.axial() * s22;
    }
    if (problem_.body_force)
      integrate_body_force();
    seconds.assembly += watch.lap();
  }

  void add_gradient_products(std::size_t n) {
    for (std::size_t j = 0; j < n; ++j) {
      const double *phi1 = derivative(0, j);
      const double *phi2 = derivative(1, j);
      Pack s11 = sums_[4 * j];
      Pack s12 = sums_[4 * j + 1];
      Pack s21 = sums_[4 * j + 2];
      Pack s22 = sums_[4 * j + 3];
      for (std::size_t q = 0; q < batch_.stride(); q += n_lanes) {
        const Pack w1 = load(&weighted_[0][q]);
        const Pack w2 = load(&weighted_[1][q]);
        const Pack p1 = load(phi1 + q);
        const Pack p2 = load(phi2 + q);
        s11 += w1 * p1;
        s12 += w1 * p2;
        s21 += w2 * p1;
        s22 += w2 * p2;
      }
      sums_[4 * j] = s11;
      sums_[4 * j + 1] = s12;
      sums_[4 * j + 2] = s21;
      sums_[4 * j + 3] = s22;
    }
  }

  void integrate_body_force() {
    const std::size_t n = quadrature_.JxW.size();
    points_.resize(n);
    fields_.resize(n);
    for (std::size_t q = 0; q < n; ++q)
      points_[q] = {quadrature_.point[0][q], quadrature_.point[1][q]};
    problem_.body_force(points_, fields_);
    for (std::size_t q = 0; q < n; ++q)
      for (int k = 0; k < 2; ++k)
        right_[k] += quadrature_.JxW[q] * test_[q] * fields_[q][k];
  }

  void integrate_boundary(const domain::SubdomainQuadrature::Part &part) {
    Stopwatch watch;
    const auto &condition = problem_.conditions.at(part.id);
    const std::size_t size = part.end - part.begin;
    const auto x = std::span<const double>(quadrature_.boundary_point[0]).subspan(part.begin, size);
    const auto y = std::span<const double>(quadrature_.boundary_point[1]).subspan(part.begin, size);
    evaluate_test_function(x, y, false);
    points_.resize(size);
    for (std::size_t q = 0; q < size; ++q)
      points_[q] = {x[q], y[q]};
    bool any_displacement = false;
    bool any_traction = false;
    for (const auto kind : condition.kind)
      (kind == ConditionKind::displacement ? any_displacement : any_traction) = true;
    fields_.resize(size);
    if (any_traction && condition.traction) {
      normals_.resize(size);
      for (std::size_t q = 0; q < size; ++q)
        normals_[q] = {quadrature_.boundary_normal[0][part.begin + q], quadrature_.boundary_normal[1][part.begin + q]};
      condition.traction(points_, normals_, fields_);
      add_to_right_hand_side(part, condition, ConditionKind::traction, 1);
    }
    if (any_displacement) {
      condition.displacement(points_, fields_);
      add_to_right_hand_side(part, condition, ConditionKind::displacement, alpha_);
      seconds.assembly += watch.lap();
      evaluate_basis(x, y, true);
      watch.lap();
      add_essential_terms(part, condition, size);
    }
    seconds.assembly += watch.lap();
  }

  void add_to_right_hand_side(const domain::SubdomainQuadrature::Part &part, const BoundaryCondition &condition,
                              ConditionKind kind, double factor) {
    for (int k = 0; k < 2; ++k)
      if (condition.kind[k] == kind)
        for (std::size_t q = 0; q < part.end - part.begin; ++q)
          right_[k] += factor * quadrature_.boundary_JxW[part.begin + q] * test_[q] * fields_[q][k];
  }

  /// alpha int u_i W - int sigma_ij n_j W for the components i whose displacement is prescribed.
  void add_essential_terms(const domain::SubdomainQuadrature::Part &part, const BoundaryCondition &condition,
                           std::size_t size) {
    const auto &d = problem_.material;
    for (std::size_t j = 0; j < candidates_.size(); ++j) {
      double value = 0;
      // s_kl = int W phi_j,k n_l
      double s11 = 0, s12 = 0, s21 = 0, s22 = 0;
      for (std::size_t q = 0; q < size; ++q) {
        const double weight = quadrature_.boundary_JxW[part.begin + q] * test_[q];
        const double n1 = quadrature_.boundary_normal[0][part.begin + q];
        const double n2 = quadrature_.boundary_normal[1][part.begin + q];
        const double phi1 = weight * derivative(0, j)[q];
        const double phi2 = weight * derivative(1, j)[q];
        value += weight * values_.value(j)[q];
        s11 += phi1 * n1;
        s12 += phi1 * n2;
        s21 += phi2 * n1;
        s22 += phi2 * n2;
      }
      if (condition.kind[0] == ConditionKind::displacement) {
        blocks_[0][j] += alpha_ * value - (d.axial() * s11 + d.shear() * s22);
        blocks_[1][j] -= d.coupling() * s21 + d.shear() * s12;
      }
      if (condition.kind[1] == ConditionKind::displacement) {
        blocks_[2][j] -= d.shear() * s21 + d.coupling() * s12;
        blocks_[3][j] += alpha_ * value - (d.shear() * s11 + d.axial() * s22);
      }
    }
  }

  void append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
    const std::size_t n = candidates_.size();
    columns_.resize(2 * n);
    entries_.resize(2 * n);
    for (std::size_t j = 0; j < n; ++j) {
      columns_[2 * j] = 2 * std::int64_t{candidates_[j]};
      columns_[2 * j + 1] = columns_[2 * j] + 1;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < n; ++j) {
        entries_[2 * j] = blocks_[2 * i][j];
        entries_[2 * j + 1] = blocks_[2 * i + 1][j];
      }
      matrix.append_row(columns_, entries_);
      right_hand_side.push_back(right_[i]);
    }
  }

  const PlaneProblem &problem_;
  const cloud::Particles<2> &particles_;
  const basis::ShapeFunctions<2> &basis_;
  const Parameters &parameters_;
  domain::SubdomainRule rule_;
  cloud::CandidateSearch<2> search_;
  double alpha_;

  Point2 centre_{};
  double h_ = 0;
  /// Length that the test function's argument is measured in.
  double test_length_ = 0;
  domain::SubdomainQuadrature quadrature_;
  std::vector<cloud::Index> candidates_;
  basis::CandidateBatch<2> candidate_batch_;
  basis::PointBatch<2> batch_;
  basis::ShapeFunctionValues<2> values_;
  basis::ShapeFunctions<2>::Workspace workspace_;
  std::vector<double> test_;
  std::array<std::vector<double>, 2> test_gradient_;
  std::array<std::vector<double>, 2> weighted_;
  std::vector<Pack> sums_;
  /// K_11, K_12, K_21, K_22 of every candidate.
  std::array<std::vector<double>, 4> blocks_;
  std::array<double, 2> right_{};
  std::vector<Point2> points_;
  std::vector<Vector2> fields_;
  std::vector<Vector2> normals_;
  std::vector<std::int64_t> columns_;
  std::vector<double> entries_;
};

} // namespace

ParticleSolution solve(const PlaneProblem &problem, std::shared_ptr<const cloud::Particles<2>> particles,
                       std::shared_ptr<const basis::ShapeFunctions<2>> basis, const Parameters &parameters) {
  problem.check();
  problem.require_inside(particles->positions());
  Stopwatch watch;
  const std::size_t n = particles->size();
  Assembler assembler(problem, *particles, *basis, parameters);
  assembler.seconds.neighbours = watch.lap();

  // The basis must exist at the particles too, where quadrature points never fall: a support that
  // is too small shows there first.
  const cloud::CandidateSearch<2> search(*particles, basis->support());
  basis::GroupedEvaluation<2>(*basis, search)
      .visit(
          particles->positions(), {}, [](const auto &) {}, "particle");
  assembler.seconds.basis += watch.lap();

  linear_algebra::SparseRows matrix(2 * static_cast<std::int64_t>(n));
  std::vector<double> right_hand_side;
  right_hand_side.reserve(2 * n);
  for (std::size_t i = 0; i < n; ++i)
    assembler.assemble(i, matrix, right_hand_side);
  watch.lap();
  const auto divisors = matrix.equilibrate_rows();
  for (std::size_t row = 0; row < divisors.size(); ++row)
    right_hand_side[row] /= divisors[row];
  assembler.seconds.assembly += watch.lap();
  auto lu = linear_algebra::solve_lu(matrix, right_hand_side);
  assembler.seconds.solve = watch.lap();

  const double backward = linear_algebra::backward_error(matrix, lu.solution, right_hand_side);
  ParticleSolution solution(std::move(particles), std::move(basis), parameters.derivatives, problem.material,
                            std::move(lu.solution));
  solution.seconds = assembler.seconds;
  solution.nonzeros = matrix.nonzeros();
  solution.backward_error = backward;
  solution.reciprocal_condition = lu.reciprocal_condition;
  return solution;
}

} // namespace meshless::elasticity::weak_form
