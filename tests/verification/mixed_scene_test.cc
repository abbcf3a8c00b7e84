// The method mixed and the element Q2Q1 in scenes: the same error for every nu up to 1/2, and a pressure in the files.

#include "verification/scene_runs.h"

#include <gtest/gtest.h>

namespace {

using namespace scene_runs;
using namespace comparisons;

std::string scene_at(double nu, const std::string &jitter) {
  return "schema = 1\nbenchmark = \"cantilever\"\n[problem]\njitter = " + jitter +
         "\n[material]\nmodel = \"plane strain\"\nnu = " + std::to_string(nu) +
         "\n[[method]]\nname = \"mixed\"\n[[method]]\nname = \"fem\"\nelement = \"Q2Q1\"\n[[method]]\nname = "
         "\"weak1\"\n"
         "[study]\nlevels = [\"31x7\"]\nseed = 3\n";
}

TEST(MixedScene, errors_of_the_cantilever_are_those_of_every_nu_while_weak1_locks) {
  for (const auto *jitter : {"0", "0.25"}) {
    std::vector<std::vector<reports::Cell>> by_nu;
    for (const double nu : {.49, .4999, .499999})
      by_nu.push_back(run(read(scene_at(nu, jitter))));
    for (std::size_t i = 1; i < by_nu.size(); ++i) {
      for (const std::size_t method : {0u, 1u}) { // mixed, Q2Q1: within 5 %
        EXPECT_NEAR(l2(by_nu[i][method]) / l2(by_nu[0][method]), 1, .05) << jitter << ", " << i;
        EXPECT_TRUE(by_nu[i][method].warnings.empty()) << by_nu[i][method].warnings[0];
      }
      EXPECT_GT(l2(by_nu[i][2]), 3 * l2(by_nu[0][2])) << jitter << ", " << i;
      EXPECT_FALSE(by_nu[i][2].warnings.empty());
    }
  }
}

} // namespace
