// The matrix of hard cases: how outcomes are judged, and that no quick cell of the dearest families fails.

#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/matrix.h"
#include "sanitized.h"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <csignal>
#include <limits>
#include <set>
#include <thread>

namespace {

using namespace comparisons::hard_cases;
namespace study = comparisons::study;

const study::Catalogue &catalogue() {
  static const study::Catalogue shipped = study::shipped_catalogue();
  return shipped;
}

HardCase made_up(std::function<Measurement(const std::string &)> run) {
  return {"made up", "case", "", "", .01, "", {"m"}, true, std::move(run)};
}

MatrixCell cell_of(std::function<Measurement(const std::string &)> run) {
  return run_matrix({made_up(std::move(run))}, {.max_seconds = 1, .stop_requested = {}, .progress = {}}).at(0);
}

TEST(Verdict, tells_holding_from_degrading_from_silently_wrong) {
  const auto hard_case = made_up({});
  EXPECT_EQ(judge(hard_case, {.01}), CellVerdict::holds);
  EXPECT_EQ(judge(hard_case, {.05}), CellVerdict::degrades);
  EXPECT_EQ(judge(hard_case, {.11}), CellVerdict::fails); // above 10 % and not a word
  EXPECT_EQ(judge(hard_case, {.11, {}, {"a warning"}}), CellVerdict::degrades);
  EXPECT_EQ(judge(hard_case, {std::numeric_limits<double>::quiet_NaN(), {}, {"a warning"}}), CellVerdict::fails);
}

TEST(Matrix, a_crash_a_hang_and_no_number_fail_while_a_named_refusal_does_not) {
  EXPECT_EQ(cell_of([](const std::string &) { return Measurement{.001}; }).verdict, CellVerdict::holds);
  const auto refused = cell_of([](const std::string &) -> Measurement { throw NamedRefusal("by name"); });
  EXPECT_EQ(refused.verdict, CellVerdict::refused);
  EXPECT_EQ(refused.reason, "by name");
  EXPECT_EQ(cell_of([](const std::string &) -> Measurement { throw std::runtime_error("oops"); }).verdict,
            CellVerdict::fails);
  const auto crashed = cell_of([](const std::string &) -> Measurement {
    std::signal(SIGSEGV, SIG_DFL); // a sanitizer has a handler of its own
    std::raise(SIGSEGV);
    return {};
  });
  EXPECT_EQ(crashed.verdict, CellVerdict::fails);
  EXPECT_NE(crashed.reason.find("crashed"), std::string::npos) << crashed.reason;
  const auto hung = cell_of([](const std::string &) -> Measurement {
    std::this_thread::sleep_for(std::chrono::seconds(60));
    return {};
  });
  EXPECT_EQ(hung.verdict, CellVerdict::fails);
  EXPECT_LT(hung.seconds, 10);
  const auto nothing = cell_of([](const std::string &) { return Measurement{std::nan("")}; });
  EXPECT_EQ(nothing.verdict, CellVerdict::fails);
  EXPECT_FALSE(nothing.error.has_value());
}

TEST(CaseTable, every_case_says_what_it_is_and_why_its_threshold) {
  std::set<std::string> names;
  for (const auto &hard_case : case_table(catalogue())) {
    EXPECT_TRUE(names.insert(hard_case.family + ": " + hard_case.name).second) << hard_case.name;
    EXPECT_FALSE(hard_case.meaning.empty() || hard_case.reference.empty() || hard_case.reason.empty())
        << hard_case.name;
    EXPECT_FALSE(hard_case.methods.empty()) << hard_case.name;
    EXPECT_GT(hard_case.threshold, 0) << hard_case.name;
  }
  EXPECT_GT(names.size(), 60u);
}

/// The quick cases of a family; every cell must end with a number or a reason, and none may be silently wrong.
class Family : public testing::TestWithParam<const char *> {};
INSTANTIATE_TEST_SUITE_P(Quick, Family,
                         testing::Values("patch", "slenderness", "degenerate", "shift", "contrast", "L-shape",
                                         "slot of", "slit", "penalty", "bar wave", "time step", "Swegle", "gas",
                                         "zero modes", "long runs"),
                         [](const auto &instance) {
                           std::string name = instance.param;
                           std::erase_if(name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); });
                           return name;
                         });

TEST_P(Family, has_no_cell_that_fails) {
  const auto cases = select(case_table(catalogue()), {.cases = {GetParam()}, .methods = {}, .quick = true});
  ASSERT_FALSE(cases.empty());
  const auto cells = run_matrix(cases, {.max_seconds = 30 * sanitized::slowness, .stop_requested = {}, .progress = {}});
  for (const auto &cell : cells) {
    EXPECT_NE(cell.verdict, CellVerdict::fails) << cell.family << ": " << cell.name << ", " << cell.method << ": "
                                                << cell.reason << " " << cell.error.value_or(-1);
    if (cell.verdict == CellVerdict::refused) {
      EXPECT_GT(cell.reason.size(), 10u) << cell.name << ", " << cell.method;
    }
  }
}

MatrixCell one(const std::string &hard_case, const std::string &method) {
  auto cases = select(case_table(catalogue()), {.cases = {hard_case}, .methods = {}, .quick = true});
  for (auto &c : cases)
    c.methods = {method};
  return run_matrix(cases, {.max_seconds = 30 * sanitized::slowness, .stop_requested = {}, .progress = {}}).at(0);
}

