#pragma once

#include "meshless/basis/dense_lu.h"
#include "meshless/basis/neighbour_pack.h"
#include "meshless/basis/point_neighbours.h"
#include "meshless/basis/taylor_projection.h"
#include "meshless/cloud/neighbour_lists.h"
#include "meshless/cloud/particles.h"
#include "meshless/linear_algebra/pack.h"

#include <array>
#include <cstddef>
#include <span>
#include <stdexcept>
#include <vector>

namespace meshless::basis {

/// Points that share one list of candidates, coordinates as separate arrays padded to whole SIMD
/// packs (the padding repeats the last point).
template <int dim>
class PointBatch {
public:
  void assign(std::span<const cloud::Point<dim>> points);
  /// A range of coordinate arrays.
  void assign(const std::array<std::span<const double>, dim> &coordinates);

  std::size_t size() const { return size_; }
  std::size_t stride() const { return stride_; }
  const double *coordinate(int k) const { return coordinates_[k].data(); }
  cloud::Point<dim> point(std::size_t i) const;

private:
  std::size_t size_ = 0;
  std::size_t stride_ = 0;
  std::array<std::vector<double>, dim> coordinates_;
};

/// The candidate particles of a batch: those whose support may reach one of its points. Of one thread: a basis keeps in
/// it what it has computed for these candidates alone.
template <int dim>
class CandidateBatch {
public:
  /// (xi_J - centre) / scale, all monomials up to the degree, a row a candidate.
  struct MonomialTable {
    int degree = 0; ///< 0: there is none yet
    cloud::Point<dim> centre{};
    std::vector<double> rows;
  };

  /// @param about a place near which shape functions will be asked for: rounding and speed may depend on it
  void assign(const cloud::Particles<dim> &particles, std::span<const cloud::Index> candidates,
              const cloud::Point<dim> &about);

  std::size_t size() const { return inverse_h_.size(); }
  const double *coordinate(int k) const { return coordinates_[k].data(); }
  /// 1 / h of every candidate, 1/m.
  const double *inverse_h() const { return inverse_h_.data(); }
  /// Volume of every candidate, m^dim, or null if the cloud has none.
  const double *volumes() const { return volumes_.empty() ? nullptr : volumes_.data(); }
  /// Component k of the flattening of every candidate, or null if supports are round.
  const double *flattening(int k) const { return flattenings_[k].empty() ? nullptr : flattenings_[k].data(); }
  /// Mean smoothing length: the scale of the monomials, m.
  double scale() const { return scale_; }
  MonomialTable &monomials() const { return monomials_; }

private:
  std::array<std::vector<double>, dim> coordinates_;
  std::vector<double> inverse_h_;
  std::vector<double> volumes_;
  std::array<std::vector<double>, dim> flattenings_;
  double scale_ = 1;
  mutable MonomialTable monomials_;
};

/// Which shape functions are asked for; what is not asked for is not computed.
struct Wanted {
  bool value = false;
  /// First derivatives as the basis defines them: found directly by SSPH and MSPH, those of the shape
  /// function by RKPM and MLS.
  bool gradient = false;
  /// Second derivatives, likewise.
  bool hessian = false;
  /// First derivatives of the shape function itself (weak2).
  bool differentiated_gradient = false;
};

/// Shape functions of one batch, point fastest: entry (quantity, candidate, point).
///
/// Quantities: value; gradient k; hessian (k, l) with k <= l, in the order 11, 12, .., 22, ..;
/// differentiated gradient k.
template <int dim>
class ShapeFunctionValues {
public:
  static constexpr int n_hessian = dim * (dim + 1) / 2;
  static constexpr int n_quantities = 1 + dim + n_hessian + dim;

  /// @param stride of the points
  void resize(const Wanted &wanted, std::size_t n_candidates, std::size_t stride);

  /// Rows of as many points as the batch has, and padding; valid only for what was wanted.
  const double *value(std::size_t j) const { return row(0, j); }
  const double *gradient(int k, std::size_t j) const { return row(1 + k, j); }
  const double *hessian(int kl, std::size_t j) const { return row(1 + dim + kl, j); }
  const double *differentiated_gradient(int k, std::size_t j) const { return row(1 + dim + n_hessian + k, j); }

