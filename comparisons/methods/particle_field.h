#pragma once

#include "comparisons/methods/particle_points.h"
#include "comparisons/methods/solution.h"

#include "meshless/elasticity/particle_solution.h"

namespace comparisons::methods {

/// How well the particles suit the basis of their method.
CloudReport cloud_report(const Prepared &prepared);

/// The solution of a particle method.
class ParticleField final : public Solution {
public:
  /// @param warnings what was known before it was solved
  ParticleField(meshless::elasticity::ParticleSolution solution, Prepared prepared, std::vector<std::string> warnings);

  std::vector<std::string> fields() const override;
  std::size_t n_components(std::string_view field) const override;
  void evaluate(std::string_view field, std::span<const std::array<double, 2>> points,
                std::span<double> values) const override;
  std::vector<std::array<double, 2>> own_points() const override;
  /// Smoothing length, and neighbours and regularity of the moment matrix (smallest pivot over its diagonal entry, 1
  /// at best) at every particle.
  std::map<std::string, std::vector<double>> own_figures() const override;
  std::vector<double> penalty(std::span<const std::array<double, 2>> points) const override;
  std::optional<CloudReport> cloud() const override { return cloud_report(prepared_); }

private:
  void add_recoveries();

  meshless::elasticity::ParticleSolution solution_;
  Prepared prepared_;
};

} // namespace comparisons::methods
