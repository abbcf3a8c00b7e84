#include "small_vocabulary.h"

#include <gtest/gtest.h>

using namespace comparisons::scene;
using scene_tests::findings;
using scene_tests::read;
using scene_tests::valid_scene;
using scene_tests::with;

namespace {

Scene good(const std::vector<std::string> &overrides, const std::string &text = valid_scene()) {
  auto result = read(text, overrides);
  EXPECT_TRUE(result.scene.has_value()) << to_text(result.diagnostics);
  return result.scene.value_or(Scene{});
}

std::string bad(const std::string &override_text) { return findings(valid_scene(), {override_text}); }

} // namespace

TEST(SceneOverrides, ValuesOfEveryKind) {
  EXPECT_EQ(good({"material.nu=0.25"}).material.real("nu"), 0.25);
  EXPECT_EQ(good({"material.E=200 GPa"}).material.real("E"), 200e9);
  EXPECT_EQ(good({"material.E=\"200 GPa\""}).material.real("E"), 200e9);
  EXPECT_EQ(good({" material.E = 200 GPa "}).material.real("E"), 200e9);
  EXPECT_EQ(good({"material.model=plane stress"}).material.text("model"), "plane stress");
  EXPECT_EQ(good({"title=A new one"}).title, "A new one");
  EXPECT_EQ(good({"title=2024-01-01"}).title, "2024-01-01");
  EXPECT_EQ(good({"title="}).title, "");
  EXPECT_EQ(good({"title=a=b"}).title, "a=b");
  EXPECT_EQ(good({"output.directory=/tmp/x.y"}).output.text("directory"), "/tmp/x.y");
  EXPECT_EQ(good({"problem.jitter=[0, 0.25]"}).problems.size(), 2U);
  EXPECT_EQ(good({"study.levels=8x4"}).levels[0].text, "8x4");
  EXPECT_EQ(good({"study.levels=[\"8x4\", [5, 5]]"}).levels[1].text, "5x5");
  EXPECT_EQ(good({"study.max_memory=500 MB"}).study.integer("max_memory"), 500000000);
  EXPECT_EQ(good({"output.formats=json"}).formats, std::vector<std::string>{"json"});
}

TEST(SceneOverrides, TheLastOneWins) {
  EXPECT_EQ(good({"material.nu=0.1", "material.nu=0.2"}).material.real("nu"), 0.2);
}

TEST(SceneOverrides, TablesThatTheSceneDoesNotHave) {
  const std::string small =
      "schema = 1\nbenchmark = \"beam\"\n[[method]]\nname = \"fem\"\n[study]\nlevels = [\"8x4\"]\n";
  const Scene scene = good({"material.nu=0.1", "output.directory=x", "problem.length=2 m"}, small);
  EXPECT_EQ(scene.material.real("nu"), 0.1);
  EXPECT_EQ(scene.output.text("directory"), "x");
  EXPECT_EQ(scene.problems[0].parameters.real("length"), 2);
  // Without [effects] the benchmark's own effects stay.
  EXPECT_EQ(good({"effects.inertia=true"}, small).effects, (std::vector<std::string>{"elasticity", "inertia"}));
}

TEST(SceneOverrides, Effects) {
  EXPECT_EQ(good({"effects.inertia=true"}).effects, (std::vector<std::string>{"elasticity", "inertia"}));
  EXPECT_EQ(good({"effects.elasticity=false", "effects.inertia=true"}).effects, std::vector<std::string>{"inertia"});
}

TEST(SceneOverrides, KeysOfMethods) {
  const std::string three = with("name = \"fem\"", "name = \"fem\"\n[[method]]\nname = \"particles\"\n"
                                                   "label = \"wide\"\nsupport = 6\n[[method]]\n"
                                                   "name = \"fem\"\nlabel = \"other\"");
  const auto supports = [&](const std::string &text) {
    const Scene scene = good({text}, three);
    return std::pair(scene.methods.at(0).parameters.real("support"), scene.methods.at(2).parameters.real("support"));
  };
  EXPECT_EQ(supports("method.support=5"), std::pair(5.0, 5.0)) << "every method that has the key";
  EXPECT_EQ(supports("method.particles.support=5"), std::pair(5.0, 5.0)) << "by name";
  EXPECT_EQ(supports("method.wide.support=5"), std::pair(4.0, 5.0)) << "by label";
  EXPECT_EQ(supports("method.2.support=5"), std::pair(4.0, 5.0)) << "by number";
  EXPECT_EQ(supports("method[0].support=5"), std::pair(5.0, 6.0)) << "by number, as in findings";
  EXPECT_EQ(good({"method.particles.order=[2, 3]"}).methods.size(), 3U);
  EXPECT_EQ(good({"method.levels=[\"5x5\"]"}).methods[1].levels[0].text, "5x5");
}

