#include "comparisons/scene/diagnostics.h"
#include "comparisons/scene/parameters.h"

#include <gtest/gtest.h>

#include <stdexcept>

using namespace comparisons::scene;

TEST(SceneDiagnostics, TextNamesPlaceKeyAndRemedy) {
  const Diagnostic full{Severity::error, {"a.toml", 3, 7}, "material.nu", "0.7 is out of range", "write 0.3"};
  EXPECT_EQ(to_text(full), "a.toml:3:7: error: material.nu: 0.7 is out of range (write 0.3)");
  const Diagnostic bare{Severity::warning, {}, {}, "odd", {}};
  EXPECT_EQ(to_text(bare), "warning: odd");
  const Diagnostic no_line{Severity::error, {"--set nu=1", 0, 0}, "nu", "odd", {}};
  EXPECT_EQ(to_text(no_line), "--set nu=1: error: nu: odd");
}

TEST(SceneDiagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics;
  diagnostics.warning({}, "a", "b");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.error({}, "a", "b");
  EXPECT_TRUE(diagnostics.has_errors());
  EXPECT_EQ(to_text(diagnostics), "warning: a: b\nerror: a: b\n");
}

TEST(SceneDiagnostics, ManyFindingsAreCutShort) {
  Diagnostics diagnostics;
  for (std::size_t i = 0; i < 3 * Diagnostics::limit; ++i)
    diagnostics.error({}, {}, "wrong");
  EXPECT_EQ(diagnostics.all().size(), Diagnostics::limit + 1);
  EXPECT_EQ(diagnostics.all().back().message, "more than 1000 findings; the rest is left out");
}

TEST(SceneDiagnostics, NearestName) {
  const std::vector<std::string> names{"weak1", "weak2", "strong", "fem", "plate_with_hole", "E", "nu"};
  EXPECT_EQ(nearest_name("wek2", names), "weak2");
  EXPECT_EQ(nearest_name("Strong", names), "strong");
  EXPECT_EQ(nearest_name("srtong", names), "strong");
  EXPECT_EQ(nearest_name("fme", names), "fem");
  EXPECT_EQ(nearest_name("e", names), "E");
  EXPECT_EQ(nearest_name("hole", names), "plate_with_hole");
  EXPECT_EQ(nearest_name("plate", names), "plate_with_hole");
  EXPECT_EQ(nearest_name("x", names), "");
  EXPECT_EQ(nearest_name("hexahedron", names), "");
  EXPECT_EQ(nearest_name("", names), "");
  EXPECT_EQ(nearest_name(std::string(1000000, 'a'), names), "");
  EXPECT_EQ(nearest_name("a", {}), "");
}

TEST(SceneDiagnostics, QuotedTextIsPrintableAndShort) {
  EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
  EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
  // Never cut inside a character of two bytes.
  std::string text(59, 'x');
  EXPECT_EQ(in_quotes(text + "\xC3\xA9\xC3\xA9"), "'" + text + "...'");
}

TEST(SceneParameters, AccessByType) {
  Parameters parameters;
  parameters.add({{.name = "order", .meaning = ""}, std::int64_t{2}, true, {"a", 1, 2}});
  parameters.add({{.name = "support", .meaning = ""}, 4.0, false, {}});
  parameters.add({{.name = "kernel", .meaning = ""}, std::string("gauss"), false, {}});
  parameters.add({{.name = "corner", .meaning = ""}, Point{0, 1}, false, {}});
  parameters.add({{.name = "scaled", .meaning = ""}, true, false, {}});
  EXPECT_EQ(parameters.integer("order"), 2);
  EXPECT_EQ(parameters.real("support"), 4.0);
  EXPECT_EQ(parameters.text("kernel"), "gauss");
  EXPECT_EQ(parameters.point("corner"), (Point{0, 1}));
  EXPECT_TRUE(parameters.boolean("scaled"));
  EXPECT_TRUE(parameters.is_given("order"));
  EXPECT_FALSE(parameters.is_given("support"));
  EXPECT_FALSE(parameters.is_given("absent"));
  EXPECT_EQ(parameters.location("order"), (Location{"a", 1, 2}));
  EXPECT_EQ(parameters.location("support"), Location{});
  EXPECT_FALSE(parameters.has("absent"));
  EXPECT_THROW(parameters.real("absent"), std::logic_error);
  EXPECT_THROW(parameters.real("order"), std::logic_error);
  EXPECT_THROW(parameters.add({{.name = "order", .meaning = ""}, 1.0, false, {}}), std::logic_error);
}

TEST(SceneParameters, ValuesAsText) {
  EXPECT_EQ(to_text(Value(4.0)), "4");
  EXPECT_EQ(to_text(Value(0.33)), "0.33");
  EXPECT_EQ(to_text(Value(1e-6)), "1e-06");
  EXPECT_EQ(to_text(Value(std::int64_t{7})), "7");
  EXPECT_EQ(to_text(Value(Point{0, 1})), "[0, 1]");
  EXPECT_EQ(to_text(Value(true)), "true");
  EXPECT_EQ(to_text(Value("Q2")), "Q2");
}
