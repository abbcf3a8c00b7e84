#include "multigrid.h"

#include "../elasticity/boundary_conditions.h"
#include "../elasticity/stiffness.h"
#include "../linear_algebra/direct_solvers.h"
#include "../parallel/bands.h"
#include "fem_reference/errors.h"
#include "quadrilateral_coarsening.h"
#include "stiffness_operator.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include <fmt/format.h>

namespace fem_reference::multigrid {
namespace {
using elasticity::Discretisation;
using elasticity::Material;
using Vector = std::vector<float>;

constexpr int smoothing_degree = 4;
constexpr int max_iterations = 200;
/// A system that Cholesky solves in the time of one smoothing step of the next level.
constexpr std::size_t few_nodes = 300;

template <typename Number>
double dot(std::span<const Number> a, std::span<const Number> b) {
  // Four sums: one would wait for itself.
  std::array<double, 4> sums{};
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4)
    for (std::size_t k = 0; k < 4; ++k)
      sums[k] += static_cast<double>(a[i + k]) * static_cast<double>(b[i + k]);
  for (; i < a.size(); ++i)
    sums[0] += static_cast<double>(a[i]) * static_cast<double>(b[i]);
  return sums[0] + sums[1] + (sums[2] + sums[3]);
}

/// Calls function(i) for the unknowns i = 0 ... n - 1, several at once if they are many.
template <typename Function>
void for_each_unknown(std::size_t n, const Function &function) {
  parallel::for_each_band(n, parallel::n_short_bands(n / 2), [&](const parallel::Band &band, int) {
    for (std::size_t i = band.begin; i < band.end; ++i)
      function(i);
  });
}

/// One level above the coarsest.
class Level {
public:
  Level(const Discretisation &space, std::span<const Material> materials, std::span<const char> prescribed,
        double scale)
      : stiffness_(make_stiffness_operator<float>(space, materials, prescribed, scale)),
        inverse_diagonal_(stiffness_->diagonal()), step_(inverse_diagonal_.size()), image_(inverse_diagonal_.size()) {
    for (float &value : inverse_diagonal_)
      value = 1 / value;
    estimate_largest_eigenvalue(prescribed);
  }

  /// x = smoothed solution of K x = residual from zero; `residual` becomes that of x.
  void smooth_from_zero(std::span<float> x, std::span<float> residual) {
    std::fill(x.begin(), x.end(), 0.F);
    smooth(x, residual, true);
  }

  /// x += smoothed solution; what is left of the residual is not computed.
  void smooth_last(std::span<float> x, std::span<float> residual) { smooth(x, residual, false); }

  /// residual -= K correction
  void subtract_image(std::span<const float> correction, std::span<float> residual) {
    stiffness_->apply(correction, image_);
    for_each_unknown(residual.size(), [&](std::size_t i) { residual[i] -= image_[i]; });
  }

private:
  void smooth(std::span<float> x, std::span<float> residual, bool residual_wanted);
  void estimate_largest_eigenvalue(std::span<const char> prescribed);

