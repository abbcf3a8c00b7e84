// The benchmark of linear solvers: every alternative, on systems of weak1 on a grid and on a graded cloud, against
// sparse LU refined in extended precision; the rule; what fails and says why; and the keys of particle methods.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace scene_runs;

const std::string head = R"(schema = 1
title = "small systems"
benchmark = "solvers"
[problem]
system = ["cantilever", "plate_with_hole"]
)";
const std::string tail = "[study]\nlevels = [300]\nrepeats = 1\n";

bool converges(const reports::Cell &cell) { return cell.status == reports::Status::ok; }

TEST(Solvers, all_alternatives_find_one_solution_and_keep_the_rule) {
  const auto cells = run(read(head + R"([[method]]
name = "umfpack"
ordering = ["natural", "rcm", "amd", "metis"]
[[method]]
name = "bicgstab"
preconditioner = ["ilu0", "thinned", "ilut", "ilu0+coarse", "thinned+coarse", "ilut+coarse", "ml", "ml_unsymmetric"]
[[method]]
name = "gmres"
preconditioner = ["ilu0", "thinned", "ilut", "ilu0+coarse", "thinned+coarse", "ilut+coarse", "ml", "ml_unsymmetric"]
)" + tail));
  ASSERT_EQ(cells.size(), 2 * (4 + 8 + 8));
  for (const auto &cell : cells) {
    ASSERT_TRUE(converges(cell)) << name_of(cell);
    // The backward error is below 1e-13 in any case; condition numbers of these systems are below 1e6.
    EXPECT_LT(cell.errors.at("algebraic_error"), 1e-8) << name_of(cell);
    EXPECT_LE(cell.quantities.at("algebraic_over_discretisation"), .01) << name_of(cell);
    EXPECT_GT(cell.quantities.at("discretisation_error"), 1e-5) << name_of(cell);
    EXPECT_LE(cell.quantities.at("backward_error"), 1e-13) << name_of(cell);
    EXPECT_EQ(cell.quantities.contains("solver_iterations"), cell.method != "umfpack") << name_of(cell);
    EXPECT_EQ(cell.linear_solver.at("method"), cell.method);
  }
  for (const char *variant : {"system=cantilever", "system=plate_with_hole"})
    EXPECT_EQ(std::count_if(cells.begin(), cells.end(),
                            [&](const auto &cell) {
                              return cell.variant == variant && cell.parameters.at("chosen").template get<bool>();
                            }),
              1)
        << variant;
}

/// What the solver says of its error without knowing the solution, at tolerances from loose to tight.
TEST(Solvers, the_estimate_by_tightening_is_within_two_decades_of_the_error) {
  for (const auto &cell : run(read(head + R"([[method]]
name = "bicgstab"
backward_error = [1e-6, 1e-9, 1e-12]
[[method]]
name = "gmres"
backward_error = [1e-6, 1e-9, 1e-12]
)" + tail))) {
    ASSERT_TRUE(converges(cell)) << name_of(cell);
    const double ratio = cell.quantities.at("estimated_error") / cell.errors.at("algebraic_error");
    EXPECT_LT(ratio, 100) << name_of(cell);
    EXPECT_GT(ratio, .01) << name_of(cell);
  }
}

TEST(Solvers, what_does_not_converge_fails_with_its_reason) {
  for (const auto &cell : run(read(head + R"([[method]]
name = "bicgstab"
max_iterations = 2
[[method]]
name = "gmres"
preconditioner = ["ilu0", "ml_unsymmetric"]
max_iterations = 2
)" + tail))) {
    EXPECT_EQ(cell.status, reports::Status::failed) << name_of(cell);
    EXPECT_NE(cell.reason.find("no convergence: a backward error of"), std::string::npos) << cell.reason;
    EXPECT_NE(cell.reason.find("after 2 iterations"), std::string::npos) << cell.reason;
  }
}

/// Bit for bit, the levels of ML and incomplete factors alike.
TEST(Solvers, repeat_to_the_last_bit) {
  const auto scene = read(head + R"([[method]]
name = "bicgstab"
preconditioner = ["thinned+coarse", "ilut", "ml", "ml_unsymmetric"]
[[method]]
name = "umfpack"
ordering = ["amd", "metis"]
)" + tail);
  const auto first = run(scene);
  const auto second = run(scene);
  for (std::size_t i = 0; i < first.size(); ++i)
    for (const char *name : {"backward_error", "solver_iterations", "estimated_error"})
      if (first[i].quantities.contains(name)) {
        EXPECT_EQ(first[i].quantities.at(name), second[i].quantities.at(name)) << name_of(first[i]) << ": " << name;
      }
}

constexpr const char *plate = R"(schema = 1
title = "keys of the solver"
benchmark = "plate_with_hole"
[[method]]
name = "weak1"
)";

/// The same field by every solver that a scene can name, and its name in the cell.
TEST(Solvers, particle_methods_take_orderings_and_preconditioners_by_name) {
  struct Row {
    std::string keys;
    std::map<std::string, std::string> names;
  };
  const std::vector<Row> rows{
      {"", {{"method", "bicgstab"}, {"ordering", "rcm"}, {"preconditioner", "thinned+coarse"}}},
      {"solver = \"umfpack\"\n", {{"method", "umfpack"}, {"ordering", "amd"}}},
      {"solver = \"umfpack\"\nordering = \"metis\"\n", {{"method", "umfpack"}, {"ordering", "metis"}}},
      {"solver = \"gmres\"\nordering = \"amd\"\npreconditioner = \"ilut\"\n",
       {{"method", "gmres"}, {"ordering", "amd"}, {"preconditioner", "ilut"}}}};
  std::vector<reports::Cell> cells;
  for (const auto &[keys, names] : rows) {
    cells.push_back(run(read(plate + keys + "[study]\nlevels = [188]\n")).at(0));
    ASSERT_TRUE(converges(cells.back())) << cells.back().reason;
    EXPECT_EQ(cells.back().linear_solver, names) << keys;
    EXPECT_LT(cells.back().quantities.at("algebraic_error"), 1e-10) << keys;
    const double error = cells.back().errors.at("displacement_l2_relative");
    EXPECT_NEAR(error, cells.front().errors.at("displacement_l2_relative"), 1e-9 * error) << keys;
  }
}

TEST(Solvers, sparse_lu_with_a_preconditioner_is_an_error_of_the_scene) {
  try {
    read(std::string(plate) + "solver = \"umfpack\"\npreconditioner = \"ilut\"\n[study]\nlevels = [188]\n");
    FAIL() << "was accepted";
  } catch (const std::runtime_error &error) {
    EXPECT_NE(std::string(error.what()).find("sparse LU has no preconditioner"), std::string::npos) << error.what();
  }
}

/// Finite elements tell the same: 10^-2 of the error of Q4 on the coarsest mesh is far above what corrections change.
TEST(Solvers, finite_elements_name_their_solver_and_estimate_its_error) {
  const auto cells = run(read(R"(schema = 1
title = "elements"
benchmark = "plate_with_hole"
[[method]]
name = "fem"
element = "Q2"
solver = ["cholesky", "umfpack", "multigrid"]
[study]
levels = [686]
)"));
  ASSERT_EQ(cells.size(), 3U);
  for (const auto &cell : cells) {
    ASSERT_TRUE(converges(cell)) << cell.reason;
    EXPECT_LE(cell.quantities.at("algebraic_error"), .01 * cell.errors.at("displacement_l2_relative")) << cell.label;
    EXPECT_GT(cell.quantities.at("algebraic_error"), 0) << cell.label;
  }
  EXPECT_EQ(cells[0].linear_solver.at("method"), "cholesky");
  EXPECT_EQ(cells[1].linear_solver.at("method"), "umfpack");
  EXPECT_EQ(cells[2].linear_solver.at("preconditioner"), "multigrid");
}

} // namespace
