#include "comparisons/scene/describe.h"
#include "small_vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace comparisons::scene;
using scene_tests::read;
using scene_tests::small_vocabulary;
using scene_tests::valid_scene;

TEST(SceneDescribe, DeclarationsAsAlignedText) {
  const auto vocabulary = small_vocabulary();
  EXPECT_EQ(describe_declarations(vocabulary.benchmarks[0].material),
            "key    type           default       allowed                     meaning\n"
            "E      pressure [Pa]  1 GPa         greater than 0              Young's modulus, in Pa\n"
            "nu     number         0.25          in (-1, 0.5]                Poisson's ratio\n"
            "model  one of         plane stress  plane stress, plane strain  plane stress or plane strain\n");
  EXPECT_NE(describe_declarations(vocabulary.benchmarks[1].problem).find("required"), std::string::npos);
  EXPECT_NE(describe_declarations(study_declarations()).find("max_memory"), std::string::npos);
}

TEST(SceneDescribe, EffectsCalledForAndAbsent) {
  const auto result = read(valid_scene());
  ASSERT_TRUE(result.scene.has_value());
  EXPECT_EQ(describe_effects(*result.scene, small_vocabulary()), "effects called for:\n"
                                                                 "  elasticity       linear elasticity\n"
                                                                 "effects absent (not computed, not allocated):\n"
                                                                 "  body_force       a force per volume\n"
                                                                 "  inertia          mass times acceleration\n"
                                                                 "  heat_conduction  Fourier's law\n");
}

TEST(SceneDescribe, ValuesAsInAScene) {
  EXPECT_EQ(toml_text(226.9e9, dimensions::pressure), "\"226.9 GPa\"");
  EXPECT_EQ(toml_text(0.3, dimensions::none), "0.3");
  EXPECT_EQ(toml_text(Point{0, 1}, dimensions::none), "[0, 1]");
  EXPECT_EQ(toml_text(Point{0, 0.001}, dimensions::length), "[\"0 m\", \"1 mm\"]");
  EXPECT_EQ(toml_text("a \"b\"\\\n", dimensions::none), "\"a \\\"b\\\"\\\\\\u000A\"");
  EXPECT_EQ(toml_text(true, dimensions::none), "true");
}

// The scene to start from is valid and resolves to the defaults.
TEST(SceneDescribe, InitialSceneReadsBack) {
  const auto vocabulary = small_vocabulary();
  const std::vector<MethodDescription> methods(vocabulary.methods.begin(), vocabulary.methods.begin() + 2);
  for (const auto &benchmark : vocabulary.benchmarks) {
    const std::string text = initial_scene(benchmark, methods);
    const auto result = read(text);
    ASSERT_TRUE(result.scene.has_value()) << text << to_text(result.diagnostics);
    EXPECT_EQ(result.scene->benchmark, benchmark.name);
    EXPECT_EQ(result.scene->effects, benchmark.effects);
    EXPECT_EQ(result.scene->methods.size(), 2U);
    for (const auto &declaration : benchmark.material) {
      if (!declaration.default_value)
        continue;
      const auto &all = result.scene->material.all();
      const auto found =
          std::ranges::find_if(all, [&](const Parameter &p) { return p.declaration.name == declaration.name; });
      ASSERT_NE(found, all.end());
      EXPECT_EQ(found->value, *declaration.default_value) << declaration.name;
    }
  }
}

TEST(SceneDescribe, InitialSceneWithLevelsOfItsOwn) {
  const auto vocabulary = small_vocabulary();
  const std::vector<std::string> levels{"\"5x5\"", "[7, 7]"};
  const auto result = read(initial_scene(vocabulary.benchmarks[0], std::span(vocabulary.methods).first(1), levels));
  ASSERT_TRUE(result.scene.has_value()) << to_text(result.diagnostics);
  EXPECT_EQ(result.scene->levels[1].text, "7x7");
}

// Every commented key of the initial scene is valid when the comment sign is taken away.
TEST(SceneDescribe, CommentedDefaultsAreValid) {
  const auto vocabulary = small_vocabulary();
  std::string text = initial_scene(vocabulary.benchmarks[0], std::span(vocabulary.methods).first(2));
  for (const std::string key : {"order", "support", "kernel", "scaled", "element", "repeats", "threads", "seed",
                                "analysis", "effort", "directory"}) {
    const auto place = text.find("\n# " + key + " = ");
    ASSERT_NE(place, std::string::npos) << key << "\n" << text;
    text.erase(place + 1, 2);
  }
  const auto result = read(text);
  EXPECT_TRUE(result.scene.has_value()) << to_text(result.diagnostics);
}