  double *row(int quantity, std::size_t j) { return data_.data() + (slot_[quantity] * n_candidates_ + j) * stride_; }
  const double *row(int quantity, std::size_t j) const {
    return data_.data() + (slot_[quantity] * n_candidates_ + j) * stride_;
  }
  bool has(int quantity) const { return slot_[quantity] != absent; }
  std::size_t n_candidates() const { return n_candidates_; }
  /// From one candidate's row to the next; some more than the points.
  std::size_t stride() const { return stride_; }

private:
  static constexpr std::size_t absent = static_cast<std::size_t>(-1);
  std::size_t n_candidates_ = 0;
  std::size_t stride_ = 0;
  std::array<std::size_t, n_quantities> slot_{};
  std::vector<double> data_;
};

/// How regular the moment matrices of a batch were.
struct Regularity {
  /// Smallest pivot of the factorisation over its diagonal entry, 1 = perfectly regular.
  double smallest_pivot_ratio = 1;
  /// Point of the batch where that was; the first one where several are singular.
  std::size_t worst_point = 0;
  /// Candidates inside the support at that point.
  std::size_t n_neighbours = 0;
  /// Points whose moment matrix was not positive definite (a kernel with negative values); they were
  /// solved by LU with complete pivoting.
  std::size_t n_indefinite = 0;
};

/// Pivot ratios below this mean a moment matrix that is singular to rounding: a regular one with
/// this ratio would leave no more than three digits.
inline constexpr double singular_pivot_ratio = 1e-12;

/// How the derivatives at particles follow from the shape functions.
struct OperatorRule {
  /// First derivatives of B - B(x_i) instead of B: exact for constants.
  bool subtract_own_value = false;
  /// Second derivatives by applying the first twice.
  bool reiterate = false;
};

/// Meshless shape functions: the one interface of all bases.
///
/// Thread-safe; scratch arrays live in a Workspace of the caller, so that nothing is allocated
/// per point.
template <int dim>
class ShapeFunctions {
public:
  /// Scratch of one thread; grows to the largest batch and stays.
  struct Workspace {
    std::vector<double> weights;
    std::vector<double> slopes;
    std::vector<double> curvatures;
    std::vector<double> weight_derivatives;
    ShapeFunctionValues<dim> one_point;
    std::vector<cloud::Index> active;
    PointNeighbours<dim> neighbours;
    std::vector<DenseLu> factors;
    std::array<TaylorProjection, 2> projections;
    std::vector<double> numbers;
    PointBatch<dim> own_point;
    CandidateBatch<dim> own_candidates;
  };

  virtual ~ShapeFunctions() = default;

  /// Shape functions of all candidates at all points of the batch. Singular lanes give
  /// meaningless values and are reported in the result; see `require_regular`.
  virtual Regularity evaluate(const PointBatch<dim> &points, const CandidateBatch<dim> &candidates,
                              const Wanted &wanted, ShapeFunctionValues<dim> &values, Workspace &workspace) const = 0;

  /// Shape functions at points with neighbours of their own: row (quantity, a)[i] belongs to neighbour a of point i,
  /// and is 0 where its list is shorter. The same to rounding as `evaluate` of the points with any candidates.
  ///
  /// This one evaluates point by point.
  virtual Regularity evaluate_own(const NeighbourPack<dim> &pack, const Wanted &wanted,
                                  ShapeFunctionValues<dim> &values, Workspace &workspace) const;

  /// Radius of the support in units of h: candidates must be given up to there.
  virtual double support() const = 0;
  /// Degree m of the Taylor series that the basis rests on.
  virtual int order() const = 0;
  /// Highest degree of the polynomials whose derivatives of this order (0, 1, 2) are exact at particles;
  /// -1 if not even those of constants are.
  virtual int reproduced_degree(int derivative) const {
    (void)derivative;
    return order();
  }
  /// How derivatives at particles come about (see DerivativeOperators).
  virtual OperatorRule operator_rule() const { return {}; }
  /// Terms of the basis: the least number of neighbours.
  virtual std::size_t n_terms() const = 0;
};

/// A moment matrix that is singular to rounding: where, and what would mend it.
class SingularMomentMatrix : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// @throws SingularMomentMatrix naming point, neighbours and terms if a moment matrix of the
///   batch was singular to rounding
template <int dim>
void require_regular(const Regularity &regularity, const PointBatch<dim> &points, const ShapeFunctions<dim> &basis);
template <int dim>
void require_regular(const Regularity &regularity, const NeighbourPack<dim> &pack, const ShapeFunctions<dim> &basis);

} // namespace meshless::basis
