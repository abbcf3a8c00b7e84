// [time] and the keys of effects.

#include "comparisons/scene/describe.h"
#include "unit/scene/small_vocabulary.h"

#include <gtest/gtest.h>

namespace scene_tests {
namespace {

using namespace comparisons::scene;

std::string bar_scene(const std::string &more) {
  return "schema = 1\nbenchmark = \"bar\"\nproblem.mode = 1\nmaterial.density = 2\n" + more +
         "[[method]]\nname = \"particles\"\n[study]\nlevels = [10]\n";
}

TEST(SceneTime, DefaultsAreTheBenchmarks) {
  const auto result = read(bar_scene(""));
  ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
  EXPECT_EQ(result.scene->time.real("end"), 2);
  EXPECT_EQ(result.scene->time.real("cfl"), 0.5);
  EXPECT_EQ(result.scene->time.integer("snapshots"), 3);
  EXPECT_FALSE(result.scene->time.has("step"));
  EXPECT_FALSE(result.scene->time.has("checkpoint_every"));
  EXPECT_EQ(result.scene->study.text("analysis"), "transient");
}

TEST(SceneTime, ValuesCarryUnits) {
  const auto result = read(bar_scene("[time]\nend = \"14 us\"\nstep = \"2 ns\"\ncheckpoint_every = 100\n"));
  ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
  EXPECT_DOUBLE_EQ(result.scene->time.real("end"), 14e-6);
  EXPECT_DOUBLE_EQ(result.scene->time.real("step"), 2e-9);
  EXPECT_EQ(result.scene->time.integer("checkpoint_every"), 100);
}

TEST(SceneTime, StepAndCflTogetherAreRefused) {
  EXPECT_EQ(findings(bar_scene("[time]\nstep = \"2 ns\"\ncfl = 0.4\n")),
            "beam.toml:6:1: error: time.step: 'step' and 'cfl' both say how long a step is (remove one of them)\n");
}

TEST(SceneTime, WrongValues) {
  EXPECT_TRUE(findings(bar_scene("[time]\nend = \"3 m\"\n")).starts_with("beam.toml:6:7: error: time.end: "));
  EXPECT_NE(findings(bar_scene("[time]\nend = 0\n")).find("time.end"), std::string::npos);
  EXPECT_NE(findings(bar_scene("[time]\nsnapshot = 2\n")).find("did you mean 'snapshots'?"), std::string::npos);
}

TEST(SceneTime, AnalysisOfAnotherBenchmarkIsRefused) {
  EXPECT_NE(findings(bar_scene(""), {"study.analysis=static"}).find("allowed: transient, modes"), std::string::npos);
}

TEST(SceneEffects, TrueTakesTheBenchmarksDefaults) {
  const auto result = read(bar_scene("[effects]\nbody_force = true\n"));
  ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
  EXPECT_EQ(result.scene->effect_parameters.at("body_force").real("factor"), 7);
}

TEST(SceneEffects, ATableGivesParameters) {
  const auto result = read(bar_scene("[effects.body_force]\nfactor = 3\n"));
  ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
  EXPECT_EQ(result.scene->effects, std::vector<std::string>{"body_force"});
  EXPECT_EQ(result.scene->effect_parameters.at("body_force").real("factor"), 3);
  EXPECT_FALSE(result.scene->effect_parameters.contains("elasticity"));
}

TEST(SceneEffects, OverridesReachParametersAndCallForTheEffect) {
  for (const std::string before : {"", "[effects]\nbody_force = true\n", "[effects.body_force]\nfactor = 3\n"}) {
    const auto result = read(bar_scene(before), {"effects.body_force.factor=5", "time.end=9"});
    ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
    EXPECT_EQ(result.scene->effect_parameters.at("body_force").real("factor"), 5);
    EXPECT_EQ(result.scene->time.real("end"), 9);
  }
}

TEST(SceneEffects, FalseRemovesParameters) {
  const auto result = read(bar_scene("[effects]\nelasticity = true\nbody_force = false\n"));
  ASSERT_TRUE(result.scene) << to_text(result.diagnostics);
  EXPECT_FALSE(result.scene->effect_parameters.contains("body_force"));
}

TEST(SceneEffects, InitialSceneOfATransientBenchmarkReadsBack) {
  const auto vocabulary = small_vocabulary();
  const std::string text = initial_scene(vocabulary.benchmarks[1], std::span(vocabulary.methods).first(1));
  EXPECT_NE(text.find("[time]"), std::string::npos);
  const auto result = read(text);
  EXPECT_TRUE(result.scene) << to_text(result.diagnostics);
}

} // namespace
} // namespace scene_tests
