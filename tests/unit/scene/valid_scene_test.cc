#include "small_vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace comparisons::scene;
using scene_tests::read;
using scene_tests::valid_scene;
using scene_tests::with;

namespace {

Scene good(const std::string &text, const std::vector<std::string> &overrides = {}) {
  auto result = read(text, overrides);
  EXPECT_TRUE(result.scene.has_value()) << to_text(result.diagnostics);
  return result.scene.value_or(Scene{});
}

std::vector<std::string> labels(const Scene &scene) {
  std::vector<std::string> result;
  for (const auto &method : scene.methods)
    result.push_back(method.label);
  return result;
}

std::vector<std::string> texts(const std::vector<Level> &levels) {
  std::vector<std::string> result;
  for (const auto &level : levels)
    result.push_back(level.text);
  return result;
}

using Texts = std::vector<std::string>;

} // namespace

TEST(SceneReader, ReadsAValidScene) {
  const Scene scene = good(valid_scene());
  EXPECT_EQ(scene.title, "A beam");
  EXPECT_EQ(scene.benchmark, "beam");
  EXPECT_EQ(scene.name, "beam");
  EXPECT_EQ(scene.file, "beam.toml");
  EXPECT_EQ(scene.material.real("E"), 226.9e9);
  EXPECT_EQ(scene.material.real("nu"), 0.3);
  EXPECT_EQ(scene.material.text("model"), "plane strain");
  EXPECT_EQ(scene.material.location("nu"), (Location{"beam.toml", 8, 6}));
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_EQ(scene.problems[0].label, "");
  EXPECT_EQ(scene.problems[0].parameters.real("length"), 8.0);
  EXPECT_EQ(scene.problems[0].parameters.real("load"), -1.0);
  EXPECT_FALSE(scene.problems[0].parameters.is_given("load"));
  EXPECT_EQ(scene.effects, Texts{"elasticity"});
  EXPECT_EQ(labels(scene), (Texts{"particles", "fem"}));
  EXPECT_EQ(scene.methods[0].parameters.integer("order"), 2);
  EXPECT_FALSE(scene.methods[0].parameters.has("penalty")) << "optional without default";
  EXPECT_EQ(scene.methods[0].location, (Location{"beam.toml", 12, 1}));
  EXPECT_EQ(texts(scene.methods[1].levels), (Texts{"16x4", "31x7"}));
  EXPECT_EQ(scene.methods[0].levels[0].counts, (std::vector{16, 4}));
  EXPECT_EQ(scene.methods[0].expect, "ok");
  EXPECT_EQ(scene.methods[0].refused, "");
  EXPECT_EQ(scene.study.integer("repeats"), 5);
  EXPECT_EQ(scene.study.integer("threads"), 1);
  EXPECT_EQ(scene.study.integer("seed"), 42);
  EXPECT_EQ(scene.study.text("analysis"), "static");
  EXPECT_EQ(scene.study.text("effort"), "quick");
  EXPECT_EQ(scene.study.integer("max_memory"), std::int64_t{4} << 30);
  EXPECT_FALSE(scene.study.has("max_seconds"));
  EXPECT_EQ(scene.output.text("directory"), "out");
  EXPECT_EQ(scene.formats, (Texts{"text", "vtu"}));
}

TEST(SceneReader, DefaultsFillASmallScene) {
  const Scene scene = good("schema = 1\nbenchmark = \"beam\"\n[[method]]\nname = \"fem\"\n"
                           "[study]\nlevels = [[16, 4]]\n");
  EXPECT_EQ(scene.title, "a beam under a load at its end");
  EXPECT_EQ(scene.effects, Texts{"elasticity"});
  EXPECT_EQ(scene.material.real("E"), 1e9);
  EXPECT_EQ(scene.formats, (Texts{"text", "json", "csv", "md"}));
  EXPECT_EQ(scene.methods[0].parameters.text("element"), "Q2");
}

// The same numbers with units, in SI, and spelt in another unit are the same bits.
TEST(SceneReader, UnitsAndBareNumbersAgree) {
  const Scene with_units = good(valid_scene());
  const Scene bare = good(with("\"226.9 GPa\"", "226.9e9"));
  const Scene other = good(with("\"226.9 GPa\"", "\"226900 N/mm^2\""));
  EXPECT_EQ(with_units.material.real("E"), bare.material.real("E"));
  EXPECT_EQ(with_units.material.real("E"), other.material.real("E"));
  EXPECT_EQ(good(with("\"8 m\"", "8")).problems[0].parameters.real("length"), 8.0);
  EXPECT_EQ(good(with("nu = 0.3", "nu = \"0.3\"")).material.real("nu"), 0.3);
}

TEST(SceneReader, ListsMakeOneRequestPerCombinationFirstKeySlowest) {
  const Scene scene = good(with("order = 2\nsupport = 4", "support = [4, 5.5]\norder = [2, 3]"));
  EXPECT_EQ(labels(scene), (Texts{"particles support=4 order=2", "particles support=4 order=3",
                                  "particles support=5.5 order=2", "particles support=5.5 order=3", "fem"}));
  EXPECT_EQ(scene.methods[2].parameters.real("support"), 5.5);
  EXPECT_EQ(scene.methods[2].parameters.integer("order"), 2);
  EXPECT_EQ(scene.methods[2].parameters.location("support"), (Location{"beam.toml", 14, 15}));
  // The order of the parameters is that of the declarations, whatever the file's.
  EXPECT_EQ(scene.methods[0].parameters.all()[0].declaration.name, "order");
}