TEST(Locking, shows_in_displacement_methods_with_a_warning_and_not_in_mixed_ones) {
  for (const auto *hard_case : {"cook nu=0.4999", "thick cylinder nu=0.499999", "cantilever nu=0.499999"}) {
    for (const auto *method : {"mixed", "fem Q2Q1"})
      EXPECT_EQ(one(hard_case, method).verdict, CellVerdict::holds) << hard_case << ", " << method;
    const auto locked = one(hard_case, "fem Q1");
    EXPECT_EQ(locked.verdict, CellVerdict::degrades) << hard_case;
    ASSERT_FALSE(locked.warnings.empty());
    EXPECT_NE(locked.warnings[0].find("lock"), std::string::npos);
  }
}

TEST(LowerOrder, holds_on_a_cloud_too_thin_for_the_order_with_a_warning) {
  const auto cell = one("four lines for order 4", "weak1");
  EXPECT_EQ(cell.verdict, CellVerdict::holds) << cell.reason;
  ASSERT_FALSE(cell.warnings.empty());
  EXPECT_NE(cell.warnings[0].find("solved with order 3"), std::string::npos) << cell.warnings[0];
}

TEST(Mixed, is_consistent_and_the_same_for_every_nu) {
  for (const auto *hard_case : {"quadratic, nu=0.499999", "ring, errors for every nu", "oscillation of the pressure"})
    EXPECT_EQ(one(hard_case, "mixed").verdict, CellVerdict::holds) << hard_case;
}

/// Ten times the error of the cloud as it is; with the papers' penalty single clouds had more than a hundred times.
TEST(Jitter, leaves_no_outlier_around_a_hole) {
  for (const auto *hard_case : {"plate with a hole 30 %, order 2", "plate with a hole 30 %, order 3"})
    EXPECT_EQ(one(hard_case, "weak1 consistent").verdict, CellVerdict::holds) << hard_case;
}

TEST(ComplexEigenvalues, end_a_run_by_name) {
  EXPECT_EQ(one("bar, complex eigenvalues", "ssph").verdict, CellVerdict::refused);
  const auto grows = one("plate, complex eigenvalues", "weak1");
  EXPECT_EQ(grows.verdict, CellVerdict::refused);
  EXPECT_NE(grows.reason.find("energy grows"), std::string::npos) << grows.reason;
  EXPECT_EQ(one("plate, complex eigenvalues", "fem Q2").verdict, CellVerdict::holds);
}

TEST(LongRuns, keep_their_energy_or_end_by_name) {
  for (const auto *hard_case : {"1e6 steps, bounds", "1e6 steps, drift"})
    for (const auto *method : {"ssph", "fem"})
      EXPECT_EQ(one(hard_case, method).verdict, CellVerdict::holds) << hard_case << ", " << method;
  for (const auto *hard_case : {"growth on its way, h = 1.88 D", "growth on its way, h = 2 D"}) {
    const auto grows = one(hard_case, "ssph");
    EXPECT_EQ(grows.verdict, CellVerdict::refused) << hard_case;
    EXPECT_NE(grows.reason.find("unstable at any time step"), std::string::npos) << grows.reason;
  }
}

// At h = 1.5 m / rho, the default of scenes, particles beside a contact discontinuity collide.
TEST(BlastWaves, hold_or_end_by_name) {
  for (const auto *hard_case : {"two blast waves, density", "two blast waves, balances"}) {
    for (const auto *method : {"sph h=1.2", "fem P0", "fem P1"})
      EXPECT_EQ(one(hard_case, method).verdict, CellVerdict::holds) << hard_case << ", " << method;
    const auto collided = one(hard_case, "sph h=1.5");
    EXPECT_EQ(collided.verdict, CellVerdict::refused) << hard_case;
    EXPECT_NE(collided.reason.find("particles collide"), std::string::npos) << collided.reason;
  }
}

TEST(Slit, is_refused_by_name) {
  for (const auto *method : {"weak1", "mixed", "strong", "fem Q2"}) {
    const auto cell = one("slit: a slot of no width", method);
    EXPECT_EQ(cell.verdict, CellVerdict::refused) << method;
    EXPECT_FALSE(cell.reason.empty()) << method;
  }
}

TEST(ReentrantCorner, energy_of_elements_falls_with_the_singular_exponent) {
  auto cases =
      select(case_table(catalogue()), {.cases = {"L-shape, rate of the stress"}, .methods = {}, .quick = false});
  ASSERT_EQ(cases.size(), 1u);
  cases[0].methods = {"fem Q1", "fem Q2", "weak1"};
  for (const auto &cell :
       run_matrix(cases, {.max_seconds = 60 * sanitized::slowness, .stop_requested = {}, .progress = {}})) {
    ASSERT_TRUE(cell.value.has_value()) << cell.method << cell.reason;
    EXPECT_NEAR(*cell.value, .5445, .1) << cell.method;
  }
}

TEST(Slenderness, q1_with_full_integration_visibly_locks_and_q2_does_not) {
  const auto q1 = one("cantilever L/h=1000", "fem Q1");
  EXPECT_GT(q1.error.value_or(0), .5);
  EXPECT_EQ(one("cantilever L/h=1000", "fem Q2").verdict, CellVerdict::holds);
}

TEST(TaylorHood, cook_by_24_cells_a_side) {
  // 64 x 64 cells give 21.94, 18.73, 18.50, 18.50; on 24 x 24 the corner's singularity leaves .5 %.
  const std::pair<const char *, double> tips[] = {
      {"cook nu=0.3", 21.94}, {"cook nu=0.49", 18.73}, {"cook nu=0.4999", 18.50}, {"cook nu=0.499999", 18.50}};
  for (const auto &[hard_case, tip] : tips)
    EXPECT_NEAR(one(hard_case, "fem Q2Q1").value.value_or(0), tip, .005 * tip) << hard_case;
}

} // namespace
