#include "meshless/linear_algebra/iterative_solver.h"

#include "block_rows.h"
#include "coarse_correction.h"
#include "incomplete_lu.h"
#include "names.h"

#include <fmt/format.h>

#include <stdexcept>

namespace meshless::linear_algebra {

namespace {

constexpr PreconditionerDescription table[] = {
    {Preconditioner::ilu0, "ilu0", "incomplete factors on the pattern of the matrix"},
    {Preconditioner::thinned, "thinned", "incomplete factors on the pattern of the matrix less what is small"},
    {Preconditioner::ilut, "ilut", "incomplete factors with fill, less what is small"},
    {Preconditioner::ilu0_coarse, "ilu0+coarse", "ilu0 and a coarse system of aggregates"},
    {Preconditioner::thinned_coarse, "thinned+coarse", "thinned and a coarse system of aggregates"},
    {Preconditioner::ilut_coarse, "ilut+coarse", "ilut and a coarse system of aggregates"},
};

bool has_coarse(Preconditioner preconditioner) { return preconditioner >= Preconditioner::ilu0_coarse; }

Dropping dropping_of(const PreconditionerSettings &settings) {
  switch (settings.preconditioner) {
  case Preconditioner::ilut:
  case Preconditioner::ilut_coarse:
    return {settings.drop.value_or(1e-2), settings.fill};
  case Preconditioner::thinned:
  case Preconditioner::thinned_coarse:
    return {settings.drop.value_or(2e-3), 0};
  default:
    return {0, 0};
  }
}

std::vector<BlockRows::Index> order_of_blocks(const SparseRows &matrix, Ordering ordering) {
  if (matrix.n_rows() != matrix.n_columns() || matrix.n_rows() % 2 != 0)
    throw std::invalid_argument(
        fmt::format("a matrix of {} rows and {} columns has no blocks of 2 x 2", matrix.n_rows(), matrix.n_columns()));
  return order_of(matrix, ordering, 2);
}

} // namespace

std::span<const PreconditionerDescription> preconditioner_table() { return table; }

const char *to_text(Preconditioner preconditioner) {
  return entry_of(preconditioner_table(), &PreconditionerDescription::preconditioner, preconditioner).name;
}

Preconditioner preconditioner_of(std::string_view name) {
  return entry_named(preconditioner_table(), name, "preconditioner").preconditioner;
}

struct PreconditionedSystem::Parts {
  std::vector<BlockRows::Index> order;
  BlockRows blocks;
  double norm;
  IncompleteLu factors;
  std::optional<CoarseCorrection> coarse;

  Parts(const SparseRows &matrix, const PreconditionerSettings &settings)
      : order(order_of_blocks(matrix, settings.ordering)), blocks(matrix, order), norm(maximum_norm(matrix)),
        factors(blocks, dropping_of(settings)) {
    if (!factors.regular())
      throw SolveError("a pivot of the incomplete factors is singular");
    if (has_coarse(settings.preconditioner))
      coarse.emplace(blocks, factors);
  }
};

PreconditionedSystem::PreconditionedSystem(const SparseRows &matrix, const PreconditionerSettings &settings)
    : parts_(std::make_unique<Parts>(matrix, settings)) {}

PreconditionedSystem::~PreconditionedSystem() = default;

double PreconditionedSystem::reciprocal_condition() const { return parts_->factors.pivot_ratio(); }

bool PreconditionedSystem::coarse_left_out() const { return parts_->coarse && !parts_->coarse->regular(); }

std::size_t PreconditionedSystem::bytes() const {
  return parts_->factors.bytes() + (parts_->coarse ? parts_->coarse->bytes() : 0);
}

KrylovResult PreconditionedSystem::solve(Krylov krylov, std::span<const double> right_hand_side,
                                         const KrylovTolerance &tolerance) {
  const auto &order = parts_->order;
  std::vector<double> b(right_hand_side.size());
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      b[2 * k + d] = right_hand_side[2 * std::size_t{order[k]} + d];
  const LinearOperator multiply = [this](std::span<const double> x, std::span<double> y) {
    parts_->blocks.multiply(x, y);
  };
  const LinearOperator precondition = [this](std::span<const double> r, std::span<double> x) {
    if (parts_->coarse)
      parts_->coarse->apply(r, x);
    else
      parts_->factors.solve(r, x);
  };
  auto result = solve_krylov(krylov, multiply, parts_->norm, precondition, b, tolerance);
  b = result.solution;
  for (std::size_t k = 0; k < order.size(); ++k)
    for (std::size_t d = 0; d < 2; ++d)
      result.solution[2 * std::size_t{order[k]} + d] = b[2 * k + d];
  return result;
}

std::optional<IterativeResult> solve_iteratively(const SparseRows &matrix, std::span<const double> right_hand_side,
                                                 const IterativeSettings &settings) {
  try {
    PreconditionedSystem system(matrix, settings.preconditioner);
    auto solved = system.solve(settings.krylov, right_hand_side, settings.tolerance);
    if (!solved.converged)
      return {};
    return IterativeResult{std::move(solved.solution),    solved.iterations, solved.algebraic_error,
                           system.reciprocal_condition(), solved.n_restarts, system.coarse_left_out()};
  } catch (const SolveError &) {
    return {};
  }
}

} // namespace meshless::linear_algebra
