#include "meshless/elasticity/weak_form/local_petrov_galerkin.h"

#include <gtest/gtest.h>

#include <numeric>

namespace {

using namespace meshless;
using elasticity::Material;
namespace weak_form = elasticity::weak_form;

const Material steel{2e11, .3, elasticity::PlaneModel::plane_stress};

TEST(Penalty, is_measured_in_the_length_of_the_domain_as_in_the_papers) {
  weak_form::Parameters parameters;
  parameters.characteristic_length = 4;
  EXPECT_DOUBLE_EQ(weak_form::penalty_factor(parameters, steel, .1), 1e5 * 2e11 / 4)
      << "Batra & Zhang 2008, section 4.1";
}

TEST(Penalty, is_measured_in_the_smoothing_length_where_it_is_asked_for) {
  weak_form::Parameters parameters;
  parameters.penalty = weak_form::moderate_penalty;
  parameters.penalty_length = weak_form::PenaltyLength::smoothing;
  parameters.characteristic_length = 4;
  EXPECT_DOUBLE_EQ(weak_form::penalty_factor(parameters, steel, .1), 20 * 2e11 / .1);
}

TEST(Penalty, takes_the_smoothing_length_of_the_nearest_of_the_candidates) {
  const cloud::Particles<2> particles({{0, 0}, {1, 0}, {3, 0}}, {.1, .2, .3});
  const std::vector<cloud::Index> all{0, 1, 2}, without_the_first{1, 2};
  EXPECT_EQ(weak_form::nearest_smoothing_length(particles, all, {.4, 1}), .1);
  EXPECT_EQ(weak_form::nearest_smoothing_length(particles, all, {.6, 1}), .2);
  EXPECT_EQ(weak_form::nearest_smoothing_length(particles, without_the_first, {0, 0}), .2);
  EXPECT_EQ(weak_form::nearest_smoothing_length(particles, all, {9, 0}), .3);
}

TEST(Penalty, does_not_leave_the_choice_between_equally_near_particles_to_rounding) {
  const cloud::Particles<2> particles({{0, 0}, {.3, .1}, {3, 0}}, {.1, .2, .3});
  const cloud::Particles<2> renumbered({{.3, .1}, {3, 0}, {0, 0}}, {.2, .3, .1});
  const std::vector<cloud::Index> all{0, 1, 2};
  for (const double rounding : {-1e-16, 0., 1e-16})
    for (const auto *cloud : {&particles, &renumbered})
      EXPECT_EQ(weak_form::nearest_smoothing_length(*cloud, all, {.15 + rounding, .05}), .2) << rounding;
}

} // namespace
