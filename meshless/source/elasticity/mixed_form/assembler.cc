#include "assembler.h"

#include "../weak_form/subdomain_radius.h"

#include "meshless/linear_algebra/floating_point_traps.h"
#include "meshless/linear_algebra/stopwatch.h"

#include <algorithm>

namespace meshless::elasticity::mixed_form {

namespace {

using linear_algebra::FloatingPointTraps;
using linear_algebra::Stopwatch;
using PartKind = domain::SubdomainQuadrature::PartKind;

constexpr std::size_t batch_size = 64;

} // namespace

Assembler::Assembler(const PlaneProblem &problem, const Surroundings &surroundings,
                     const cloud::Particles<2> &particles, const basis::ShapeFunctions<2> &displacement_basis,
                     const basis::ShapeFunctions<2> &pressure_basis, const Parameters &parameters)
    : problem_(problem), surroundings_(surroundings), particles_(particles), displacement_basis_(displacement_basis),
      pressure_basis_(pressure_basis), parameters_(parameters), interfaces_(problem.regions),
      displacement_search_(particles, displacement_basis.support()),
      pressure_search_(particles, pressure_basis.support()), foreign_(surroundings.n_regions()) {
  weak_form::require_shrinkable(parameters.subdomains, particles);
  for (std::size_t r = 0; r < surroundings.n_regions(); ++r)
    regions_.push_back({weak_form::ConsistentSubdomain(surroundings.boundary(r), surroundings.visibility(r),
                                                       parameters.test_function, displacement_basis.order()),
                        RegionFilter(surroundings, particles, r)});
}

void Assembler::assemble(std::size_t particle, linear_algebra::SparseRows &matrix,
                         std::vector<double> &right_hand_side) {
  Stopwatch watch;
  place(particle);
  regions_[region_].subdomain.build(centre_, shape_, points_);
  seconds.assembly += watch.lap();
  for (auto &fields : foreign_)
    fields.collected = false;
  collect(region_, centre_, own_);
  watch.lap();
  right_ = {0, 0, 0};
  integrate_domain();
  if (problem_.body_force)
    integrate_body_force();
  for (const auto &part : points_.quadrature.parts)
    integrate_part(part);
  collocate();
  append_rows(matrix, right_hand_side);
}

void Assembler::place(std::size_t particle) {
  region_ = static_cast<std::size_t>(particles_.region(particle));
  centre_ = particles_.position(particle);
  const double h = particles_.smoothing_length(particle);
  shape_ = {parameters_.test_radius * h, particles_.flattening(particle)};
  tau_ = parameters_.stabilisation * h * h / (2 * surroundings_.material(region_).shear());
  own_pieces_ = surroundings_.boundary(region_).pieces_at(centre_);
  if (parameters_.subdomains == weak_form::Subdomains::shrunk)
    shape_ = weak_form::shrunk_radius(surroundings_.visibility(region_), centre_, shape_.radius, own_pieces_);
}

/// Particles of the region that reach into the subdomain and are visible from a point.
void Assembler::collect(std::size_t region, const Point2 &seen_from, Fields &fields) {
  Stopwatch watch;
  const auto fill = [&](const cloud::CandidateSearch<2> &search, Field &field, std::vector<Coefficients> &rows) {
    search.collect(centre_, shape_.radius, field.candidates);
    if (!surroundings_.simple())
      regions_[region].filter.apply(seen_from, field.candidates);
    field.batch.assign(particles_, field.candidates, centre_);
    rows.assign(field.candidates.size(), Coefficients{});
  };
  fill(displacement_search_, fields.u, fields.of_u);
  fill(pressure_search_, fields.p, fields.of_p);
  fields.collected = true;
  seconds.neighbours += watch.lap();
}

void Assembler::evaluate(const basis::ShapeFunctions<2> &basis, std::span<const double> x, std::span<const double> y,
                         basis::Wanted wanted, Field &field) {
  Stopwatch watch;
  batch_.assign(std::array<std::span<const double>, 2>{x, y});
  const auto regularity = [&] { // judged outside: it is NaN where the moment matrix is singular
    const FloatingPointTraps traps;
    return basis.evaluate(batch_, field.batch, wanted, field.values, workspace_);
  }();
  basis::require_regular(regularity, batch_, basis);
  seconds.basis += watch.lap();
}

void Assembler::integrate_domain() {
  const std::span<const double> x = points_.quadrature.point[0];
  const std::span<const double> y = points_.quadrature.point[1];
  for (std::size_t begin = 0; begin < x.size(); begin += batch_size) {
    const std::size_t size = std::min(batch_size, x.size() - begin);
    evaluate(displacement_basis_, x.subspan(begin, size), y.subspan(begin, size), {.gradient = true, .hessian = true},
             own_.u);
    evaluate(pressure_basis_, x.subspan(begin, size), y.subspan(begin, size), {.value = true, .gradient = true},
             own_.p);
    Stopwatch watch;
    const FloatingPointTraps traps;
    add_momentum(begin, size);
    add_continuity(begin, size);
    seconds.assembly += watch.lap();
  }
}

/// int w,j (2 mu eps_ij + p delta_ij)
void Assembler::add_momentum(std::size_t begin, std::size_t size) {
  const double mu = surroundings_.material(region_).shear();
  const double *weight = &points_.quadrature.JxW[begin];
  const double *w1 = &points_.gradient[0][begin];
  const double *w2 = &points_.gradient[1][begin];
  for (std::size_t j = 0; j < own_.u.candidates.size(); ++j) {
    const double *phi1 = own_.u.values.gradient(0, j);
    const double *phi2 = own_.u.values.gradient(1, j);
    double s11 = 0, s12 = 0, s21 = 0, s22 = 0; // s_kl = int w,k phi_j,l
    for (std::size_t q = 0; q < size; ++q) {
      s11 += weight[q] * w1[q] * phi1[q];
      s12 += weight[q] * w1[q] * phi2[q];
      s21 += weight[q] * w2[q] * phi1[q];
      s22 += weight[q] * w2[q] * phi2[q];
    }
    auto &k = own_.of_u[j];
    k[0][0] += mu * (2 * s11 + s22);
    k[0][1] += mu * s21;
    k[1][0] += mu * s12;
    k[1][1] += mu * (s11 + 2 * s22);
  }
  for (std::size_t j = 0; j < own_.p.candidates.size(); ++j) {
    const double *psi = own_.p.values.value(j);
    for (std::size_t q = 0; q < size; ++q) {
      own_.of_p[j][0][2] += mu * weight[q] * w1[q] * psi[q];
      own_.of_p[j][1][2] += mu * weight[q] * w2[q] * psi[q];
    }
  }
}

/// tau grad w at a point of the subdomain. In an ellipse tau is a tensor: alpha times the squares of h along it and
/// across it, so that the scheme is that of a disc in the frame that stretches the ellipse to one.
Vector2 Assembler::stabilising_gradient(std::size_t q) const {
  const Point2 g = shape_.compressed(shape_.compressed({points_.gradient[0][q], points_.gradient[1][q]}));
  return {tau_ * g[0], tau_ * g[1]};
}

/// int w (c1 div u - c2 p) - tau int w,i (p,i + mu u_i,jj + mu u_j,ji), all times mu: rows and columns then have the
/// size of the others.
void Assembler::add_continuity(std::size_t begin, std::size_t size) {
  const auto &d = surroundings_.material(region_);
  const double mu = d.shear();
  const double c1 = d.coupling() / d.axial();
  const double c2 = 1 / d.axial();
  const double *weight = &points_.quadrature.JxW[begin];
  const double *w = &points_.test[begin];
  std::array<double, batch_size> tau1, tau2;
  for (std::size_t q = 0; q < size; ++q) {
    const auto tau = stabilising_gradient(begin + q);
    tau1[q] = tau[0];
    tau2[q] = tau[1];
  }
  for (std::size_t j = 0; j < own_.u.candidates.size(); ++j) {
    const auto &values = own_.u.values;
    const double *phi1 = values.gradient(0, j);
    const double *phi2 = values.gradient(1, j);
    const double *xx = values.hessian(0, j);
    const double *xy = values.hessian(1, j);
    const double *yy = values.hessian(2, j);
    double k1 = 0, k2 = 0;
    for (std::size_t q = 0; q < size; ++q) {
      const double a1 = weight[q] * tau1[q] * mu;
      const double a2 = weight[q] * tau2[q] * mu;
      k1 += c1 * weight[q] * w[q] * phi1[q] - a1 * (2 * xx[q] + yy[q]) - a2 * xy[q];
      k2 += c1 * weight[q] * w[q] * phi2[q] - a1 * xy[q] - a2 * (xx[q] + 2 * yy[q]);
    }
    own_.of_u[j][2][0] += mu * k1;
    own_.of_u[j][2][1] += mu * k2;
  }
  for (std::size_t j = 0; j < own_.p.candidates.size(); ++j) {
    const double *psi = own_.p.values.value(j);
    const double *psi1 = own_.p.values.gradient(0, j);
    const double *psi2 = own_.p.values.gradient(1, j);
    double k = 0;
    for (std::size_t q = 0; q < size; ++q)
      k -= weight[q] * (c2 * w[q] * psi[q] + tau1[q] * psi1[q] + tau2[q] * psi2[q]);
    own_.of_p[j][2][2] += mu * mu * k;
  }
}

void Assembler::integrate_body_force() {
  const auto &quadrature = points_.quadrature;
  const double mu = surroundings_.material(region_).shear();
  const std::size_t n = quadrature.JxW.size();
  positions_.resize(n);
  values_.resize(n);
  for (std::size_t q = 0; q < n; ++q)
    positions_[q] = {quadrature.point[0][q], quadrature.point[1][q]};
  problem_.body_force(positions_, values_);
  for (std::size_t q = 0; q < n; ++q) {
    const auto tau = stabilising_gradient(q);
    for (std::size_t k = 0; k < 2; ++k) {
      right_[k] += quadrature.JxW[q] * points_.test[q] * values_[q][k];
      right_[2] += mu * quadrature.JxW[q] * tau[k] * values_[q][k];
    }
  }
}

std::span<const double> Assembler::coordinates(const Part &part, int k) const {
  return std::span<const double>(points_.quadrature.boundary_point[k]).subspan(part.begin, part.end - part.begin);
}

void Assembler::integrate_part(const Part &part) {
  if (part.kind != PartKind::boundary) {
    add_flux(part, region_, {true, true}, own_);
    return;
  }
  if (part.id == interface_id) { // the traction is that of the softer side
    const auto &side = interfaces_.at(region_, part.piece);
    if (side.follows) {
      add_flux(part, region_, {true, true}, own_);
      return;
    }
    auto &foreign = foreign_[side.region];
    if (!foreign.collected)
      collect(side.region, {coordinates(part, 0)[0], coordinates(part, 1)[0]}, foreign);
    add_flux(part, side.region, {true, true}, foreign);
    return;
  }
  const auto &condition = problem_.conditions.at(part.id);
  Rows displacement{};
  for (std::size_t k = 0; k < 2; ++k)
    displacement[k] = condition.kind[k] == ConditionKind::displacement;
  if (displacement != Rows{true, true} && condition.traction)
    integrate_traction(part, condition);
  if (displacement[0] || displacement[1])
    add_flux(part, region_, displacement, own_);
}

void Assembler::integrate_traction(const Part &part, const BoundaryCondition &condition) {
  const auto &quadrature = points_.quadrature;
  const std::size_t size = part.end - part.begin;
  positions_.resize(size);
  normals_.resize(size);
  values_.resize(size);
  for (std::size_t q = 0; q < size; ++q) {
    positions_[q] = {quadrature.boundary_point[0][part.begin + q], quadrature.boundary_point[1][part.begin + q]};
    normals_[q] = {quadrature.boundary_normal[0][part.begin + q], quadrature.boundary_normal[1][part.begin + q]};
  }
  condition.traction(positions_, normals_, values_);
  for (std::size_t k = 0; k < 2; ++k)
    if (condition.kind[k] == ConditionKind::traction)
      for (std::size_t q = 0; q < size; ++q)
        right_[k] += quadrature.boundary_JxW[part.begin + q] * points_.edge_test[part.begin + q] * values_[q][k];
}

/// - int w (2 mu eps_ij + p delta_ij) n_j in the momentum rows i.
void Assembler::add_flux(const Part &part, std::size_t region, const Rows &rows, Fields &fields) {
  evaluate(displacement_basis_, coordinates(part, 0), coordinates(part, 1), {.gradient = true}, fields.u);
  evaluate(pressure_basis_, coordinates(part, 0), coordinates(part, 1), {.value = true}, fields.p);
  Stopwatch watch;
  const FloatingPointTraps traps;
  const auto &quadrature = points_.quadrature;
  const double mu = surroundings_.material(region).shear();
  for (std::size_t q = 0; q < part.end - part.begin; ++q) {
    const double weight =
        mu * quadrature.boundary_JxW[part.begin + q] * points_.edge_test[part.begin + q]; // p's unit is mu
    const double n1 = weight * quadrature.boundary_normal[0][part.begin + q];
    const double n2 = weight * quadrature.boundary_normal[1][part.begin + q];
    for (std::size_t j = 0; j < fields.u.candidates.size(); ++j) {
      const double phi1 = fields.u.values.gradient(0, j)[q];
      const double phi2 = fields.u.values.gradient(1, j)[q];
      auto &k = fields.of_u[j];
      if (rows[0]) {
        k[0][0] -= 2 * phi1 * n1 + phi2 * n2;
        k[0][1] -= phi1 * n2;
      }
      if (rows[1]) {
        k[1][0] -= phi2 * n1;
        k[1][1] -= phi1 * n1 + 2 * phi2 * n2;
      }
    }
    for (std::size_t j = 0; j < fields.p.candidates.size(); ++j) {
      const double psi = fields.p.values.value(j)[q];
      if (rows[0])
        fields.of_p[j][0][2] -= psi * n1;
      if (rows[1])
        fields.of_p[j][1][2] -= psi * n2;
    }
  }
  seconds.assembly += watch.lap();
}

/// Momentum rows of components that the particle's place on the boundary prescribes.
void Assembler::collocate() {
  Rows prescribed{};
  for (const std::size_t piece : own_pieces_) {
    const int id = surroundings_.boundary(region_).pieces()[piece].id;
    if (id == interface_id)
      continue;
    const auto &condition = problem_.conditions.at(id);
    Rows rows{};
    for (std::size_t k = 0; k < 2; ++k)
      rows[k] = condition.kind[k] == ConditionKind::displacement && !prescribed[k];
    if (!rows[0] && !rows[1])
      continue;
    Vector2 value{};
    condition.displacement({&centre_, 1}, {&value, 1});
    impose(rows);
    for (std::size_t k = 0; k < 2; ++k)
      if (rows[k]) {
        right_[k] = value[k];
        prescribed[k] = true;
      }
  }
  for (const std::size_t piece : own_pieces_) {
    if (surroundings_.boundary(region_).pieces()[piece].id != interface_id)
      continue;
    const auto &side = interfaces_.at(region_, piece);
    const Rows rows{!prescribed[0], !prescribed[1]};
    if (!side.follows || (!rows[0] && !rows[1]))
      continue;
    impose(rows);
    auto &foreign = foreign_[side.region];
    if (!foreign.collected)
      collect(side.region, centre_, foreign);
    evaluate(displacement_basis_, {&centre_[0], 1}, {&centre_[1], 1}, {.value = true}, foreign.u);
    for (std::size_t k = 0; k < 2; ++k)
      if (rows[k]) {
        for (std::size_t j = 0; j < foreign.u.candidates.size(); ++j)
          foreign.of_u[j][k][k] -= foreign.u.values.value(j)[0];
        right_[k] = 0;
        prescribed[k] = true;
      }
  }
}

/// Replaces momentum rows by sum phi_J u_J at the particle.
void Assembler::impose(const Rows &rows) {
  const auto clear = [&](std::vector<Coefficients> &coefficients) {
    for (auto &k : coefficients)
      for (std::size_t i = 0; i < 2; ++i)
        if (rows[i])
          k[i] = {};
  };
  clear(own_.of_u);
  clear(own_.of_p);
  for (auto &foreign : foreign_)
    if (foreign.collected) {
      clear(foreign.of_u);
      clear(foreign.of_p);
    }
  evaluate(displacement_basis_, {&centre_[0], 1}, {&centre_[1], 1}, {.value = true}, own_.u);
  for (std::size_t j = 0; j < own_.u.candidates.size(); ++j)
    for (std::size_t i = 0; i < 2; ++i)
      if (rows[i])
        own_.of_u[j][i][i] = own_.u.values.value(j)[0];
}

void Assembler::append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side) {
  Stopwatch watch;
  row_.clear();
  const auto append = [&](const std::vector<cloud::Index> &candidates, const std::vector<Coefficients> &coefficients) {
    for (std::size_t j = 0; j < candidates.size(); ++j)
      row_.push_back({candidates[j], coefficients[j]});
  };
  append(own_.u.candidates, own_.of_u);
  append(own_.p.candidates, own_.of_p);
  for (const auto &foreign : foreign_)
    if (foreign.collected) {
      append(foreign.u.candidates, foreign.of_u);
      append(foreign.p.candidates, foreign.of_p);
    }
  std::sort(row_.begin(), row_.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
  for (std::size_t i = 0; i < 3; ++i) {
    columns_.clear();
    entries_.clear();
    for (const auto &[particle, coefficients] : row_) {
      const auto first = 3 * static_cast<linear_algebra::SparseRows::Column>(particle);
      if (columns_.empty() || columns_.back() != first + 2) {
        columns_.insert(columns_.end(), {first, first + 1, first + 2});
        entries_.insert(entries_.end(), 3, 0.0);
      }
      for (std::size_t k = 0; k < 3; ++k)
        entries_[entries_.size() - 3 + k] += coefficients[i][k];
    }
    matrix.append_row(columns_, entries_);
    right_hand_side.push_back(right_[i]);
  }
  seconds.assembly += watch.lap();
}

} // namespace meshless::elasticity::mixed_form
