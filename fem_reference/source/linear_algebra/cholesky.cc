#include "direct_solvers.h"

#include "fem_reference/errors.h"

#include <memory>

#include <dlfcn.h>
#include <fmt/format.h>
#include <suitesparse/cholmod.h>

namespace fem_reference::linear_algebra {
namespace {
/// One OpenMP thread for this scope. CHOLMOD asks for four in its own loops whatever OMP_NUM_THREADS
/// says, which on few cores costs half of the factorisation's time; BLAS has its own setting. The
/// function is looked up because it is CHOLMOD, not this library, that links OpenMP (or does not).
class SerialOpenMp {
public:
  SerialOpenMp()
      : get_levels_(find<int (*)()>("omp_get_max_active_levels")),
        set_levels_(find<void (*)(int)>("omp_set_max_active_levels")),
        levels_(get_levels_ != nullptr ? get_levels_() : 0) {
    if (set_levels_ != nullptr)
      set_levels_(0);
  }
  ~SerialOpenMp() {
    if (set_levels_ != nullptr)
      set_levels_(levels_);
  }
  SerialOpenMp(const SerialOpenMp &) = delete;
  SerialOpenMp &operator=(const SerialOpenMp &) = delete;

private:
  template <typename Function>
  static Function find(const char *name) {
    return reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, name));
  }

  int (*get_levels_)();
  void (*set_levels_)(int);
  int levels_;
};

/// CHOLMOD's workspace and factor, freed through it.
class Cholesky : public DirectSolver {
public:
  Cholesky() {
    cholmod_start(&common_);
    common_.print = 0;
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 1;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.final_ll = 1;
  }
  ~Cholesky() override {
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  std::vector<int> order_nodes(const BlockMatrix &matrix);
  void factorise(cholmod_sparse &matrix, std::vector<int> &permutation);
  std::vector<double> solve(std::span<const double> right_hand_side) override;

private:
  void check(const char *step) const {
    if (common_.status == CHOLMOD_OUT_OF_MEMORY)
      throw SolveFailure(fmt::format("Cholesky: out of memory in {}", step));
    if (common_.status == CHOLMOD_TOO_LARGE)
      throw SolveFailure(fmt::format("Cholesky: the factor is too large for 32-bit indices ({})", step));
    if (common_.status < CHOLMOD_OK)
      throw SolveFailure(fmt::format("Cholesky: CHOLMOD error {} in {}", common_.status, step));
  }

  cholmod_common common_{};
  cholmod_factor *factor_ = nullptr;
};

/// A view of compressed columns, lower triangle.
cholmod_sparse view(int n, std::vector<int> &start, std::vector<int> &rows, double *values) {
  cholmod_sparse sparse{};
  sparse.nrow = sparse.ncol = static_cast<std::size_t>(n);
  sparse.nzmax = rows.size();
  sparse.p = start.data();
  sparse.i = rows.data();
  sparse.x = values;
  sparse.stype = -1;
  sparse.itype = CHOLMOD_INT;
  sparse.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  sparse.dtype = CHOLMOD_DOUBLE;
  sparse.sorted = 1;
  sparse.packed = 1;
  return sparse;
}

/// AMD on the graph of nodes, four times smaller than that of the unknowns; both unknowns of a node
/// stay together, which also helps the supernodes.
std::vector<int> Cholesky::order_nodes(const BlockMatrix &matrix) {
  auto start = matrix.block_start;
  auto rows = matrix.block_rows;
  cholmod_sparse graph = view(matrix.n_nodes(), start, rows, nullptr);
  std::vector<int> nodes(static_cast<std::size_t>(matrix.n_nodes()));
  cholmod_amd(&graph, nullptr, 0, nodes.data(), &common_);
  check("ordering");
  std::vector<int> permutation;
  permutation.reserve(2 * nodes.size());
  for (const int node : nodes) {
    permutation.push_back(2 * node);
    permutation.push_back(2 * node + 1);
  }
  return permutation;
}

void Cholesky::factorise(cholmod_sparse &matrix, std::vector<int> &permutation) {
  factor_ = cholmod_analyze_p(&matrix, permutation.data(), nullptr, 0, &common_);
  check("analysis");
  cholmod_factorize(&matrix, factor_, &common_);
  check("factorisation");
  if (common_.status == CHOLMOD_NOT_POSDEF || factor_->minor < factor_->n)
    throw PivotFailure{static_cast<const int *>(factor_->Perm)[factor_->minor], "its pivot is not positive"};
  // Ratio of the extreme diagonal entries of L, squared: 1e-14 leaves no digits for the solution.
  const double condition = cholmod_rcond(factor_, &common_);
  if (!(condition > 1e-14))
    throw PivotFailure{-1, fmt::format("the reciprocal condition number is about {:.1e}", condition)};
}

std::vector<double> Cholesky::solve(std::span<const double> right_hand_side) {
  const SerialOpenMp serial;
  std::vector<double> copy(right_hand_side.begin(), right_hand_side.end());
  cholmod_dense b{};
  b.nrow = b.nzmax = b.d = copy.size();
  b.ncol = 1;
  b.x = copy.data();
  b.xtype = CHOLMOD_REAL;
  b.dtype = CHOLMOD_DOUBLE;
  cholmod_dense *x = cholmod_solve(CHOLMOD_A, factor_, &b, &common_);
  check("substitution");
  const auto *values = static_cast<const double *>(x->x);
  std::vector<double> solution(values, values + copy.size());
  cholmod_free_dense(&x, &common_);
  return solution;
}
} // namespace

std::unique_ptr<DirectSolver> factorise_cholesky(const BlockMatrix &matrix) {
  const SerialOpenMp serial;
  auto solver = std::make_unique<Cholesky>();
  auto permutation = solver->order_nodes(matrix);
  std::vector<int> start;
  std::vector<int> rows;
  matrix.scalar_pattern(start, rows);
  // CHOLMOD takes a mutable pointer but only reads.
  cholmod_sparse sparse = view(matrix.n_rows(), start, rows, const_cast<double *>(matrix.values.data()));
  solver->factorise(sparse, permutation);
  return solver;
}
} // namespace fem_reference::linear_algebra
