#include "fem_reference/linear_algebra/algebraic_multigrid.h"

#include <deal.II/base/config.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
#endif

namespace fem_reference::linear_algebra {

namespace {

/// While one lives, nothing that its thread allocates counts as a leak: Open MPI never returns some of what it takes
/// when it starts and ends, and its plug-ins are gone when leaks are looked for, so that no list of suppressions can
/// name them.
#ifdef __SANITIZE_ADDRESS__
using MpiMayLeak = __lsan::ScopedDisabler;
#else
struct MpiMayLeak {
  MpiMayLeak() {} // not trivial: an object is no unused variable
};
#endif

/// MPI from the first need to the end of the program: it can be started once only.
class MpiSession {
public:
  MpiSession() {
    const MpiMayLeak start_of_mpi;
    int started = 0;
    MPI_Initialized(&started);
    own_ = started == 0 && MPI_Init(nullptr, nullptr) == MPI_SUCCESS;
  }
  ~MpiSession() {
    const MpiMayLeak end_of_mpi;
    if (own_)
      MPI_Finalize();
  }
  MpiSession(const MpiSession &) = delete;
  MpiSession &operator=(const MpiSession &) = delete;

private:
  bool own_ = false;
};

/// Two translations and the rotation, one after the other.
std::vector<double> rigid_body_modes(std::span<const std::array<double, 2>> points) {
  const std::size_t n = 2 * points.size();
  std::vector<double> modes(3 * n, 0.0);
  double mean[2] = {0, 0};
  for (const auto &x : points)
    for (std::size_t d = 0; d < 2; ++d)
      mean[d] += x[d] / static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    modes[2 * i] = 1;
    modes[n + 2 * i + 1] = 1;
    modes[2 * n + 2 * i] = -(points[i][1] - mean[1]);
    modes[2 * n + 2 * i + 1] = points[i][0] - mean[0];
  }
  return modes;
}

} // namespace

struct AlgebraicMultigrid::Levels {
  std::vector<double> modes;
  Epetra_MpiComm communicator{MPI_COMM_SELF};
  Epetra_Map rows;
  Epetra_CrsMatrix matrix;
  std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> cycle;

  Levels(const PlaneMatrix &given, std::span<const std::array<double, 2>> points)
      : modes(rigid_body_modes(points)), rows(static_cast<int>(given.offsets.size() - 1), 0, communicator),
        matrix(Copy, rows, lengths(given).data(), true) {
    std::vector<int> columns;
    for (int row = 0; row < rows.NumGlobalElements(); ++row) {
      const auto begin = static_cast<std::size_t>(given.offsets[static_cast<std::size_t>(row)]);
      const auto end = static_cast<std::size_t>(given.offsets[static_cast<std::size_t>(row) + 1]);
      columns.assign(given.columns.begin() + static_cast<std::ptrdiff_t>(begin),
                     given.columns.begin() + static_cast<std::ptrdiff_t>(end));
      matrix.InsertGlobalValues(row, static_cast<int>(end - begin), given.values.data() + begin, columns.data());
    }
    matrix.FillComplete();
  }

  static std::vector<int> lengths(const PlaneMatrix &given) {
    std::vector<int> result;
    for (std::size_t row = 0; row + 1 < given.offsets.size(); ++row)
      result.push_back(static_cast<int>(given.offsets[row + 1] - given.offsets[row]));
    return result;
  }
};

AlgebraicMultigrid::AlgebraicMultigrid(const PlaneMatrix &matrix, std::span<const std::array<double, 2>> points,
                                       Aggregation aggregation) {
  start();
  levels_ = std::make_unique<Levels>(matrix, points);
  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults(aggregation == Aggregation::smoothed ? "SA" : "NSSA", list);
  list.set("ML output", 0);
  // By a norm: other estimates of the largest eigenvalue start at random, and two runs would differ.
  list.set("eigen-analysis: type", "Anorm");
  list.set("PDE equations", 2);
  list.set("null space: type", "pre-computed");
  list.set("null space: vectors", levels_->modes.data());
  list.set("null space: dimension", 3);
  levels_->cycle = std::make_unique<ML_Epetra::MultiLevelPreconditioner>(levels_->matrix, list, false);
  if (const int status = levels_->cycle->ComputePreconditioner(); status != 0)
    throw std::runtime_error(fmt::format("ML could not make its levels (status {})", status));
}

void AlgebraicMultigrid::start() { static const MpiSession session; }

AlgebraicMultigrid::~AlgebraicMultigrid() = default;

void AlgebraicMultigrid::apply(std::span<const double> r, std::span<double> x) const {
  const Epetra_Vector right(View, levels_->rows, const_cast<double *>(r.data()));
  std::fill(x.begin(), x.end(), 0.0);
  Epetra_Vector left(View, levels_->rows, x.data());
  levels_->cycle->ApplyInverse(right, left);
}

} // namespace fem_reference::linear_algebra
