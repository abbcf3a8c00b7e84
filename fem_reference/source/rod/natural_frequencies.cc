#include "discretisation.h"

#include "../stopwatch.h"

#include <algorithm>
#include <cmath>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <fmt/format.h>

namespace fem_reference::rod {
namespace {
dealii::SparseMatrix<double> mass_of(const Discretisation &discretisation, Mass kind) {
  dealii::SparseMatrix<double> mass(discretisation.pattern);
  const unsigned n_points = discretisation.element.degree + 1;
  if (kind == Mass::consistent)
    assemble_mass(discretisation, dealii::QGauss<1>(n_points), mass);
  else
    assemble_mass(discretisation, dealii::QGaussLobatto<1>(n_points), mass);
  return mass;
}

/// The rows and columns of the free nodes.
dealii::LAPACKFullMatrix<double> reduced(const dealii::SparseMatrix<double> &matrix,
                                         const std::vector<unsigned> &free) {
  const auto n = static_cast<unsigned>(free.size());
  dealii::LAPACKFullMatrix<double> result(n, n);
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j)
      result(i, j) = matrix.el(free[i], free[j]);
  result.set_property(dealii::LAPACKSupport::symmetric);
  return result;
}
} // namespace

Frequencies natural_frequencies(const Rod &rod, const Options &options) {
  check(rod);
  const Discretisation discretisation(rod.vertices, options.degree);
  Stopwatch watch;
  std::vector<unsigned> free;
  const auto is_fixed = [&](unsigned node) {
    for (const int side : {0, 1})
      if (rod.ends[side].kind == EndKind::displacement && node == discretisation.end_node(side))
        return true;
    return false;
  };
  for (unsigned node = 0; node < discretisation.numbering.n_dofs(); ++node)
    if (!is_fixed(node))
      free.push_back(node);
  if (free.empty())
    throw InvalidInput("the rod has no free unknown; give it more vertices or a higher degree");
  dealii::SparseMatrix<double> stiffness(discretisation.pattern);
  assemble_stiffness(discretisation, stiffness);
  auto k = reduced(stiffness, free);
  auto m = reduced(mass_of(discretisation, options.mass), free);
  Frequencies frequencies;
  frequencies.n_dofs = discretisation.numbering.n_dofs();
  frequencies.nonzeros = discretisation.pattern.n_nonzero_elements();
  frequencies.seconds = discretisation.seconds;
  frequencies.seconds.assembly = watch.lap();

  std::vector<dealii::Vector<double>> no_modes;
  try {
    k.compute_generalized_eigenvalues_symmetric(m, no_modes);
  } catch (const dealii::ExceptionBase &error) {
    throw SolveFailure(fmt::format("the eigenvalue problem of the rod could not be solved: {}", error.what()));
  }
  const double wave_speed = std::sqrt(rod.youngs_modulus / rod.density);
  for (unsigned n = 0; n < free.size(); ++n) {
    const double square = k.eigenvalue(n).real();
    if (!(square > 0))
      throw SolveFailure(fmt::format("eigenvalue {} of the rod is {}; expected a positive one", n + 1, square));
    frequencies.omega.push_back(std::sqrt(square) * wave_speed / discretisation.half_length);
  }
  std::sort(frequencies.omega.begin(), frequencies.omega.end());
  frequencies.seconds.solve = watch.lap();
  return frequencies;
}
} // namespace fem_reference::rod
