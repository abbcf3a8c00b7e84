#pragma once

#include "consistent_subdomain.h"
#include "repeated_neighbourhoods.h"

#include "meshless/domain/local_subdomain.h"
#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"
#include "meshless/linear_algebra/pack.h"
#include "meshless/linear_algebra/sparse_rows.h"

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace meshless::elasticity::weak_form {

/// Assembles the two rows of one particle after the other; all scratch is reused.
class Assembler {
public:
  /// All are kept by reference.
  /// @param search over the particles with the support of the basis; shared by the assemblers of all threads
  Assembler(const PlaneProblem &problem, const Surroundings &surroundings, const cloud::CandidateSearch<2> &search,
            const basis::ShapeFunctions<2> &basis, const Parameters &parameters);

  /// Appends rows 2 I and 2 I + 1.
  void assemble(std::size_t particle, linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side);

  /// The neighbourhoods whose rows are copies; null unless they are wanted, likely, and all there is to a row: one
  /// convex region, round supports, and neither body force nor thermal strain.
  std::shared_ptr<const RepeatedNeighbourhoods> find_repeated();
  /// Copies rows from here on.
  /// @param repeated of this cloud, or null
  void copy_repeated(std::shared_ptr<const RepeatedNeighbourhoods> repeated) { repeated_ = std::move(repeated); }

  /// Calls for rows of the mass, by the densities of the regions, kg/m^3.
  void set_densities(std::vector<double> densities) { densities_ = std::move(densities); }
  /// Appends rows 2 I and 2 I + 1 of the mass for the particle assembled last.
  void append_mass_rows(linear_algebra::SparseRows &mass);

  SolveSeconds seconds;

private:
  /// K_11, K_12, K_21, K_22 of a row's particles.
  using Coefficients = std::array<std::vector<double>, 4>;
  /// Particles of one region that have a part in the rows, and their coefficients.
  struct Block {
    std::vector<cloud::Index> candidates;
    basis::CandidateBatch<2> batch;
    Coefficients k;
  };
  /// What one region keeps for all its particles.
  struct RegionRule {
    domain::SubdomainRule rule;
    UnitDiscTest whole_disc;                       ///< of that rule; empty with the Heaviside function
    std::optional<ConsistentSubdomain> consistent; ///< in place of both
    RegionFilter filter;
  };

  void place(std::size_t particle);
  void integrate();
  const Coefficients &coefficients_of_first(std::size_t particle);
  void build_subdomain(bool heaviside);
  void collect(std::size_t region, const Point2 &seen_from, Block &block);
  void evaluate_test_function(std::span<const double> x, std::span<const double> y, bool with_gradient);
  void evaluate_basis(std::span<const double> x, std::span<const double> y, const Block &block, basis::Wanted wanted);
  const double *derivative(int k, std::size_t j) const;
  basis::Wanted wanted_gradient(bool with_value) const;

  void collocate();
  void integrate_domain();
  void add_gradient_products(std::size_t n);
  void integrate_body_force();
  void integrate_mass();
  void evaluate_thermal_strain(std::span<const double> x, std::span<const double> y);
  void integrate_thermal_strain();

  using Part = domain::SubdomainQuadrature::Part;
  std::span<const double> coordinates(const Part &part, int k) const;
  void integrate_part(const Part &part);
  void integrate_boundary(const Part &part);
  void integrate_interface(const Part &part);
  void weigh_boundary(const Part &part);
  void weigh_with_penalty(const Part &part);
  void add_to_right_hand_side(const BoundaryCondition &condition, ConditionKind kind);
  void add_penalty(double sign, const std::array<bool, 2> &components, Block &block);
  void add_flux(const Part &part, const Material &material, const std::array<bool, 2> &components, Block &block);

  void add_thermal_flux(const Part &part, const Material &material, const std::array<bool, 2> &components);

  void append_rows(linear_algebra::SparseRows &matrix, std::vector<double> &right_hand_side);

  const PlaneProblem &problem_;
  const Surroundings &surroundings_;
  const cloud::CandidateSearch<2> &search_;
  const cloud::Particles<2> &particles_;
  const basis::ShapeFunctions<2> &basis_;
  const Parameters &parameters_;
  Interfaces interfaces_;
  std::vector<RegionRule> regions_;

  std::shared_ptr<const RepeatedNeighbourhoods> repeated_;
  /// Of particles that others are like.
  std::unordered_map<std::size_t, Coefficients> first_coefficients_;
  std::vector<double> densities_; ///< by region; empty: no mass is asked for

  std::size_t region_ = 0;
  Point2 centre_{};
  domain::Ellipse shape_{0}; ///< of the subdomain
  bool interior_ = true;
  domain::SubdomainQuadrature quadrature_;
  Block own_;
  /// Of regions across an interface, by region; used are those with candidates.
  std::vector<Block> foreign_;
  basis::PointBatch<2> batch_;
  basis::ShapeFunctionValues<2> values_;
  basis::ShapeFunctions<2>::Workspace workspace_;
  std::vector<double> test_;
  std::vector<double> edge_test_;
  std::array<std::vector<double>, 2> test_gradient_;
  std::array<std::vector<double>, 2> weighted_;
  std::vector<linear_algebra::Pack> sums_;
  std::array<double, 2> right_{};
  std::vector<Point2> points_;
  std::vector<Vector2> fields_;
  std::vector<Vector2> normals_;
  std::vector<double> boundary_weights_; ///< of a part's points
  std::vector<double> thermal_;
  std::vector<std::pair<cloud::Index, std::array<double, 4>>> row_;
  std::vector<linear_algebra::SparseRows::Column> columns_;
  std::vector<double> entries_;
  std::vector<double> mass_; ///< of candidates of the own region
};

} // namespace meshless::elasticity::weak_form
