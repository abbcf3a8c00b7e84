#include "small_vocabulary.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

using namespace comparisons::scene;
using scene_tests::read;
using scene_tests::valid_scene;

namespace {

/// Pieces that are likely to reach deep into the reader.
constexpr std::array<std::string_view, 44> pieces{"[",
                                                  "]",
                                                  "[[",
                                                  "]]",
                                                  "{",
                                                  "}",
                                                  "=",
                                                  ".",
                                                  ",",
                                                  "\"",
                                                  "'",
                                                  "\"\"\"",
                                                  "#",
                                                  "\n",
                                                  " ",
                                                  "0",
                                                  "-1",
                                                  "1e400",
                                                  "nan",
                                                  "inf",
                                                  "1e308",
                                                  "\"8 m\"",
                                                  "\"x\"",
                                                  "16x4",
                                                  "true",
                                                  "[]",
                                                  "{}",
                                                  "[[1,2]]",
                                                  "method",
                                                  "name",
                                                  "effects",
                                                  "geometry",
                                                  "study.",
                                                  "\\",
                                                  "\xFF",
                                                  "\xC3\xA9",
                                                  "label = \"a\"",
                                                  "9223372036854775807",
                                                  "-9223372036854775808",
                                                  "1979-05-27",
                                                  "levels = [1]",
                                                  "[1, 2, 3]",
                                                  "[[method]]\n",
                                                  "\"1 GPa\""};

using Random = std::mt19937_64;

std::size_t below(Random &random, std::size_t n) { return n == 0 ? 0 : random() % n; }

/// One random change: a byte, a piece put in, a stretch removed, doubled or moved, a line removed.
std::string mutate(std::string text, Random &random) {
  const std::size_t at = below(random, text.size() + 1);
  const std::size_t length = below(random, std::min<std::size_t>(text.size() - at, 30) + 1);
  switch (below(random, 6)) {
  case 0:
    if (at < text.size())
      text[at] = static_cast<char>(random() & 0xFFU);
    return text;
  case 1:
    return text.insert(at, pieces[below(random, pieces.size())]);
  case 2:
    return text.erase(at, length);
  case 3:
    return text.insert(below(random, text.size() + 1), text.substr(at, length));
  case 4: {
    const auto begin = text.rfind('\n', at);
    const auto end = text.find('\n', at);
    return begin == std::string::npos || end == std::string::npos || begin >= end ? text
                                                                                  : text.erase(begin, end - begin);
  }
  default: {
    // The value of a key becomes another.
    const auto equals = text.find("= ", at);
    const auto end = equals == std::string::npos ? equals : text.find('\n', equals);
    return end == std::string::npos ? text
                                    : text.replace(equals + 2, end - equals - 2, pieces[below(random, pieces.size())]);
  }
  }
}

} // namespace

// Whatever the text, there is a scene or a finding; nothing is thrown and nothing crashes.
TEST(SceneMutations, NeverCrashNorThrow) {
  Random random(20080617);
  constexpr int n_texts = 6000;
  int n_valid = 0;
  for (int i = 0; i < n_texts; ++i) {
    std::string text = valid_scene();
    const std::size_t n_changes = 1 + below(random, 6);
    for (std::size_t j = 0; j < n_changes; ++j)
      text = mutate(std::move(text), random);
    ASSERT_NO_THROW({
      const auto result = read(text);
      ASSERT_EQ(result.scene.has_value(), !result.diagnostics.has_errors()) << text;
      for (const auto &diagnostic : result.diagnostics.all())
        ASSERT_FALSE(diagnostic.message.empty()) << text;
      if (result.scene) {
        ++n_valid;
        ASSERT_NO_THROW(to_json(*result.scene).dump()) << text;
      }
    }) << text;
  }
  // Both outcomes are met often enough to mean something.
  EXPECT_GT(n_valid, n_texts / 100);
  EXPECT_LT(n_valid, n_texts / 2);
}

TEST(SceneMutations, OverridesNeverCrashNorThrow) {
  Random random(42);
  const std::vector<std::string> overrides{
      "material.nu=0.3",     "study.levels=[\"16x4\"]", "method.particles.support=[4, 5]",
      "method.1.element=Q1", "problem.corner=[0, 1]",   "effects.inertia=true"};
  for (int i = 0; i < 3000; ++i) {
    std::string text = overrides[below(random, overrides.size())];
    const std::size_t n_changes = 1 + below(random, 4);
    for (std::size_t j = 0; j < n_changes; ++j)
      text = mutate(std::move(text), random);
    ASSERT_NO_THROW({
      const auto result = read(valid_scene(), {text});
      ASSERT_EQ(result.scene.has_value(), !result.diagnostics.has_errors()) << text;
    }) << text;
  }
}
