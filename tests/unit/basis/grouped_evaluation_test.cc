// Evaluation anywhere: every point has its own neighbours and the shape functions of a call for it alone, wherever the
// points lie and whatever a filter leaves out.

#include "evaluate_basis.h"

#include "meshless/basis/grouped_evaluation.h"
#include "meshless/basis/rkpm.h"
#include "meshless/basis/ssph.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace meshless;
using cloud::Point;

template <int dim>
Point<dim> filled(double value) {
  Point<dim> x;
  x.fill(value);
  return x;
}

/// The unit box, h up to a factor of 3 apart.
template <int dim>
cloud::Particles<dim> make_cloud() {
  std::array<int, dim> n;
  n.fill(dim == 1 ? 60 : dim == 2 ? 24 : 12);
  auto points = sample_clouds::jittered_grid<dim>(n, filled<dim>(0), filled<dim>(1), .2, 1);
  sample_clouds::Uniform random(2);
  std::vector<double> h(points.size());
  for (double &length : h)
    length = random.between(1, 3) / (n[0] - 1);
  return {std::move(points), std::move(h)};
}

/// A crowd, points as sparse as the particles, few far from each other, some at one place.
template <int dim>
std::vector<Point<dim>> make_points() {
  auto points = sample_clouds::random_points<dim>(211, filled<dim>(0), filled<dim>(1), 3);
  for (const auto &x : sample_clouds::random_points<dim>(100, filled<dim>(.51), filled<dim>(.52), 4))
    points.push_back(x);
  points.insert(points.end(), 11, filled<dim>(.25));
  points.push_back(filled<dim>(0));
  points.push_back(filled<dim>(1));
  return points;
}

/// Cuts the unit box in two at x_1 = 1 / 2, asked for near the cut alone.
template <int dim>
class Cut final : public basis::CandidateFilter<dim> {
public:
  explicit Cut(const cloud::Particles<dim> &particles) : particles_(particles) {}

  static bool apart(const Point<dim> &a, const Point<dim> &b) { return (a[0] < .5) != (b[0] < .5); }

  bool active(const Point<dim> &centre, double radius, double reach) const override {
    EXPECT_LE(radius, reach);
    return std::abs(centre[0] - .5) <= reach;
  }
  void apply(const Point<dim> &point, std::vector<cloud::Index> &candidates) override {
    std::erase_if(candidates,
                  [&](cloud::Index j) { return apart(point, particles_.position(static_cast<std::size_t>(j))); });
  }

private:
  const cloud::Particles<dim> &particles_;
};

template <int dim>
void expect_own_neighbours(bool cut) {
  const auto particles = make_cloud<dim>();
  const auto basis = basis::make_ssph<dim>(1, kernels::Gauss(2.5));
  const cloud::CandidateSearch<dim> search(particles, basis->support());
  Cut<dim> filter(particles);
  const basis::GroupedEvaluation<dim> evaluation(*basis, search, cut ? &filter : nullptr);
  const auto points = make_points<dim>();
  const basis::Wanted wanted{.value = true, .gradient = true};
  std::vector<int> visits(points.size(), 0);
  evaluation.visit(points, wanted, [&](const auto &group) {
    for (std::size_t p = 0; p < group.points.size(); ++p) {
      const auto &x = points[group.points[p]];
      ++visits[group.points[p]];
      std::vector<cloud::Index> expected;
      for (std::size_t j = 0; j < particles.size(); ++j) {
        const double reach = basis->support() * particles.smoothing_length(j);
        if (cloud::distance_squared<dim>(particles.position(j), x) < reach * reach &&
            !(cut && Cut<dim>::apart(particles.position(j), x)))
          expected.push_back(static_cast<cloud::Index>(j));
      }
      ASSERT_EQ(group.n_neighbours(p), expected.size());
      const auto alone = evaluate_basis::at<dim>(*basis, particles, {x}, wanted, expected);
      // Rounding, enlarged by the condition of the moment matrix.
      const double rounding = 1000 * std::numeric_limits<double>::epsilon() / alone.regularity.smallest_pivot_ratio;
      for (std::size_t j = 0; j < group.values.n_candidates(); ++j) {
        const bool own = j < expected.size();
        if (own) {
          EXPECT_EQ(group.neighbour(j, p), expected[j]);
        }
        EXPECT_NEAR(group.values.value(j)[p], own ? alone.values.value(j)[0] : 0, rounding);
        for (int k = 0; k < dim; ++k)
          EXPECT_NEAR(group.values.gradient(k, j)[p], own ? alone.values.gradient(k, j)[0] : 0, rounding / alone.scale);
      }
    }
  });
  EXPECT_EQ(visits, std::vector<int>(points.size(), 1));
}

TEST(GroupedEvaluation, gives_every_point_its_own_neighbours) {
  expect_own_neighbours<1>(false);
  expect_own_neighbours<2>(false);
  expect_own_neighbours<3>(false);
}

TEST(GroupedEvaluation, leaves_out_what_a_filter_leaves_out) {
  expect_own_neighbours<1>(true);
  expect_own_neighbours<2>(true);
  expect_own_neighbours<3>(true);
}

TEST(GroupedEvaluation, needs_volumes_where_the_basis_does) {
  const auto particles = make_cloud<2>();
  const auto basis = basis::make_rkpm<2>(1, kernels::Gauss(2.5));
  const cloud::CandidateSearch<2> search(particles, basis->support());
  const std::vector<Point<2>> points{{.5, .5}};
  EXPECT_TRUE(refusal::mentions(
      refusal::message_of<std::invalid_argument>(
          [&] { basis::GroupedEvaluation<2>(*basis, search).visit(points, {.value = true}, [](const auto &) {}); }),
      {"volumes"}));
}

} // namespace
