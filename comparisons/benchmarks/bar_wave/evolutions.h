#pragma once

#include "comparisons/benchmarks/bar_wave/exact.h"
#include "comparisons/scene/scene.h"
#include "comparisons/study/transient.h"

#include "meshless/dynamics/elastic_bar.h"
#include "meshless/kernels/kernel_table.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace comparisons::benchmarks::bar_wave {

/// A bar on its way through time, with what is measured of it.
class BarEvolution : public study::Evolution {
public:
  bool constant_step() const override { return true; }
  /// Where stress is given, m.
  virtual std::vector<double> places() const = 0;
  virtual std::vector<double> stress() const = 0; ///< Pa
  virtual double energy() const = 0;              ///< J/m^2
  virtual double work() const = 0;                ///< J/m^2
  virtual std::int64_t n_dofs() const = 0;
  virtual std::int64_t nonzeros() const { return 0; }
  virtual std::size_t n_pivoted() const { return 0; } ///< PivotCount
};

/// The keys of the effects of a bar, absent if the scene does not call for them.
struct BarEffects {
  std::optional<double> viscosity;
  std::optional<double> damping; ///< 1/s

  explicit BarEffects(const scene::Scene &scene);
};

/// Uniform particles from end to end.
std::vector<double> bar_places(double length, int n);

/// Particles whose moment matrix was not positive definite and factorised with complete pivoting, the most at a time.
using PivotCount = std::shared_ptr<std::size_t>;

/// The derivative rows of SSPH as the method's keys say, h over `spacing`.
/// @throws methods::Refused if a moment matrix is singular
std::function<meshless::dynamics::LineOperators(std::span<const double>)> ssph_rows(const scene::Parameters &method,
                                                                                    double spacing,
                                                                                    const PivotCount &n_pivoted);
meshless::kernels::Kernel kernel_of(const scene::Parameters &method);

/// @throws meshless::dynamics::Violation if the operator has eigenvalues that grow
std::unique_ptr<BarEvolution> ssph_bar(const scene::Parameters &method, const PulseSolution &pulse, int n,
                                       const BarEffects &effects);
std::unique_ptr<BarEvolution> fem_bar(const PulseSolution &pulse, int n, const BarEffects &effects);

} // namespace comparisons::benchmarks::bar_wave
