#pragma once

#include "comparisons/methods/method_table.h"
#include "comparisons/methods/recoveries.h"
#include "comparisons/problems/plane_problem.h"
#include "comparisons/scene/scene.h"
#include "comparisons/study/transient.h"

#include <complex>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace comparisons::benchmarks::plate_vibration {

/// Squares of the natural frequencies, 1/s^2, and what they cost.
struct Spectrum {
  /// By real part.
  std::vector<std::complex<double>> squares;
  /// All there are, not only the lowest.
  bool whole = false;
  bool symmetric = false; ///< of symmetric matrices: real
  std::int64_t n_dofs = 0;
  std::int64_t nonzeros = 0;
  std::map<std::string, double> seconds;
  methods::Recoveries recoveries;
};

/// Largest growth rate of a motion exp(i omega t): the imaginary part of the roots, 1/s. Roots of squares smaller than
/// `rounding` are those of rigid motions and left out.
double growth_rate(const Spectrum &spectrum, double rounding);

/// The lowest `wanted`, or for particles all of them while there are at most 800 unknowns.
/// @param scale about the lowest elastic frequency, 1/s
Spectrum spectrum(const methods::SolveRequest &request, const std::string &method, unsigned wanted, double scale);

/// How a motion is watched.
struct Watch {
  problems::Point2 tip{};
  /// Energies of particle methods are measured by this quadrature.
  problems::Quadrature quadrature;
  std::vector<problems::Point2> force_points;
  std::vector<problems::Vector2> forces; ///< traction times weight, N/m
  /// Step unit of [time] cfl, s.
  double step_unit = 0;
  /// What energy errors are measured against until the work is larger, J/m.
  double least_work = 0;
  std::optional<double> damping = {}; ///< 1/s
  /// Kinetic + strain energy - work above this part of the work ends the cell.
  double largest_gain = 0.2;
};

/// A plate on its way through time.
class PlateEvolution : public study::Evolution {
public:
  explicit PlateEvolution(const Watch &watch) : watch_(watch) {}

  double step_unit() const override { return watch_.step_unit; }
  bool constant_step() const override { return true; }
  /// Guards energy every ten steps. With damping there is less than the work, and never more.
  void step(double time_step) final;
  /// (kinetic + strain - work) / largest work.
  double energy_error() const override;

  virtual double kinetic() const = 0; ///< J/m
  virtual double strain() const = 0;  ///< J/m
  virtual double work() const = 0;    ///< J/m
  virtual double tip() const = 0;     ///< second component of the displacement, m
  virtual std::int64_t n_dofs() const = 0;
  virtual std::int64_t nonzeros() const = 0;
  virtual std::map<std::string, double> seconds() const = 0;
  virtual methods::Recoveries recoveries() const { return {}; }

protected:
  virtual void advance(double time_step) = 0;
  const Watch &watch() const { return watch_; }

private:
  const Watch &watch_;
  mutable double largest_work_ = 0;
};

std::unique_ptr<PlateEvolution> evolution(const methods::SolveRequest &request, const std::string &method,
                                          const Watch &watch);

} // namespace comparisons::benchmarks::plate_vibration
