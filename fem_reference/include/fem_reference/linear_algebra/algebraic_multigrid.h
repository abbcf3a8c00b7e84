#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace fem_reference::linear_algebra {

/// A square matrix of two unknowns a point (2 I and 2 I + 1), compressed rows.
struct PlaneMatrix {
  std::span<const std::int64_t> offsets;
  std::span<const std::int32_t> columns;
  std::span<const double> values;
};

/// How ML makes its coarse spaces.
enum class Aggregation {
  smoothed,            ///< made for symmetric positive definite matrices (Vanek, Mandel, Brezina 1996)
  smoothed_unsymmetric ///< restriction and prolongation apart, each by energy (Sala, Tuminaro 2008)
};

/// A V-cycle of smoothed aggregation of Trilinos ML with the three rigid-body modes of the plane as near null space, as
/// a preconditioner of matrices made elsewhere.
class AlgebraicMultigrid {
public:
  /// @param points positions of the unknowns, m
  /// @throws std::runtime_error if ML cannot make its levels
  AlgebraicMultigrid(const PlaneMatrix &matrix, std::span<const std::array<double, 2>> points, Aggregation aggregation);
  ~AlgebraicMultigrid();
  /// Starts MPI, through which ML talks even when it is alone; once in a process, some tenths of a second. The
  /// constructor does it if nobody has. MPI ends with the program.
  static void start();
  AlgebraicMultigrid(const AlgebraicMultigrid &) = delete;
  AlgebraicMultigrid &operator=(const AlgebraicMultigrid &) = delete;

  /// x = one V-cycle for A x = r
  void apply(std::span<const double> r, std::span<double> x) const;

private:
  struct Levels;
  std::unique_ptr<Levels> levels_;
};

} // namespace fem_reference::linear_algebra
