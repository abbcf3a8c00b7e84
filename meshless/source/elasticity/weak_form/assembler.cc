#include "assembler.h"

#include "../equations.h"
#include "subdomain_radius.h"

#include "meshless/linear_algebra/floating_point_traps.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <algorithm>

namespace meshless::elasticity::weak_form {

namespace {

using linear_algebra::FloatingPointTraps;
using linear_algebra::load;
using linear_algebra::n_lanes;
using linear_algebra::Pack;
using linear_algebra::Stopwatch;
using PartKind = domain::SubdomainQuadrature::PartKind;

/// Points of one batch: enough to fill SIMD lanes, few enough that the shape functions of a batch
/// stay in the second-level cache.
constexpr std::size_t batch_size = 32;

constexpr std::array<bool, 2> both{true, true};

} // namespace

Assembler::Assembler(const PlaneProblem &problem, const Surroundings &surroundings,
                     const cloud::CandidateSearch<2> &search, const basis::ShapeFunctions<2> &basis,
                     const Parameters &parameters)
    : problem_(problem), surroundings_(surroundings), search_(search), particles_(search.particles()), basis_(basis),
      parameters_(parameters), interfaces_(problem.regions), foreign_(surroundings.n_regions()) {
  require_shrinkable(parameters.subdomains, particles_);
  const bool consistent = parameters.integration == IntegrationRule::consistent && parameters.test_function;
  for (std::size_t r = 0; r < surroundings.n_regions(); ++r) {
    regions_.push_back(
        {domain::SubdomainRule(surroundings.boundary(r), parameters.quadrature_points, &surroundings.visibility(r)),
         {},
         {},
         RegionFilter(surroundings, particles_, r)});
    auto &region = regions_.back();
    if (consistent)
      region.consistent.emplace(surroundings.boundary(r), surroundings.visibility(r), *parameters.test_function,
                                basis.order());
    else if (parameters.test_function) {
      const auto &disc = region.rule.unit_disc();
      weak_form::evaluate_test_function(*parameters.test_function, {0, 0}, 1, disc.point[0], disc.point[1],
                                        region.whole_disc.test, &region.whole_disc.gradient);
    }
  }
}

std::shared_ptr<const RepeatedNeighbourhoods> Assembler::find_repeated() {
  if (parameters_.repeated_rows == RepeatedRows::computed || !surroundings_.simple() || problem_.body_force ||
      problem_.thermal_strain || particles_.has_flattenings() || !RepeatedNeighbourhoods::likely(particles_))
    return {};
  Stopwatch watch;
  std::vector<double> radii(particles_.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    place(i);
    radii[i] = shape_.radius;
  }
  auto repeated = std::make_shared<const RepeatedNeighbourhoods>(surroundings_.boundary(0), search_, radii);
  seconds.neighbours += watch.lap();
  return repeated;
}

void Assembler::assemble(std::size_t particle, linear_algebra::SparseRows &matrix,
                         std::vector<double> &right_hand_side) {
  if (const std::size_t first = repeated_ ? repeated_->first_like(particle) : particle; first != particle) {
    const auto &coefficients = coefficients_of_first(first);
    Stopwatch watch;
    place(particle);
    repeated_->collect(centre_, shape_.radius, own_.candidates);
    seconds.neighbours += watch.lap();
    own_.k = coefficients;
    right_ = {0, 0}; // nothing acts inside, or rows are not copied
  } else {
    place(particle);
    integrate();
    if (repeated_ && repeated_->shared(particle))
      first_coefficients_.emplace(particle, own_.k);
  }
  Stopwatch watch;
  append_rows(matrix, right_hand_side);
  seconds.assembly += watch.lap();
}

/// Of another thread's particle too: rows then are the same for any number of threads.
const Assembler::Coefficients &Assembler::coefficients_of_first(std::size_t particle) {
  if (const auto found = first_coefficients_.find(particle); found != first_coefficients_.end())
    return found->second;
  place(particle);
  integrate();
  return first_coefficients_.emplace(particle, own_.k).first->second;
}

/// Fills own_, foreign_ and right_ for the particle that is placed.
void Assembler::integrate() {
  Stopwatch watch;
  const bool collocated = interior_ && parameters_.interior_rows == InteriorRows::collocated;
  const bool heaviside = !parameters_.test_function;
  if (!collocated)
    build_subdomain(heaviside);
  seconds.assembly += watch.lap();
  collect(region_, centre_, own_);
  for (auto &block : foreign_)
    block.candidates.clear();
  seconds.neighbours += watch.lap();
  right_ = {0, 0};
  if (collocated)
    collocate();
  else {
    if (heaviside) {
      if (problem_.body_force)
        integrate_body_force();
    } else
      integrate_domain();
    for (const auto &part : quadrature_.parts)
      integrate_part(part);
  }
}

void Assembler::build_subdomain(bool heaviside) {
  if (regions_[region_].consistent) {
    ConsistentPoints points{std::move(quadrature_), std::move(test_), std::move(edge_test_), std::move(test_gradient_)};
    regions_[region_].consistent->build(centre_, shape_, points);
    quadrature_ = std::move(points.quadrature);
    test_ = std::move(points.test);
    edge_test_ = std::move(points.edge_test);
    test_gradient_ = std::move(points.gradient);
  } else
    regions_[region_].rule.build(
        centre_, shape_, quadrature_,
        {.interior = !heaviside || problem_.body_force || !densities_.empty(), .circle = heaviside});
}

void Assembler::place(std::size_t particle) {
  region_ = static_cast<std::size_t>(particles_.region(particle));
  centre_ = particles_.position(particle);
  shape_ = {parameters_.test_radius * particles_.smoothing_length(particle), particles_.flattening(particle)};
  if (parameters_.subdomains == Subdomains::shrunk || parameters_.interior_rows == InteriorRows::collocated) {
    const auto own = surroundings_.boundary(region_).pieces_at(centre_);
    interior_ = own.empty();
    if (parameters_.subdomains == Subdomains::shrunk)
      shape_ = shrunk_radius(surroundings_.visibility(region_), centre_, shape_.radius, own);
  }
}

/// Particles of the region that reach into the subdomain and are visible from a point.
void Assembler::collect(std::size_t region, const Point2 &seen_from, Block &block) {
  if (repeated_)
    repeated_->collect(centre_, shape_.radius, block.candidates);
  else
    search_.collect(centre_, shape_.radius, block.candidates);
  if (!surroundings_.simple())
    regions_[region].filter.apply(seen_from, block.candidates);
  block.batch.assign(particles_, block.candidates, centre_);
  for (auto &component : block.k)
    component.assign(block.candidates.size(), 0.0);
}

/// W_I and grad W_I at points.
void Assembler::evaluate_test_function(std::span<const double> x, std::span<const double> y, bool with_gradient) {
  if (parameters_.test_function)
    weak_form::evaluate_test_function(*parameters_.test_function, centre_, shape_, x, y, test_,
                                      with_gradient ? &test_gradient_ : nullptr);
  else
    test_.assign(x.size(), 1.0);
}

const double *Assembler::derivative(int k, std::size_t j) const {
  return parameters_.derivatives == DerivativeRule::direct ? values_.gradient(k, j)
                                                           : values_.differentiated_gradient(k, j);
}

basis::Wanted Assembler::wanted_gradient(bool with_value) const {
  const bool direct = parameters_.derivatives == DerivativeRule::direct;
  return {.value = with_value, .gradient = direct, .hessian = false, .differentiated_gradient = !direct};
}

void Assembler::evaluate_basis(std::span<const double> x, std::span<const double> y, const Block &block,
                               basis::Wanted wanted) {
  Stopwatch watch;
  batch_.assign(std::array<std::span<const double>, 2>{x, y});
  const auto regularity = [&] { // judged outside: it is NaN where the moment matrix is singular
    const FloatingPointTraps traps;
    return basis_.evaluate(batch_, block.batch, wanted, values_, workspace_);
  }();
  basis::require_regular(regularity, batch_, basis_);
  seconds.basis += watch.lap();
}

/// Equilibrium at the particle: sigma_ij,j = -b_i.
void Assembler::collocate() {
  const bool thermal = static_cast<bool>(problem_.thermal_strain);
  evaluate_basis({&centre_[0], 1}, {&centre_[1], 1}, own_, {.gradient = thermal, .hessian = true});
  for (std::size_t j = 0; j < own_.candidates.size(); ++j)
    for (std::size_t i = 0; i < 2; ++i) {
      const auto row = equilibrium(surroundings_.material(region_), values_, j, 0, static_cast<int>(i));
      own_.k[2 * i][j] = row[0];
      own_.k[2 * i + 1][j] = row[1];
    }
  if (problem_.body_force) {
    Vector2 force{};
    problem_.body_force({&centre_, 1}, {&force, 1});
    right_ = {-force[0], -force[1]};
  }
  if (thermal) {
    points_.clear();
    for (const auto j : own_.candidates)
      points_.push_back(particles_.position(static_cast<std::size_t>(j)));
    thermal_.resize(points_.size());
    problem_.thermal_strain(points_, thermal_);
    for (std::size_t j = 0; j < thermal_.size(); ++j)
      for (int i = 0; i < 2; ++i)
        right_[i] += surroundings_.material(region_).thermal_modulus() * values_.gradient(i, j)[0] * thermal_[j];
  }
}

void Assembler::integrate_domain() {
  Stopwatch watch;
  const std::span<const double> x = quadrature_.point[0];
  const std::span<const double> y = quadrature_.point[1];
  if (!regions_[region_].consistent) { // else it has been
    if (quadrature_.whole)
      regions_[region_].whole_disc.stretch(shape_, test_, test_gradient_);
    else
      evaluate_test_function(x, y, true);
  }
  const std::size_t n = own_.candidates.size();
  sums_.assign(4 * n, Pack(0.0));
  for (std::size_t begin = 0; begin < x.size(); begin += batch_size) {
    const std::size_t size = std::min(batch_size, x.size() - begin);
    seconds.assembly += watch.lap();
    evaluate_basis(x.subspan(begin, size), y.subspan(begin, size), own_, wanted_gradient(false));
    watch.lap();
    const FloatingPointTraps traps;
    for (int a = 0; a < 2; ++a) {
      weighted_[a].assign(batch_.stride(), 0.0); // padding weighs nothing
      for (std::size_t q = 0; q < size; ++q)
        weighted_[a][q] = quadrature_.JxW[begin + q] * test_gradient_[a][begin + q];
    }
    add_gradient_products(n);
  }
  // sums_[4 j + 2 a + b] = int W,a phi_j,b; the material comes in once per candidate.
  const auto &d = surroundings_.material(region_);
  for (std::size_t j = 0; j < n; ++j) {
    const double s11 = reduce(sums_[4 * j]);
    const double s12 = reduce(sums_[4 * j + 1]);
    const double s21 = reduce(sums_[4 * j + 2]);
    const double s22 = reduce(sums_[4 * j + 3]);
    own_.k[0][j] += d.axial() * s11 + d.shear() * s22;
    own_.k[1][j] += d.coupling() * s12 + d.shear() * s21;
    own_.k[2][j] += d.shear() * s12 + d.coupling() * s21;
    own_.k[3][j] += d.shear() * s11 + d.axial() * s22;
  }
  if (problem_.body_force)
    integrate_body_force();
  if (problem_.thermal_strain)
    integrate_thermal_strain();
  seconds.assembly += watch.lap();
}

void Assembler::add_gradient_products(std::size_t n) {
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

/// With W of the points of the subdomain already there, or 1.
void Assembler::integrate_body_force() {
  const std::size_t n = quadrature_.JxW.size();
  if (!parameters_.test_function)
    test_.assign(n, 1.0);
  points_.resize(n);
  fields_.resize(n);
  for (std::size_t q = 0; q < n; ++q)
    points_[q] = {quadrature_.point[0][q], quadrature_.point[1][q]};
  problem_.body_force(points_, fields_);
  for (std::size_t q = 0; q < n; ++q)
    for (int k = 0; k < 2; ++k)
      right_[k] += quadrature_.JxW[q] * test_[q] * fields_[q][k];
}

void Assembler::evaluate_thermal_strain(std::span<const double> x, std::span<const double> y) {
  points_.resize(x.size());
  thermal_.resize(x.size());
  for (std::size_t q = 0; q < x.size(); ++q)
    points_[q] = {x[q], y[q]};
  problem_.thermal_strain(points_, thermal_);
}

/// int W,i times the thermal stress, with the gradient of W already there.
void Assembler::integrate_thermal_strain() {
  evaluate_thermal_strain(quadrature_.point[0], quadrature_.point[1]);
  const double modulus = surroundings_.material(region_).thermal_modulus();
  for (std::size_t q = 0; q < thermal_.size(); ++q)
    for (int i = 0; i < 2; ++i)
      right_[i] += quadrature_.JxW[q] * test_gradient_[i][q] * modulus * thermal_[q];
}

/// The thermal part of - int sigma_ij n_j W for the components i, on the right-hand side.
void Assembler::add_thermal_flux(const Part &part, const Material &material, const std::array<bool, 2> &components) {
  evaluate_thermal_strain(coordinates(part, 0), coordinates(part, 1));
  for (std::size_t q = 0; q < thermal_.size(); ++q)
    for (int i = 0; i < 2; ++i)
      if (components[i])
        right_[i] -= quadrature_.boundary_JxW[part.begin + q] * test_[q] *
                     quadrature_.boundary_normal[i][part.begin + q] * material.thermal_modulus() * thermal_[q];
}

std::span<const double> Assembler::coordinates(const Part &part, int k) const {
  return std::span<const double>(quadrature_.boundary_point[k]).subspan(part.begin, part.end - part.begin);
}

void Assembler::integrate_part(const Part &part) {
  Stopwatch watch;
  evaluate_test_function(coordinates(part, 0), coordinates(part, 1), false);
  if (part.kind == PartKind::boundary) {
    if (part.id == interface_id)
      integrate_interface(part);
    else
      integrate_boundary(part);
    return;
  }
  seconds.assembly += watch.lap();
  evaluate_basis(coordinates(part, 0), coordinates(part, 1), own_, wanted_gradient(false));
  watch.lap();
  add_flux(part, surroundings_.material(region_), both, own_);
  seconds.assembly += watch.lap();
}

void Assembler::integrate_boundary(const Part &part) {
  Stopwatch watch;
  const auto &condition = problem_.conditions.at(part.id);
  const std::size_t size = part.end - part.begin;
  points_.resize(size);
  for (std::size_t q = 0; q < size; ++q)
    points_[q] = {quadrature_.boundary_point[0][part.begin + q], quadrature_.boundary_point[1][part.begin + q]};
  std::array<bool, 2> displacement{};
  for (std::size_t k = 0; k < 2; ++k)
    displacement[k] = condition.kind[k] == ConditionKind::displacement;
  fields_.resize(size);
  if (displacement != both && condition.traction) {
    normals_.resize(size);
    for (std::size_t q = 0; q < size; ++q)
      normals_[q] = {quadrature_.boundary_normal[0][part.begin + q], quadrature_.boundary_normal[1][part.begin + q]};
    condition.traction(points_, normals_, fields_);
    weigh_boundary(part);
    add_to_right_hand_side(condition, ConditionKind::traction);
  }
  if (displacement[0] || displacement[1]) {
    condition.displacement(points_, fields_);
    weigh_with_penalty(part);
    add_to_right_hand_side(condition, ConditionKind::displacement);
    seconds.assembly += watch.lap();
    evaluate_basis(coordinates(part, 0), coordinates(part, 1), own_, wanted_gradient(true));
    watch.lap();
    add_penalty(1, displacement, own_);
    add_flux(part, surroundings_.material(region_), displacement, own_);
  }
  seconds.assembly += watch.lap();
}

void Assembler::integrate_interface(const Part &part) {
  Stopwatch watch;
  const auto &side = interfaces_.at(region_, part.piece);
  Block &foreign = foreign_[side.region];
  if (foreign.candidates.empty())
    collect(side.region, {coordinates(part, 0)[0], coordinates(part, 1)[0]}, foreign);
  seconds.neighbours += watch.lap();
  const auto evaluate = [&](const Block &block, basis::Wanted wanted) {
    evaluate_basis(coordinates(part, 0), coordinates(part, 1), block, wanted);
    watch.lap();
  };
  if (side.follows) {
    weigh_with_penalty(part);
    evaluate(foreign, {.value = true});
    add_penalty(-1, both, foreign);
    seconds.assembly += watch.lap();
    evaluate(own_, wanted_gradient(true));
    add_penalty(1, both, own_);
    add_flux(part, surroundings_.material(region_), both, own_);
  } else {
    evaluate(foreign, wanted_gradient(false));
    add_flux(part, surroundings_.material(side.region), both, foreign);
  }
  seconds.assembly += watch.lap();
}

/// W JxW of the part's points.
void Assembler::weigh_boundary(const Part &part) {
  boundary_weights_.resize(part.end - part.begin);
  for (std::size_t q = 0; q < boundary_weights_.size(); ++q)
    boundary_weights_[q] = quadrature_.boundary_JxW[part.begin + q] * test_[q];
}

/// alpha W JxW of the part's points.
void Assembler::weigh_with_penalty(const Part &part) {
  weigh_boundary(part);
  const auto &material = surroundings_.material(region_);
  const auto alpha = [&](std::size_t q) {
    const Point2 x{quadrature_.boundary_point[0][part.begin + q], quadrature_.boundary_point[1][part.begin + q]};
    return penalty_factor(parameters_, material, nearest_smoothing_length(particles_, own_.candidates, x));
  };
  const bool everywhere = parameters_.penalty_length == PenaltyLength::domain;
  const double first = alpha(0);
  for (std::size_t q = 0; q < boundary_weights_.size(); ++q)
    boundary_weights_[q] *= everywhere || q == 0 ? first : alpha(q);
}

/// int field_i W, with alpha or without it, for the components of this kind.
void Assembler::add_to_right_hand_side(const BoundaryCondition &condition, ConditionKind kind) {
  for (int k = 0; k < 2; ++k)
    if (condition.kind[k] == kind)
      for (std::size_t q = 0; q < boundary_weights_.size(); ++q)
        right_[k] += boundary_weights_[q] * fields_[q][k];
}

/// sign int alpha u_i W for the components i.
void Assembler::add_penalty(double sign, const std::array<bool, 2> &components, Block &block) {
  const FloatingPointTraps traps;
  for (std::size_t j = 0; j < block.candidates.size(); ++j) {
    double value = 0;
    for (std::size_t q = 0; q < boundary_weights_.size(); ++q)
      value += boundary_weights_[q] * values_.value(j)[q];
    if (components[0])
      block.k[0][j] += sign * value;
    if (components[1])
      block.k[3][j] += sign * value;
  }
}

/// - int sigma_ij n_j W for the components i. What callers of the library give (the thermal strain) may be infinite and
/// stays outside of the traps.
void Assembler::add_flux(const Part &part, const Material &d, const std::array<bool, 2> &components, Block &block) {
  const std::size_t size = part.end - part.begin;
  if (problem_.thermal_strain)
    add_thermal_flux(part, d, components);
  const FloatingPointTraps traps;
  for (std::size_t j = 0; j < block.candidates.size(); ++j) {
    // s_kl = int W phi_j,k n_l
    double s11 = 0, s12 = 0, s21 = 0, s22 = 0;
    for (std::size_t q = 0; q < size; ++q) {
      const double weight = quadrature_.boundary_JxW[part.begin + q] * test_[q];
      const double n1 = quadrature_.boundary_normal[0][part.begin + q];
      const double n2 = quadrature_.boundary_normal[1][part.begin + q];
      const double phi1 = weight * derivative(0, j)[q];
      const double phi2 = weight * derivative(1, j)[q];
      s11 += phi1 * n1;
      s12 += phi1 * n2;
      s21 += phi2 * n1;
      s22 += phi2 * n2;
    }
    if (components[0]) {
      block.k[0][j] -= d.axial() * s11 + d.shear() * s22;
      block.k[1][j] -= d.coupling() * s21 + d.shear() * s12;
    }
    if (components[1]) {
      block.k[2][j] -= d.shear() * s21 + d.coupling() * s12;
      block.k[3][j] -= d.shear() * s11 + d.axial() * s22;
    }
  }
}

void Assembler::append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
  row_.clear();
  const auto append = [&](const Block &block) {
    for (std::size_t j = 0; j < block.candidates.size(); ++j)
      row_.push_back({block.candidates[j], {block.k[0][j], block.k[1][j], block.k[2][j], block.k[3][j]}});
  };
  append(own_);
  bool sorted = true;
  for (const auto &block : foreign_)
    if (!block.candidates.empty()) {
      append(block);
      sorted = false;
    }
  if (!sorted)
    std::sort(row_.begin(), row_.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  const std::size_t n = row_.size();
  columns_.resize(2 * n);
  entries_.resize(2 * n);
  for (std::size_t j = 0; j < n; ++j) {
    columns_[2 * j] = 2 * row_[j].first;
    columns_[2 * j + 1] = columns_[2 * j] + 1;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      entries_[2 * j] = row_[j].second[2 * i];
      entries_[2 * j + 1] = row_[j].second[2 * i + 1];
    }
    matrix.append_row(columns_, entries_);
    right_hand_side.push_back(right_[i]);
  }
}

/// rho int W phi_j over the subdomain; of a collocated row -rho phi_j at the particle, for its other side is
/// sigma_ij,j = rho a_i - b_i.
void Assembler::integrate_mass() {
  mass_.assign(own_.candidates.size(), 0.0);
  const double density = densities_[region_];
  if (interior_ && parameters_.interior_rows == InteriorRows::collocated) {
    evaluate_basis({&centre_[0], 1}, {&centre_[1], 1}, own_, {.value = true});
    for (std::size_t j = 0; j < mass_.size(); ++j)
      mass_[j] = -density * values_.value(j)[0];
    return;
  }
  const std::span<const double> x = quadrature_.point[0];
  const std::span<const double> y = quadrature_.point[1];
  for (std::size_t begin = 0; begin < x.size(); begin += batch_size) {
    const std::size_t size = std::min(batch_size, x.size() - begin);
    evaluate_test_function(x.subspan(begin, size), y.subspan(begin, size), false);
    evaluate_basis(x.subspan(begin, size), y.subspan(begin, size), own_, {.value = true});
    const FloatingPointTraps traps;
    for (std::size_t j = 0; j < mass_.size(); ++j)
      for (std::size_t q = 0; q < size; ++q)
        mass_[j] += density * quadrature_.JxW[begin + q] * test_[q] * values_.value(j)[q];
  }
}

void Assembler::append_mass_rows(linear_algebra::SparseRows &mass) {
  Stopwatch watch;
  integrate_mass();
  columns_.resize(mass_.size());
  for (linear_algebra::SparseRows::Column i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < mass_.size(); ++j)
      columns_[j] = 2 * own_.candidates[j] + i;
    mass.append_row(columns_, mass_);
  }
  seconds.assembly += watch.lap();
}

} // namespace meshless::elasticity::weak_form
