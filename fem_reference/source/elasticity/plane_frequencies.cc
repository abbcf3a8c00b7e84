#include "dynamic_system.h"

#include "../stopwatch.h"

#include <algorithm>
#include <cmath>
#include <complex>

#include <deal.II/lac/arpack_solver.h>
#include <deal.II/lac/vector.h>

#include <fmt/format.h>

namespace fem_reference::elasticity {
namespace {
/// A vector of all unknowns, for deal.II.
using Modal = dealii::Vector<double>;

std::span<const double> view(const Modal &x) { return {x.begin(), x.end()}; }
std::span<double> view(Modal &x) { return {x.begin(), x.end()}; }

/// What ARPACK's interface calls a matrix.
struct Product {
  const linear_algebra::BlockMatrix &matrix;
  void vmult(Modal &y, const Modal &x) const { multiply(matrix, view(x), view(y), {}); }
};

struct Inverse {
  linear_algebra::DirectSolver &solver;
  void vmult(Modal &y, const Modal &x) const {
    const auto solution = solver.solve(view(x));
    std::copy(solution.begin(), solution.end(), y.begin());
  }
};

/// A start with a part in every mode and none in prescribed unknowns.
Modal start_vector(const DynamicSystem &system) {
  Modal x(static_cast<unsigned>(system.force.size()));
  unsigned state = 12345;
  for (unsigned i = 0; i < x.size(); ++i) {
    state = state * 1664525u + 1013904223u;
    x(i) = system.essential.prescribed[i] != 0 ? 0 : 1 + static_cast<double>(state) / 4294967296.0;
  }
  return x;
}
} // namespace

PlaneModes natural_frequencies(const PlaneProblem &problem, const PlaneDynamicsOptions &options, unsigned n_modes) {
  const DynamicSystem system(problem, options);
  PlaneModes modes;
  modes.n_dofs = system.force.size();
  modes.nonzeros = 2 * system.stiffness.n_nonzeros_lower() - modes.n_dofs;
  modes.seconds = system.seconds;
  const auto n_free =
      static_cast<unsigned>(std::count(system.essential.prescribed.begin(), system.essential.prescribed.end(), 0));
  const unsigned n_vectors = std::min(n_free - 1, std::max(4 * n_modes, 40U));
  if (n_modes == 0 || n_vectors <= 2 * n_modes + 1)
    throw InvalidInput(fmt::format("{} modes of {} free unknowns; expected 1 to {}", n_modes, n_free, n_free / 2 - 2));
  Stopwatch watch;
  // A rod of the body's longer side vibrates at pi c / L; bending is slower, by the square of the slenderness.
  const double shift = -1e-2 * std::pow(system.wave_speed / system.discretisation.extent, 2);
  const auto solver = system.factorise(-shift, 1);
  dealii::SolverControl control(1000, 1e-13, false, false);
  dealii::ArpackSolver arpack(
      control, dealii::ArpackSolver::AdditionalData(n_vectors, dealii::ArpackSolver::largest_magnitude, true));
  arpack.set_shift(shift);
  arpack.set_initial_vector(start_vector(system));
  std::vector<std::complex<double>> values(n_modes);
  std::vector<Modal> vectors(n_modes, Modal(static_cast<unsigned>(modes.n_dofs)));
  try {
    arpack.solve(Product{system.stiffness}, Product{system.mass}, Inverse{*solver}, values, vectors, n_modes);
  } catch (const dealii::ExceptionBase &error) {
    throw SolveFailure(
        fmt::format("the natural frequencies of {} unknowns did not converge: {}", modes.n_dofs, error.what()));
  }
  for (const auto &value : values)
    modes.squares.push_back(value.real());
  std::sort(modes.squares.begin(), modes.squares.end());
  modes.seconds.solve = watch.lap();
  return modes;
}
} // namespace fem_reference::elasticity
