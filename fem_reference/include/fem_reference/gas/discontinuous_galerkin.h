#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Mesh-based reference for gases on a line.
namespace fem_reference::gas {

/// Density (kg/m^3), momentum (kg/(m^2 s)) and total energy (J/m^3) per volume.
using Conserved = std::array<double, 3>;

/// Density (kg/m^3), velocity (m/s), pressure (Pa).
struct Primitive {
  double density = 0;
  double velocity = 0;
  double pressure = 0;
};

enum class Boundary {
  outflow, ///< the state outside is the one inside
  wall     ///< reflects
};

struct Tube {
  double left = 0;  ///< m
  double right = 1; ///< m
  std::size_t n_cells = 100;
  double gamma = 1.4;
  std::array<Boundary, 2> boundaries{Boundary::outflow, Boundary::outflow};
  /// States at t = 0: from a span of x to a span of states. For degree 0 the cells' centres are asked for, for degree 1
  /// two Gauss points a cell.
  std::function<void(std::span<const double>, std::span<Primitive>)> initial;
};

/// Discontinuous Galerkin for the Euler equations of an ideal gas: polynomials of degree 0 or 1 in each cell, the
/// numerical flux HLLC (Toro, Spruce & Speares 1994), for degree 1 Heun's method in time and slopes limited by minmod
/// (Cockburn & Shu 1989), for degree 0 Euler's.
///
/// Mesh, numbering, mass matrix and the integrals over cells are deal.II's (FE_DGP, FEValues), taken once into arrays
/// by cells, on which the steps work.
class DiscontinuousGalerkin {
public:
  /// @param degree 0 or 1
  /// @throws std::invalid_argument for another degree, no cell, or a state that is no gas
  DiscontinuousGalerkin(const Tube &tube, int degree);

  /// The largest stable step: width / (largest |v| + c) / (2 degree + 1), s.
  double stable_step() const;

  /// @throws std::runtime_error if a density or pressure is not positive or finite afterwards
  void step(double time_step);

  double time() const { return time_; }
  /// How often the slopes of a cell were shrunk beyond what minmod asks, since the state at an end was no gas.
  std::int64_t n_shrunk_slopes() const { return n_shrunk_slopes_; }
  std::size_t n_unknowns() const { return 3 * mean_.size() * static_cast<std::size_t>(degree_ + 1); }
  const std::vector<double> &centres() const { return centres_; }
  double cell_width() const { return width_; }

  /// The state at the places (m), which must lie in the tube.
  void evaluate(std::span<const double> places, std::span<Primitive> states) const;

  /// Integrals of the conserved quantities over the tube.
  Conserved totals() const;

  /// Everything that a step reads, by name; who writes into it calls `adopt_state`.
  std::vector<std::pair<std::string, std::span<double>>> state();
  void adopt_state() {
    time_ = counters_[0];
    n_shrunk_slopes_ = static_cast<std::int64_t>(counters_[1]);
  }

private:
  using Cells = std::vector<Conserved>;

  Primitive primitive(const Conserved &u) const;
  Conserved flux(const Conserved &u) const;
  Conserved hllc(const Conserved &left, const Conserved &right) const;
  bool is_gas(const Conserved &u) const;
  void rates(const Cells &mean, const Cells &slope);
  void limit(const Cells &mean, Cells &slope);
  void require_gas() const;
  Conserved outside(const Conserved &inside, Boundary boundary) const;

  int degree_;
  double gamma_;
  double width_;
  std::array<Boundary, 2> boundaries_;
  double time_ = 0;
  std::int64_t n_shrunk_slopes_ = 0;
  std::array<double, 2> counters_{};
  std::vector<double> ends_, centres_;
  std::vector<std::array<double, 2>> inverse_mass_; ///< of the constant and the linear function, 1 / m
  // Of the linear function: at the cell's ends, at its Gauss points, and phi,x JxW there.
  std::array<double, 2> traces_{}, point_values_{}, gradient_weights_{};
  Cells mean_, slope_; ///< coefficients of the two functions; no slopes for degree 0
  Cells mean_rate_, slope_rate_, mean_stage_, slope_stage_, fluxes_;
};

} // namespace fem_reference::gas