  std::unique_ptr<StiffnessOperator<float>> stiffness_;
  Vector inverse_diagonal_;
  Vector step_;
  Vector image_;
  float largest_eigenvalue_ = 1; ///< of D^-1 K, an upper estimate
};

/// Chebyshev's iteration of the fourth kind, Lottes (2023), algorithm with beta = 1:
///   z_k = (2 k - 3) / (2 k + 1) z_(k-1) + (8 k - 4) / (2 k + 1) / lambda_max D^-1 r_(k-1),
///   x_k = x_(k-1) + z_k,  r_k = r_(k-1) - K z_k.
void Level::smooth(std::span<float> x, std::span<float> residual, bool residual_wanted) {
  const std::size_t n = x.size();
  for (int k = 1; k <= smoothing_degree; ++k) {
    const auto kept = static_cast<float>(k == 1 ? 0. : (2. * k - 3) / (2. * k + 1));
    const auto added = static_cast<float>((8. * k - 4) / (2. * k + 1)) / largest_eigenvalue_;
    if (k == 1)
      std::fill(step_.begin(), step_.end(), 0.F);
    for_each_unknown(n, [&](std::size_t i) {
      step_[i] = kept * step_[i] + added * inverse_diagonal_[i] * residual[i];
      x[i] += step_[i];
    });
    if (k < smoothing_degree || residual_wanted)
      subtract_image(step_, residual);
  }
}

/// Power iteration from a vector that alternates like the modes sought. Twelve steps end within a few per cent below;
/// the smoother diverges only beyond twice the estimate, and loses little by ten per cent more.
void Level::estimate_largest_eigenvalue(std::span<const char> prescribed) {
  std::span<float> v = step_;
  for (std::size_t i = 0; i < v.size(); ++i)
    v[i] = prescribed[i] != 0 ? 0.F : static_cast<float>((i * 2654435761U) % 1024) / 512.F - 1.F;
  double eigenvalue = 1;
  for (int k = 0; k < 12; ++k) {
    const double norm = std::sqrt(dot<float>(v, v));
    if (!(norm > 0))
      return; // everything is prescribed
    for (float &value : v)
      value = static_cast<float>(value / norm);
    stiffness_->apply(v, image_);
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = inverse_diagonal_[i] * image_[i];
    eigenvalue = std::sqrt(dot<float>(v, v));
  }
  largest_eigenvalue_ = static_cast<float>(1.1 * eigenvalue);
}

/// Whether all coarse functions that move no prescribed coarse unknown move no prescribed fine one; fills the coarse
/// marks.
bool inherit(const Transfer &transfer, std::span<const char> fine, std::vector<char> &coarse) {
  for (std::size_t i = 0; i < transfer.n_fine(); ++i)
    if (const auto nodes = transfer.nodes_of(i); nodes.size() == 1)
      for (std::size_t d = 0; d < 2; ++d)
        if (fine[2 * i + d] != 0)
          coarse[2 * std::size_t{nodes[0]} + d] = 1;
  for (std::size_t i = 0; i < transfer.n_fine(); ++i)
    for (const unsigned node : transfer.nodes_of(i))
      for (std::size_t d = 0; d < 2; ++d)
        if (fine[2 * i + d] != 0 && coarse[2 * std::size_t{node} + d] == 0)
          return false;
  return true;
}

/// The coarsest level, by Cholesky.
class CoarsestLevel {
public:
  CoarsestLevel(const Discretisation &space, std::span<const Material> materials, std::span<const char> prescribed,
                double scale)
      : scale_(scale), prescribed_(prescribed) {
    linear_algebra::BlockMatrix matrix(space.n_nodes(), space.cell_start, space.cell_nodes);
    assemble_stiffness(space, materials, matrix);
    elasticity::EssentialData essential;
    essential.prescribed.assign(prescribed.begin(), prescribed.end());
    essential.values.assign(prescribed.size(), 0.);
    std::vector<double> nothing(prescribed.size());
    eliminate(essential, matrix, nothing);
    try {
      solver_ = linear_algebra::factorise_cholesky(matrix);
    } catch (const linear_algebra::PivotFailure &failure) {
      throw SolveFailure(fmt::format("multigrid: the coarsest system of {} unknowns is not positive definite: {}",
                                     matrix.n_rows(), failure.reason));
    }
  }

  void solve(std::span<const float> right_hand_side, std::span<float> x) const {
    std::vector<double> b(right_hand_side.begin(), right_hand_side.end());
    for (std::size_t i = 0; i < b.size(); ++i)
      b[i] = prescribed_[i] != 0 ? 0. : scale_ * b[i];
    const auto solution = solver_->solve(b);
    for (std::size_t i = 0; i < b.size(); ++i)
      x[i] = static_cast<float>(solution[i]);
  }

private:
  double scale_;
  std::span<const char> prescribed_;
  std::unique_ptr<linear_algebra::DirectSolver> solver_;
};

double largest_modulus(std::span<const Material> materials) {
  double result = 0;
  for (const auto &material : materials)
    result = std::max({result, material.mu(), material.lambda()});
  return result;
}
} // namespace