TEST(SceneOverrides, FindingsNameTheOverride) {
  EXPECT_EQ(bad("material.nu=0.7"), "--set material.nu=0.7: error: material.nu: 0.7 is out of range; "
                                    "it must be in (-1, 0.5]\n");
  EXPECT_EQ(bad("material.E=200"), "");
  EXPECT_EQ(bad("material.nuu=0.3"),
            "--set material.nuu=0.3: error: material.nuu: unknown key 'nuu' in [material]; allowed: E, "
            "nu, model (did you mean 'nu'?)\n");
  EXPECT_EQ(bad("study.levels=[0]"),
            "--set study.levels=[0]: error: study.levels: a level of 1 count; beam takes 2 a level "
            "(write for example \"16x4\")\n");
  EXPECT_EQ(bad("method.particles.support=1"),
            "--set method.particles.support=1: error: method[0].support: the support is too small for "
            "the order\n");
}

TEST(SceneOverrides, MalformedOnes) {
  const std::string example = " (for example --set material.nu=0.3)\n";
  EXPECT_EQ(bad("material.nu"), "--set material.nu: error: an override has the form KEY=VALUE" + example);
  EXPECT_EQ(bad(""), "--set : error: an override has the form KEY=VALUE" + example);
  EXPECT_EQ(bad("=3"), "--set =3: error: the key before '=' is empty" + example);
  EXPECT_EQ(bad("material.=3"), "--set material.=3: error: material.: a part of the key is empty\n");
  EXPECT_EQ(bad(".nu=3"), "--set .nu=3: error: .nu: a part of the key is empty\n");
  EXPECT_EQ(bad("materail.nu=3"),
            "--set materail.nu=3: error: materail.nu: no such key 'materail'; a key begins with one of: "
            "title, benchmark, schema, problem, material, effects, time, study, output, method (did you mean "
            "'material'?)\n");
  EXPECT_EQ(bad("material=3"), "--set material=3: error: material: a key of [material] has the form material.KEY\n");
  EXPECT_EQ(bad("material.a.b=3"),
            "--set material.a.b=3: error: material.a.b: a key of [material] has the form material.KEY\n");
  EXPECT_EQ(bad("title.x=3"), "--set title.x=3: error: title.x: 'title' has no keys below it\n");
  EXPECT_EQ(bad("study.levels=[16x4]"),
            "--set study.levels=[16x4]: error: study.levels: the value begins like a list, a table or a "
            "text in quotes, but is no TOML value (texts inside a list are in quotes: "
            "'study.levels=[\"16x4\"]')\n");
  EXPECT_EQ(bad("title=\xFF"), "--set title=\xFF: error: the text is not UTF-8\n");
}

TEST(SceneOverrides, KeysThatNoMethodHas) {
  EXPECT_EQ(bad("method.suport=5"),
            "--set method.suport=5: error: method.suport: no method of this scene has the key 'suport' "
            "(did you mean 'support'?)\n");
  EXPECT_EQ(bad("method.fem.support=5"),
            "--set method.fem.support=5: error: method.fem.support: no method of this scene named 'fem' "
            "has the key 'support'\n");
  EXPECT_EQ(bad("method.fme.element=Q1"),
            "--set method.fme.element=Q1: error: method.fme.element: no method of this scene is named "
            "'fme'; it has: particles, fem (did you mean 'fem'?)\n");
  EXPECT_EQ(bad("method.2.element=Q1"),
            "--set method.2.element=Q1: error: method.2.element: no method number '2'; the scene has 2, "
            "counted from 0\n");
  EXPECT_EQ(bad("method=5"),
            "--set method=5: error: method: a key of methods has the form method.KEY, method.NAME.KEY or "
            "method.NUMBER.KEY\n");
}

TEST(SceneOverrides, HugeAndDeepValuesAreRefused) {
  EXPECT_NE(bad("study.levels=" + std::string(100000, '[')), "");
  EXPECT_NE(bad("study.levels=" + std::string(100000, '.')), "");
  std::string path = "a";
  for (int i = 0; i < 100000; ++i)
    path += ".a";
  EXPECT_NE(bad(path + "=1"), "");
  EXPECT_NE(bad("material.nu={" + path + "=1}"), "");
  EXPECT_NE(bad("material.nu=1\nmaterial.E=2"), "");
}