TEST(SceneReader, AListOfOneDoesNotVary) {
  EXPECT_EQ(labels(good(with("order = 2", "order = [2]"))), (Texts{"particles", "fem"}));
}

TEST(SceneReader, ListsInTheProblemMakeVariants) {
  const Scene scene = good(with("length = \"8 m\"", "jitter = [0, 0.25]\ncorner = [[0, 0], [\"1 km\", 2]]"));
  ASSERT_EQ(scene.problems.size(), 4U);
  EXPECT_EQ(scene.problems[0].label, "jitter=0 corner=[0, 0]");
  EXPECT_EQ(scene.problems[3].label, "jitter=0.25 corner=[1000, 2]");
  EXPECT_EQ(scene.problems[3].parameters.point("corner"), (Point{1000, 2}));
}

TEST(SceneReader, APointIsNoList) {
  const Scene scene = good(with("length = \"8 m\"", "corner = [1, \"2 mm\"]"));
  ASSERT_EQ(scene.problems.size(), 1U);
  EXPECT_EQ(scene.problems[0].parameters.point("corner"), (Point{1, 0.002}));
}

TEST(SceneReader, LabelsLevelsAndExpectationOfAMethod) {
  const Scene scene = good(with("name = \"fem\"", "name = \"fem\"\nlabel = \"coarse\"\nlevels = [\"5 mm\"]\n"
                                                  "expect = \"refused\""));
  EXPECT_EQ(labels(scene), (Texts{"particles", "coarse"}));
  EXPECT_EQ(scene.methods[1].expect, "refused");
  EXPECT_EQ(texts(scene.methods[1].levels), Texts{"0.005 m"});
  EXPECT_EQ(scene.methods[1].levels[0].spacing, 0.005);
  EXPECT_TRUE(scene.methods[1].levels[0].counts.empty());
  EXPECT_EQ(texts(scene.methods[0].levels), (Texts{"16x4", "31x7"}));
}

TEST(SceneReader, TheStudyNeedsNoLevelsIfEveryMethodHasItsOwn) {
  const Scene scene = good("schema = 1\nbenchmark = \"beam\"\n[[method]]\nname = \"fem\"\nlevels = [\"8x2\"]\n");
  EXPECT_TRUE(scene.levels.empty());
  EXPECT_EQ(texts(scene.methods[0].levels), Texts{"8x2"});
}

TEST(SceneReader, EveryFormOfALevel) {
  const Scene scene =
      good(with("[\"16x4\", \"31x7\"]", "[\"16 x 4\", \"8X3\", [5, 6], \"2.5 mm\", \" 7x7 \", \"1e-3 m\"]"));
  EXPECT_EQ(texts(scene.levels), (Texts{"16x4", "8x3", "5x6", "0.0025 m", "7x7", "0.001 m"}));
  EXPECT_EQ(texts(good(with("[\"16x4\", \"31x7\"]", "\"16x4\"")).levels), Texts{"16x4"});
  const Scene bar = good("schema = 1\nbenchmark = \"bar\"\nproblem.mode = 1\nmaterial.density = \"1 kg/m^3\"\n"
                         "study.levels = [188, 686, \"5 mm\"]\n[[method]]\nname = \"fem\"\n");
  EXPECT_EQ(texts(bar.levels), (Texts{"188", "686", "0.005 m"}));
  EXPECT_EQ(bar.levels[0].counts, std::vector{188});
}

TEST(SceneReader, AMethodWithoutAnEffectIsRefusedBeforeComputing) {
  const Scene scene = good(with("elasticity = true", "elasticity = true\ninertia = true\nbody_force = false"));
  EXPECT_EQ(scene.effects, (Texts{"elasticity", "inertia"}));
  EXPECT_EQ(scene.methods[0].refused, "the method particles cannot do the effect 'inertia' that the scene calls for");
  EXPECT_EQ(scene.methods[1].refused, "");
}

TEST(SceneReader, HashFollowsTextAndOverrides) {
  const Scene scene = good(valid_scene());
  EXPECT_EQ(scene.hash.size(), 16U);
  EXPECT_EQ(scene.hash, good(valid_scene()).hash);
  EXPECT_NE(scene.hash, good(valid_scene() + "\n").hash);
  EXPECT_NE(scene.hash, good(valid_scene(), {"material.nu=0.3"}).hash);
}

TEST(SceneReader, JsonHoldsTheResolvedScene) {
  const auto json = to_json(good(with("order = 2", "order = [2, 3]")));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["benchmark"], "beam");
  EXPECT_EQ(json["material"]["E"], 226.9e9);
  EXPECT_EQ(json["problem"][0]["parameters"]["corner"], (std::vector{0.0, 0.0}));
  EXPECT_EQ(json["methods"].size(), 3U);
  EXPECT_EQ(json["methods"][1]["label"], "particles order=3");
  EXPECT_EQ(json["methods"][1]["parameters"]["scaled"], true);
  EXPECT_EQ(json["methods"][1]["levels"], (Texts{"16x4", "31x7"}));
  EXPECT_EQ(json["study"]["levels"], (Texts{"16x4", "31x7"}));
  EXPECT_EQ(json["study"]["repeats"], 5);
  EXPECT_EQ(json["output"]["formats"], (Texts{"text", "vtu"}));
  EXPECT_EQ(nlohmann::ordered_json::parse(json.dump()), json);
}

TEST(SceneReader, WindowsLinesAndAByteOrderMarkAreRead) {
  std::string text = valid_scene();
  std::string crlf = "\xEF\xBB\xBF";
  for (const char c : text)
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(good(crlf).material.location("nu"), (Location{"beam.toml", 8, 6}));
}