class Multigrid::Implementation {
public:
  Implementation(const Discretisation &space, std::span<const Material> materials, std::span<const char> prescribed);

  Result solve(std::span<const double> right_hand_side, double tolerance, std::span<double> x);
  double largest_diagonal() const {
    const auto diagonal = stiffness_->diagonal();
    return scale_ * *std::max_element(diagonal.begin(), diagonal.end());
  }
  int n_levels() const { return static_cast<int>(spaces_.size()) + 1; }
  std::size_t n_coarsest_unknowns() const { return prescribed_of(spaces_.size()).size(); }

private:
  const Discretisation &space(std::size_t level) const { return level == 0 ? finest_ : spaces_[level - 1].space; }
  std::span<const char> prescribed_of(std::size_t level) const {
    return level == 0 ? prescribed_ : std::span<const char>(coarse_prescribed_[level - 1]);
  }
  bool add_coarser();
  /// x = V-cycle for the residual, from `level` down; the residual is used up.
  void cycle(std::size_t level, std::span<float> x, std::span<float> residual);
  void precondition(std::span<const double> residual, std::span<double> result);

  const Discretisation &finest_;
  std::span<const char> prescribed_;
  double scale_;
  std::unique_ptr<StiffnessOperator<double>> stiffness_;
  std::deque<Coarsening> spaces_; ///< of the levels after the finest; operators refer to them
  std::deque<std::vector<char>> coarse_prescribed_;
  std::deque<Level> levels_; ///< all but the coarsest
  std::unique_ptr<CoarsestLevel> coarsest_;
  std::vector<Vector> solutions_; ///< by level
  std::vector<Vector> residuals_;
  std::vector<Vector> corrections_;
};

Multigrid::Implementation::Implementation(const Discretisation &space, std::span<const Material> materials,
                                          std::span<const char> prescribed)
    : finest_(space), prescribed_(prescribed), scale_(largest_modulus(materials)) {
  if (std::any_of(space.n_vertices.begin(), space.n_vertices.end(), [](unsigned char n) { return n != 4; }))
    throw InvalidInput("multigrid needs a mesh of quadrilaterals, this one has triangles; use cholesky");
  stiffness_ = make_stiffness_operator<double>(space, materials, prescribed, scale_);
  while (add_coarser()) {
  }
  for (std::size_t l = 0; l < spaces_.size(); ++l)
    levels_.emplace_back(this->space(l), materials, prescribed_of(l), scale_);
  coarsest_ =
      std::make_unique<CoarsestLevel>(this->space(spaces_.size()), materials, prescribed_of(spaces_.size()), scale_);
  for (std::size_t l = 0; l <= spaces_.size(); ++l) {
    solutions_.emplace_back(2 * this->space(l).n_nodes());
    residuals_.emplace_back(2 * this->space(l).n_nodes());
    corrections_.emplace_back(2 * this->space(l).n_nodes());
  }
}

bool Multigrid::Implementation::add_coarser() {
  const auto &last = space(spaces_.size());
  if (last.n_nodes() <= few_nodes)
    return false;
  auto coarser = last.degree() > 1 ? std::optional(coarsen_degree(last)) : coarsen_mesh(last);
  if (!coarser)
    return false;
  std::vector<char> prescribed(2 * coarser->space.n_nodes(), 0);
  if (!inherit(coarser->transfer, prescribed_of(spaces_.size()), prescribed))
    return false;
  spaces_.push_back(std::move(*coarser));
  coarse_prescribed_.push_back(std::move(prescribed));
  return true;
}

