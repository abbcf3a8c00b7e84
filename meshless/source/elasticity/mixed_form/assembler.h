#pragma once

#include "../weak_form/consistent_subdomain.h"

#include "meshless/elasticity/mixed_form/displacement_pressure.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <array>
#include <span>
#include <vector>

namespace meshless::elasticity::mixed_form {

/// Assembles the three rows of one particle after the other: momentum 1 and 2, continuity. Unknowns of particle J:
/// u1, u2, p / mu. All scratch is reused.
class Assembler {
public:
  /// All are kept by reference.
  Assembler(const PlaneProblem &problem, const Surroundings &surroundings, const cloud::Particles<2> &particles,
            const basis::ShapeFunctions<2> &displacement_basis, const basis::ShapeFunctions<2> &pressure_basis,
            const Parameters &parameters);

  /// Appends rows 3 I, 3 I + 1 and 3 I + 2.
  void assemble(std::size_t particle, linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side);

  SolveSeconds seconds;

private:
  /// Coefficients of the three rows for u1, u2 and p / mu of one particle.
  using Coefficients = std::array<std::array<double, 3>, 3>;
  /// One of the two bases on the particles of one region.
  struct Field {
    std::vector<cloud::Index> candidates;
    basis::CandidateBatch<2> batch;
    basis::ShapeFunctionValues<2> values;
  };
  struct Fields {
    Field u, p;
    bool collected = false;
    std::vector<Coefficients> of_u, of_p;
  };
  struct RegionRule {
    weak_form::ConsistentSubdomain subdomain;
    RegionFilter filter;
  };
  using Part = domain::SubdomainQuadrature::Part;
  using Rows = std::array<bool, 2>;

  void place(std::size_t particle);
  void collect(std::size_t region, const Point2 &seen_from, Fields &fields);
  void evaluate(const basis::ShapeFunctions<2> &basis, std::span<const double> x, std::span<const double> y,
                basis::Wanted wanted, Field &field);

  void integrate_domain();
  Vector2 stabilising_gradient(std::size_t q) const;
  void add_momentum(std::size_t begin, std::size_t size);
  void add_continuity(std::size_t begin, std::size_t size);
  void integrate_body_force();
  void integrate_part(const Part &part);
  void integrate_traction(const Part &part, const BoundaryCondition &condition);
  void add_flux(const Part &part, std::size_t region, const Rows &rows, Fields &fields);
  std::span<const double> coordinates(const Part &part, int k) const;

  void collocate();
  void impose(const Rows &rows);
  void append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side);

  const PlaneProblem &problem_;
  const Surroundings &surroundings_;
  const cloud::Particles<2> &particles_;
  const basis::ShapeFunctions<2> &displacement_basis_;
  const basis::ShapeFunctions<2> &pressure_basis_;
  const Parameters &parameters_;
  Interfaces interfaces_;
  std::vector<RegionRule> regions_;
  cloud::CandidateSearch<2> displacement_search_;
  cloud::CandidateSearch<2> pressure_search_;

  std::size_t region_ = 0;
  Point2 centre_{};
  domain::Ellipse shape_{0}; ///< of the subdomain
  double tau_ = 0;           ///< of a disc
  std::vector<std::size_t> own_pieces_;
  weak_form::ConsistentPoints points_;
  Fields own_;
  std::vector<Fields> foreign_; ///< across an interface, by region
  basis::PointBatch<2> batch_;
  basis::ShapeFunctions<2>::Workspace workspace_;
  std::array<double, 3> right_{};
  std::vector<Point2> positions_;
  std::vector<Vector2> values_;
  std::vector<Vector2> normals_;
  std::vector<std::pair<cloud::Index, Coefficients>> row_;
  std::vector<linear_algebra::SparseRows::Column> columns_;
  std::vector<double> entries_;
};

} // namespace meshless::elasticity::mixed_form
