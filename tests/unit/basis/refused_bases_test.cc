// What bases refuse, by name: kernels, orders, dimensions, missing volumes, too few neighbours.

#include "evaluate_basis.h"
#include "line_clouds.h"

#include "meshless/basis/basis_table.h"
#include "meshless/basis/derivative_operators.h"
#include "unit/cloud/sample_clouds.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace meshless;
using basis::make_basis;
using refusal::mentions;
using refusal::message_of;

template <int dim = 1>
std::string making(const char *name, int order, const kernels::Kernel &kernel = kernels::Gauss(4)) {
  return message_of<std::invalid_argument>([&] { make_basis<dim>(name, order, kernel); });
}

TEST(MakeBasis, refuses) {
  const auto message = making("spph", 2);
  EXPECT_TRUE(mentions(message, {"'spph'"}));
  for (const auto &entry : basis::basis_table())
    EXPECT_TRUE(mentions(message, {entry.name}));
  EXPECT_TRUE(mentions(making("ssph", 5), {"ssph", "5", "1 to 4"}));
  EXPECT_TRUE(mentions(making("msph", 3), {"msph", "3", "1 to 2"}));
  EXPECT_TRUE(mentions(making("cspm", 1), {"cspm", "order 2"}));
  EXPECT_TRUE(mentions(making<2>("fpm2", 2), {"fpm2", "one dimension"}));
  EXPECT_TRUE(mentions(making<3>("rkpm1_frozen", 1), {"rkpm1_frozen", "one dimension"}));
  EXPECT_TRUE(mentions(making("msph", 2, kernels::Linear()), {"msph", "linear", "singular", "quadratic"}));
  EXPECT_TRUE(mentions(making<2>("msph", 2, kernels::Linear()), {"linear"}));
  EXPECT_EQ(making("msph", 1, kernels::Linear()), "");
  EXPECT_EQ(making("msph", 2, kernels::Quadratic()), "");
}

TEST(MakeBasis, makes_what_the_table_lists) {
  for (const auto &entry : basis::basis_table())
    for (int order = entry.lowest_order; order <= entry.highest_order; ++order) {
      const auto shape = make_basis<1>(entry.name, order, kernels::Gauss(order + 2));
      EXPECT_EQ(shape->order(), order) << entry.name;
      EXPECT_FALSE(entry.meaning.empty());
      const auto particles = line_clouds::rod(12);
      const auto wants = [&](const basis::Wanted &wanted) {
        return message_of<std::invalid_argument>([&] { evaluate_basis::at<1>(*shape, particles, {{.4}}, wanted); });
      };
      EXPECT_EQ(wants({.value = true, .gradient = true}), "") << entry.name;
      EXPECT_EQ(wants({.differentiated_gradient = true}) == "", entry.differentiable) << entry.name;
      if (order != 1) {
        EXPECT_EQ(wants({.hessian = true}) == "", entry.hessian_anywhere) << entry.name;
      }
    }
}

TEST(Msph, works_with_the_quadratic_kernel) {
  const auto particles = line_clouds::cell_centred(20, 1.5);
  const auto operators = basis::make_derivative_operators<1>(*make_basis<1>("msph", 2, kernels::Quadratic()), particles,
                                                             {.value = true, .gradient = true, .hessian = true});
  std::vector<double> f;
  for (const auto &x : particles.positions())
    f.push_back(x[0] * x[0]);
  std::vector<double> second(f.size());
  operators.hessian[0].multiply(f, second);
  for (const double value : second)
    EXPECT_NEAR(value, 2, 1e-11) << "rounding over D^2 = 1 / 400";
}

TEST(Volumes, are_needed_by_name) {
  const auto with = line_clouds::cell_centred(20, 1.5);
  const cloud::Particles<1> without({with.positions().begin(), with.positions().end()},
                                    {with.smoothing_lengths().begin(), with.smoothing_lengths().end()});
  EXPECT_FALSE(without.has_volumes());
  for (const auto &entry : basis::basis_table()) {
    const auto shape = make_basis<1>(entry.name, entry.lowest_order, kernels::Gauss(5));
    const auto message =
        message_of<std::invalid_argument>([&] { evaluate_basis::at<1>(*shape, without, {{.4}}, {.value = true}); });
    if (entry.volumes == basis::VolumeUse::optional) {
      EXPECT_EQ(message, "") << entry.name;
    } else {
      EXPECT_TRUE(mentions(message, {"volumes", "the cloud has none"})) << entry.name;
    }
  }
  const auto weighted = make_basis<1>("ssph", 2, kernels::Gauss(4), {.volumes = true});
  EXPECT_THROW(evaluate_basis::at<1>(*weighted, without, {{.4}}, {.value = true}), std::invalid_argument);
}

TEST(Volumes, must_be_positive_and_as_many_as_particles) {
  const auto making_cloud = [](std::vector<double> volumes) {
    return message_of<std::invalid_argument>([&] {
      cloud::Particles<1>({{0.}, {1.}, {2.}}, {1., 1., 1.}, std::move(volumes));
    });
  };
  EXPECT_EQ(making_cloud({1, 2, 3}), "");
  EXPECT_TRUE(mentions(making_cloud({1, 2}), {"3 positions", "2 volumes"}));
  for (const double bad : {0., -1., std::nan(""), HUGE_VAL})
    EXPECT_TRUE(mentions(making_cloud({1, bad, 3}), {"particle 1", "volume"}));
}

TEST(Neighbours, fewer_than_terms_are_refused_by_place_and_count) {
  // Between the 12 particles of the rod a support of .8 h reaches one or two.
  const auto particles = line_clouds::rod(12);
  for (const auto &entry : basis::basis_table()) {
    const auto shape = make_basis<1>(entry.name, entry.highest_order, kernels::Gauss(.8));
    const auto message = message_of<basis::SingularMomentMatrix>(
        [&] { evaluate_basis::at<1>(*shape, particles, {{5. / 11 + .01}}, {.value = true, .gradient = true}); });
    if (shape->n_terms() > 1) {
      EXPECT_TRUE(mentions(message, {"(0.464545)", "too few neighbours", "1 for", "0.8"})) << entry.name;
    } else {
      EXPECT_EQ(message, "");
    }
    EXPECT_TRUE(mentions(message_of<basis::SingularMomentMatrix>([&] {
                           evaluate_basis::at<1>(*shape, particles, {{7.}}, {.value = true, .gradient = true});
                         }),
                         {"(7)", "0 for"}))
        << entry.name;
  }
}

TEST(Msph, particles_on_a_line_are_refused) {
  std::vector<cloud::Point<2>> line;
  for (int i = 0; i < 9; ++i)
    line.push_back({.1 * i, .3 * i});
  const cloud::Particles<2> particles(line, std::vector<double>(9, 1), std::vector<double>(9, 1));
  for (const char *name : {"msph", "cspm"}) {
    const auto shape = make_basis<2>(name, 2, kernels::Gauss(5));
    EXPECT_TRUE(mentions(message_of<basis::SingularMomentMatrix>([&] {
                           evaluate_basis::at<2>(*shape, particles, {{.4, 1.2}}, {.value = true, .gradient = true});
                         }),
                         {"(0.4, 1.2)", "9 neighbours"}))
        << name;
  }
}

} // namespace