void Multigrid::Implementation::cycle(std::size_t level, std::span<float> x, std::span<float> residual) {
  if (level == spaces_.size()) {
    coarsest_->solve(residual, x);
    return;
  }
  auto &smoother = levels_[level];
  const auto &transfer = spaces_[level].transfer;
  smoother.smooth_from_zero(x, residual);
  auto &coarse_residual = residuals_[level + 1];
  auto &coarse_x = solutions_[level + 1];
  transfer.restrict_to(residual, coarse_residual);
  const auto coarse_prescribed = prescribed_of(level + 1);
  for (std::size_t i = 0; i < coarse_residual.size(); ++i)
    if (coarse_prescribed[i] != 0)
      coarse_residual[i] = 0;
  cycle(level + 1, coarse_x, coarse_residual);
  auto &correction = corrections_[level];
  std::fill(correction.begin(), correction.end(), 0.F);
  transfer.prolongate(coarse_x, correction);
  for_each_unknown(x.size(), [&](std::size_t i) { x[i] += correction[i]; });
  smoother.subtract_image(correction, residual);
  smoother.smooth_last(x, residual);
}

/// The residual is brought to the size of one, where single precision has its range.
void Multigrid::Implementation::precondition(std::span<const double> residual, std::span<double> result) {
  double largest = 0;
  for (const double value : residual)
    largest = std::max(largest, std::abs(value));
  if (largest == 0) {
    std::fill(result.begin(), result.end(), 0.);
    return;
  }
  auto &single_residual = residuals_[0];
  auto &single_result = solutions_[0];
  for_each_unknown(residual.size(),
                   [&](std::size_t i) { single_residual[i] = static_cast<float>(residual[i] / largest); });
  cycle(0, single_result, single_residual);
  for_each_unknown(residual.size(),
                   [&](std::size_t i) { result[i] = static_cast<double>(single_result[i]) * largest; });
}

Multigrid::Result Multigrid::Implementation::solve(std::span<const double> right_hand_side, double tolerance,
                                                   std::span<double> x) {
  const std::size_t n = right_hand_side.size();
  std::vector<double> residual(n);
  for (std::size_t i = 0; i < n; ++i)
    residual[i] = prescribed_[i] != 0 ? 0. : right_hand_side[i] / scale_;
  std::fill(x.begin(), x.end(), 0.);
  const double first = std::sqrt(dot<double>(residual, residual));
  Result result;
  if (first == 0)
    return result;
  std::vector<double> preconditioned(n);
  std::vector<double> direction(n);
  std::vector<double> image(n);
  double product = 0;
  while (true) {
    precondition(residual, preconditioned);
    const double next_product = dot<double>(residual, preconditioned);
    const double kept = product == 0 ? 0. : next_product / product;
    product = next_product;
    for_each_unknown(n, [&](std::size_t i) { direction[i] = preconditioned[i] + kept * direction[i]; });
    stiffness_->apply(direction, image);
    const double curvature = dot<double>(direction, image);
    if (!(curvature > 0) || !(product > 0))
      throw SolveFailure(fmt::format("multigrid: the system of {} unknowns shows itself not positive definite in "
                                     "iteration {}; look for nu too close to 1/2, or use cholesky",
                                     n, result.iterations + 1));
    const double length = product / curvature;
    for_each_unknown(n, [&](std::size_t i) {
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    });
    ++result.iterations;
    result.relative_residual = std::sqrt(dot<double>(residual, residual)) / first;
    if (result.relative_residual <= tolerance)
      return result;
    if (result.iterations == max_iterations)
      throw SolveFailure(fmt::format("multigrid: after {} iterations the residual is still {:.1e} of the first; cells "
                                     "are much longer than wide, or nu is too close to 1/2: use cholesky",
                                     max_iterations, result.relative_residual));
  }
}

Multigrid::Multigrid(const Discretisation &space, std::span<const Material> materials, std::span<const char> prescribed)
    : implementation_(std::make_unique<Implementation>(space, materials, prescribed)) {}
Multigrid::~Multigrid() = default;
Multigrid::Result Multigrid::solve(std::span<const double> right_hand_side, double tolerance, std::span<double> x) {
  return implementation_->solve(right_hand_side, tolerance, x);
}
double Multigrid::largest_diagonal() const { return implementation_->largest_diagonal(); }
int Multigrid::n_levels() const { return implementation_->n_levels(); }
std::size_t Multigrid::n_coarsest_unknowns() const { return implementation_->n_coarsest_unknowns(); }
} // namespace fem_reference::multigrid
