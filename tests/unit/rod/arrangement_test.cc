#include "comparisons/benchmarks/rod/arrangement.h"
#include "comparisons/benchmarks/rod/measurement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace comparisons;
using namespace comparisons::benchmarks::rod;

TEST(RodArrangement, UniformPlacesIncludeBothEnds) {
  const auto x = Arrangement{.length = 3, .n = 7}.places();
  ASSERT_EQ(x.size(), 7u);
  for (std::size_t i = 0; i < x.size(); ++i)
    EXPECT_DOUBLE_EQ(x[i], 0.5 * static_cast<double>(i));
}

TEST(RodArrangement, PerturbedPlacesStayWithinTheirBound) {
  const Arrangement arrangement{.length = 2, .n = 201, .perturbation = 0.25, .seed = 5};
  const auto x = arrangement.places();
  const auto uniform = Arrangement{.length = 2, .n = 201}.places();
  EXPECT_EQ(x, arrangement.places());
  EXPECT_EQ(x.front(), 0);
  EXPECT_EQ(x.back(), 2);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    largest = std::max(largest, std::abs(x[i] - uniform[i]) / arrangement.spacing());
  EXPECT_LE(largest, 0.25 * (1 + 1e-12));
  EXPECT_GT(largest, 0.24); // of 199 uniform numbers the largest is below .96 of the bound once in 3000
  auto other = arrangement;
  other.seed = 6;
  EXPECT_NE(x, other.places());
}

TEST(RodArrangement, VolumesAddUp) {
  const auto x = Arrangement{.length = 2, .n = 21, .perturbation = 0.25, .seed = 1}.places();
  const auto sum = [](std::span<const double> v) {
    double total = 0;
    for (const double value : v)
      total += value;
    return total;
  };
  EXPECT_NEAR(sum(make_particles(x, 1, Volumes::voronoi).volumes()), 2, 1e-14);
  EXPECT_NEAR(sum(make_particles(x, 1, Volumes::equal).volumes()), 2 + 0.1,
              1e-14); // half a volume too much at each end
  EXPECT_DOUBLE_EQ(make_particles(x, 1.5, Volumes::equal).smoothing_length(3), 0.15);
}

TEST(RodArrangement, LevelsAreCountsOrSpacings) {
  scene::Level level;
  level.counts = {41};
  EXPECT_EQ(count_of(level, 2), 41);
  level.spacing = 0.1;
  EXPECT_EQ(count_of(level, 2), 21);
}

std::vector<reports::Cell> series(const std::vector<std::vector<double>> &errors) {
  std::vector<reports::Cell> cells;
  int n = 11;
  for (const auto &of_seeds : errors) {
    reports::Cell cell;
    cell.label = "a";
    cell.n_points = n;
    Measurement measurement;
    for (const double error : of_seeds)
      measurement.add({{"e", error}});
    measurement.write(cell);
    cells.push_back(cell);
    n = 2 * n - 1;
  }
  return cells;
}

TEST(RodSlopes, PowersOfTheSpacingGiveTheirExponent) {
  auto cells = series({{8}, {1}, {1. / 8}});
  add_slopes(cells);
  EXPECT_NEAR(cells.back().quantities.at("e_slope"), 3, 1e-13);
  EXPECT_NEAR(cells.back().quantities.at("e_slope_first"), 3, 1e-13);
  EXPECT_NEAR(cells.back().quantities.at("e_slope_last"), 3, 1e-13);
  EXPECT_FALSE(cells.back().quantities.contains("e_slope_least"));
  EXPECT_TRUE(cells.front().quantities.empty());
}

TEST(RodSlopes, SeedsAreAveragedAndTheirOwnSlopesKept) {
  auto cells = series({{1, 4}, {.5, 1}, {.25, .25}}); // orders 1 and 2
  EXPECT_NEAR(cells[0].errors.at("e"), 2, 1e-15);
  add_slopes(cells);
  const auto &found = cells.back().quantities;
  EXPECT_NEAR(found.at("e_slope"), 1.5, 1e-13);
  EXPECT_NEAR(found.at("e_slope_least"), 1, 1e-13);
  EXPECT_NEAR(found.at("e_slope_largest"), 2, 1e-13);
  for (const auto &cell : cells)
    for (const auto &[name, value] : cell.quantities)
      EXPECT_EQ(name.find("seed"), std::string::npos) << name;
}

TEST(RodSlopes, NoneWhereAnOrderMeansNothing) {
  auto rounding = series({{1e-3}, {1e-12}});
  add_slopes(rounding);
  EXPECT_TRUE(rounding.back().quantities.empty());
  auto failed = series({{1}, {.5}});
  failed.front().status = reports::Status::failed;
  add_slopes(failed);
  EXPECT_TRUE(failed.back().quantities.empty());
  auto alone = series({{1}});
  add_slopes(alone);
  EXPECT_TRUE(alone.back().quantities.empty());
}

} // namespace
