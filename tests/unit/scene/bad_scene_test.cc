#include "small_vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace comparisons::scene;
using scene_tests::findings;
using scene_tests::read;
using scene_tests::valid_scene;
using scene_tests::with;

namespace {

/// One change of the valid scene and the whole of its only finding.
struct BadInput {
  std::string name;
  std::string from;
  std::string to;
  std::string finding;
};

class SceneBadInput : public testing::TestWithParam<BadInput> {};

TEST_P(SceneBadInput, IsFoundWithPlaceAndRemedy) {
  const auto &[name, from, to, finding] = GetParam();
  const auto result = read(with(from, to));
  EXPECT_FALSE(result.scene.has_value());
  EXPECT_EQ(to_text(result.diagnostics), "beam.toml" + finding + "\n");
}

const std::string method_keys = "order, support, kernel, scaled, penalty, name, label, levels, expect";
const std::string two_counts = "two counts such as \"16x4\" or [16, 4], or a spacing such as \"5 mm\"";

std::vector<BadInput> bad_keys() {
  return {
      {"unknown_key", "support = 4", "suport = 4",
       ":15:1: error: method[0].suport: unknown key 'suport' in particles; allowed: " + method_keys +
           " (did you mean 'support'?)"},
      {"key_of_another_table", "support = 4", "nu = 4",
       ":15:1: error: method[0].nu: unknown key 'nu' in particles; allowed: " + method_keys +
           " ('nu' belongs to [material])"},
      {"key_of_another_method", "element = \"Q1\"", "support = 4",
       ":19:1: error: method[1].support: unknown key 'support' in fem; allowed: element, name, label, levels, expect "
       "('support' belongs to [[method]] with name = particles)"},
      {"key_below_the_wrong_header", "nu = 0.3", "title = \"x\"",
       ":8:1: error: material.title: unknown key 'title' in [material]; allowed: E, nu, model "
       "('title' belongs to the top of the file, before the first table)"},
      {"unknown_top_key", "title =", "titel =",
       ":2:1: error: titel: unknown key 'titel' in the top of the file; allowed: schema, title, "
       "benchmark, problem, material, effects, time, method, study, output (did you mean 'title'?)"},
      {"unknown_table", "[material]", "[materials]",
       ":6:2: error: unknown table 'materials'; allowed: problem, material, effects, time, method, study, "
       "output (did you mean 'material'?)"},
      {"missing_schema", "schema = 1\n", "\n",
       ": error: schema: the required key 'schema' is missing (write schema = 1)"},
      {"wrong_schema", "schema = 1", "schema = 2",
       ":1:10: error: schema: schema 2 is unknown; this version reads schema 1 (write schema = 1)"},
      {"missing_benchmark", "benchmark = \"beam\"", "",
       ": error: benchmark: the required key 'benchmark' is missing; allowed: beam, bar"},
      {"unknown_benchmark", "\"beam\"", "\"beem\"",
       ":3:13: error: benchmark: unknown benchmark 'beem'; allowed: beam, bar (did you mean 'beam'?)"},
      {"missing_name", "name = \"fem\"\nelement = \"Q1\"", "",
       ":17:1: error: method[1].name: the required key 'name' is missing; allowed: particles, fem, "
       "interpolation"},
      {"missing_required_key", "name = \"fem\"\nelement = \"Q1\"", "name = \"interpolation\"",
       ":17:1: error: method[1].file: the required key 'file' is missing: a file"},
      {"missing_levels", "levels = [\"16x4\", \"31x7\"]\n", "",
       ":20:1: error: study.levels: the required key 'levels' is missing; a level is " + two_counts +
           " (write in [study], for example, levels = [\"16x4\"])"},
      {"control_characters_in_a_title", "\"A beam\"", "\"A\\nbeam\"",
       ":2:9: error: title: a title is one line without control characters"},
  };
}

std::vector<BadInput> bad_names() {
  return {
      {"unknown_method", "name = \"particles\"\norder = 2\nsupport = 4\nkernel = \"gauss\"", "name = \"particels\"",
       ":13:8: error: method[0].name: unknown method 'particels'; allowed: particles, fem, "
       "interpolation (did you mean 'particles'?)"},
      {"unknown_kernel", "\"gauss\"", "\"gaus\"",
       ":16:10: error: method[0].kernel: unknown kernel 'gaus'; allowed: gauss, super_gauss "
       "(did you mean 'gauss'?)"},
      {"unknown_element", "\"Q1\"", "\"Q9\"",
       ":19:11: error: method[1].element: unknown element 'Q9'; allowed: Q1, Q2, Q3 "
       "(did you mean 'Q1'?)"},
      {"unknown_effect", "elasticity = true", "elasticty = true",
       ":11:1: error: effects.elasticty: unknown key 'elasticty' in [effects]; allowed: elasticity, "
       "body_force, inertia, heat_conduction (did you mean 'elasticity'?)"},
      {"unknown_format", "\"vtu\"", "\"vtk\"",
       ":25:20: error: output.formats: unknown format 'vtk'; allowed: text, json, csv, md, vtu "
       "(did you mean 'vtu'?)"},
      {"format_twice", "\"vtu\"", "\"text\"",
       ":25:20: error: output.formats: the format 'text' stands twice (remove one of them)"},
      {"empty_formats", "[\"text\", \"vtu\"]", "[]",
       ":25:11: error: output.formats: an empty list of formats; allowed: text, json, csv, md, vtu"},
      {"later_analysis", "repeats = 5", "analysis = \"modes\"",
       ":22:12: error: study.analysis: unknown analysis 'modes'; allowed: static"},
      {"wrong_expectation", "element = \"Q1\"", "expect = \"refuse\"",
       ":19:10: error: method[1].expect: unknown expect 'refuse'; allowed: ok, refused, failed "
       "(did you mean 'refused'?)"},
      {"effect_that_nobody_has", "elasticity = true", "elasticity = true\nheat_conduction = true",
       ":12:1: error: effects.heat_conduction: no listed method can do the effect 'heat_conduction' "
       "(no method of this version can)"},
      {"effect_of_methods_not_listed",
       "elasticity = true\n[[method]]\nname = \"particles\"\norder = 2\nsupport = 4\nkernel = \"gauss\"",
       "elasticity = true\nbody_force = true",
       ":12:1: error: effects.body_force: no listed method can do the effect 'body_force' "
       "(methods that can: particles)"},
      {"no_effect_at_all", "elasticity = true", "elasticity = false",
       ":10:1: error: effects: the scene calls for no effect; nothing would be computed "
       "(write elasticity = true, or remove the table)"},
      {"effect_with_parameters", "elasticity = true", "elasticity = true\ninertia = {linear = 1}",
       ":12:11: error: effects.inertia: the effect 'inertia' has no parameters (write inertia = true in [effects])"},
      {"effect_parameter_unknown", "elasticity = true", "elasticity = true\nbody_force = {fakter = 1}",
       ":12:15: error: effects.body_force.fakter: unknown key 'fakter' in [effects.body_force]; allowed: factor (did "
       "you mean 'factor'?)"},
      {"effect_parameter_out_of_range", "elasticity = true", "elasticity = true\nbody_force = {factor = -1}",
       ":12:24: error: effects.body_force.factor: -1 is out of range; it must be at least 0"},
      {"time_of_a_static_benchmark", "[study]", "[time]\nend = 1\n[study]",
       ":20:1: error: time: the benchmark 'beam' knows no time (remove this table)"},
      {"effect_of_wrong_type", "elasticity = true", "elasticity = true\ninertia = 1",
       ":12:11: error: effects.inertia: expected true or false, found the whole number 1"},
  };
}

std::vector<BadInput> bad_values() {
  return {
      {"no_unit", "\"226.9 GPa\"", "\"226.9\"",
       ":7:5: error: material.E: '226.9' has no unit (write \"226.9 GPa\" or the bare number 226.9e9 "
       "in SI)"},
      {"no_unit_of_a_length", "\"8 m\"", "\"8\"",
       ":5:10: error: problem.length: '8' has no unit (write \"8 m\" or the bare number 8 in SI)"},
      {"wrong_dimension", "\"226.9 GPa\"", "\"226.9 mm\"",
       ":7:5: error: material.E: '226.9 mm' is a length [m]; expected a pressure [Pa] (write for "
       "example \"1 GPa\")"},
      {"unit_of_a_plain_number", "nu = 0.3", "nu = \"0.3 m\"",
       ":8:6: error: material.nu: '0.3 m' is a length [m]; expected a plain number (write the number "
       "without a unit)"},
      {"unknown_unit", "\"226.9 GPa\"", "\"226.9 Gpa\"",
       ":7:5: error: material.E: unknown unit 'Gpa'; expected a pressure (a text such as \"1 GPa\", "
       "or a number in SI) (did you mean 'GPa'?)"},
      {"wrong_type", "\"226.9 GPa\"", "true",
       ":7:5: error: material.E: expected a pressure (a text such as \"1 GPa\", or a number in SI), "
       "found true"},
      {"nu_too_large", "nu = 0.3", "nu = 0.7",
       ":8:6: error: material.nu: 0.7 is out of range; it must be in (-1, 0.5]"},
      {"nu_too_small", "nu = 0.3", "nu = -1", ":8:6: error: material.nu: -1 is out of range; it must be in (-1, 0.5]"},
      {"incompressible_plane_strain", "nu = 0.3", "nu = 0.5",
       ":8:6: error: material.nu: nu = 0.5 in plane strain needs a mixed method"},
      {"E_zero", "\"226.9 GPa\"", "0", ":7:5: error: material.E: 0 Pa is out of range; it must be greater than 0"},
      {"E_negative", "\"226.9 GPa\"", "\"-1 GPa\"",
       ":7:5: error: material.E: '-1 GPa' is out of range; it must be greater than 0"},
      {"not_a_number", "nu = 0.3", "nu = nan", ":8:6: error: material.nu: nan is not a finite number"},
      {"infinite", "\"226.9 GPa\"", "inf", ":7:5: error: material.E: inf is not a finite number"},
      {"support_too_small", "support = 4", "support = 1.5",
       ":15:11: error: method[0].support: the support is too small for the order"},
      {"integer_as_real", "order = 2", "order = 2.0",
       ":14:9: error: method[0].order: expected a whole number, found the number 2.0 (write 2)"},
      {"integer_as_text", "order = 2", "order = \"2\"",
       ":14:9: error: method[0].order: expected a whole number, found the text '2' (write it without "
       "quotes)"},
      {"integer_out_of_range", "order = 2", "order = 7",
       ":14:9: error: method[0].order: 7 is out of range; it must be from 1 to 4"},
      {"flag_as_text", "order = 2", "scaled = \"true\"",
       ":14:10: error: method[0].scaled: expected true or false, found the text 'true' (write true "
       "without quotes)"},
      {"text_as_number", "title = \"A beam\"", "title = 12",
       ":2:9: error: title: expected a text in quotes, found the whole number 12 (write \"12\")"},
      {"date", "repeats = 5", "repeats = 2024-01-01",
       ":22:11: error: study.repeats: expected a whole number, found a date or time"},
      {"point_of_three", "length = \"8 m\"", "corner = [1, 2, 3]",
       ":5:10: error: problem.corner: expected a point of two numbers [x, y], found a list"},
      {"point_with_a_wrong_part", "length = \"8 m\"", "corner = [1, \"2 s\"]",
       ":5:14: error: problem.corner: '2 s' is a time [s]; expected a length [m] (write for example "
       "\"1 m\")"},
      {"list_in_the_material", "nu = 0.3", "nu = [0.3, 0.4]",
       ":8:6: error: material.nu: found a list; this key takes one value (lists are for the keys of "
       "[[method]] and [problem])"},
      {"empty_list", "order = 2", "order = []",
       ":14:9: error: method[0].order: an empty list; give at least one value"},
      {"value_twice", "order = 2", "order = [2, 3, 2]",
       ":14:16: error: method[0].order: the value 2 stands twice (remove one of them)"},
      {"wrong_value_in_a_list", "order = 2", "order = [2, \"three\"]",
       ":14:13: error: method[0].order: expected a whole number, found the text 'three'"},
      {"repeats", "repeats = 5", "repeats = 0",
       ":22:11: error: study.repeats: 0 is out of range; it must be from 1 to 1000"},
      {"threads", "repeats = 5", "threads = -1",
       ":22:11: error: study.threads: -1 is out of range; it must be from 1 to 1024"},
      {"seed", "repeats = 5", "seed = -1", ":22:8: error: study.seed: -1 is out of range; it must be at least 0"},
      {"max_seconds", "repeats = 5", "max_seconds = 0",
       ":22:15: error: study.max_seconds: 0 s is out of range; it must be greater than 0"},
      {"max_memory", "\"4 GiB\"", "\"4 Gib\"",
       ":23:14: error: study.max_memory: unknown unit 'Gib' of memory; allowed: GiB, MiB, KiB, TiB, "
       "GB, MB, kB, TB, B (did you mean 'GiB'?)"},
      {"empty_directory", "formats = [\"text\", \"vtu\"]", "directory = \"\"",
       ":25:13: error: output.directory: the directory's name is empty (write for example \"out\")"},
  };
}

std::vector<BadInput> bad_levels() {
  const std::string from = "[\"16x4\", \"31x7\"]";
  const std::string allowed = "; allowed: " + two_counts;
  return {
      {"zero", from, "[\"16x4\", \"0x4\"]",
       ":21:19: error: study.levels: a count of 0 in a level; a count is from 2 to 1000000000"},
      {"negative", from, "[[16, -4]]",
       ":21:11: error: study.levels: a count of -4 in a level; a count is from 2 to 1000000000"},
      {"too_large", from, "[\"16x99999999999999999999999\"]",
       ":21:11: error: study.levels: a count of 1000000001 in a level; a count is from 2 to 1000000000"},
      {"one_count", from, "[188]",
       ":21:11: error: study.levels: a level of 1 count; beam takes 2 a level (write for example "
       "\"16x4\")"},
      {"three_counts", from, "[\"2x3x4\"]",
       ":21:11: error: study.levels: a level of 3 counts; beam takes 2 a level (write for example "
       "\"16x4\")"},
      {"ambiguous", from, "[16, 4]",
       ":21:10: error: study.levels: [16, 4] may mean one level of 16 by 4 or two levels; beam takes "
       "two counts a level (write [[16, 4]] or [\"16x4\"])"},
      {"empty", from, "[]", ":21:10: error: study.levels: an empty list of levels; a level is " + two_counts},
      {"twice", from, "[\"16x4\", [16, 4]]",
       ":21:19: error: study.levels: the level 16x4 stands twice (remove one of them)"},
      {"spacing_twice", from, "[\"5 mm\", \"0.5 cm\"]",
       ":21:19: error: study.levels: the level 0.005 m stands twice (remove one of them)"},
      {"spacing_zero", from, "[\"0 mm\"]",
       ":21:11: error: study.levels: a spacing of '0 mm'; a spacing is greater than 0"},
      {"spacing_of_wrong_dimension", from, "[\"5 ms\"]",
       ":21:11: error: study.levels: '5 ms' is a time; a spacing is a length (write for example \"5 "
       "mm\")"},
      {"text_without_unit", from, "[\"5\"]",
       ":21:11: error: study.levels: '5' has no unit" + allowed +
           " (a count is written without quotes, a spacing \"5 m\")"},
      {"real", from, "[0.005]",
       ":21:11: error: study.levels: the number 0.005 is no level" + allowed +
           " (a spacing is written with its unit: \"0.005 m\")"},
      {"real_count", from, "[188.0]",
       ":21:11: error: study.levels: the number 188.0 is no level" + allowed + " (a count is written 188)"},
      {"nonsense", from, "[\"fine\"]",
       ":21:11: error: study.levels: 'fine' is no level: 'fine' does not begin with a finite number" + allowed +
           " (write a number and a unit, for example \"226.9 GPa\")"},
      {"of_a_method", "element = \"Q1\"", "levels = [\"1x4\"]",
       ":19:11: error: method[1].levels: a count of 1 in a level; a count is from 2 to 1000000000"},
      {"refused_by_the_benchmark", from, "[\"16x4\", \"1001x4\"]",
       ": error: study.levels: the level is finer than the beam allows"},
  };
}

std::vector<BadInput> bad_methods() {
  return {
      {"same_method_twice", "name = \"fem\"\nelement = \"Q1\"", "name = \"particles\"",
       ":17:1: error: method[1].label: the label 'particles' stands twice (first in method[0]) (the "
       "two methods are the same; remove one)"},
      {"same_label", "name = \"fem\"\nelement = \"Q1\"", "name = \"particles\"\nsupport = 5",
       ":17:1: error: method[1].label: the label 'particles' stands twice (first in method[0]) (tell "
       "them apart, for example label = \"particles support=5\")"},
      {"given_label_twice", "element = \"Q1\"", "label = \"particles\"",
       ":19:9: error: method[1].label: the label 'particles' stands twice (first in method[0]) (tell "
       "them apart, for example label = \"fem element=Q2\")"},
      {"empty_label", "element = \"Q1\"", "label = \"\"",
       ":19:9: error: method[1].label: a label is one line and not empty"},
      {"check_that_throws", "name = \"fem\"\nelement = \"Q1\"", "name = \"interpolation\"\nfile = \"a\"",
       ":17:1: error: the check of interpolation failed: boom"},
  };
}

const auto print_name = [](const testing::TestParamInfo<BadInput> &info) { return info.param.name; };

INSTANTIATE_TEST_SUITE_P(Keys, SceneBadInput, testing::ValuesIn(bad_keys()), print_name);
INSTANTIATE_TEST_SUITE_P(Names, SceneBadInput, testing::ValuesIn(bad_names()), print_name);
INSTANTIATE_TEST_SUITE_P(Values, SceneBadInput, testing::ValuesIn(bad_values()), print_name);
INSTANTIATE_TEST_SUITE_P(Levels, SceneBadInput, testing::ValuesIn(bad_levels()), print_name);
INSTANTIATE_TEST_SUITE_P(Methods, SceneBadInput, testing::ValuesIn(bad_methods()), print_name);

const std::string head = "schema = 1\nbenchmark = \"beam\"\nstudy.levels = [\"16x4\"]\n";

} // namespace

TEST(SceneBadScene, MethodsThatAreNoList) {
  const std::string add = "(add [[method]] and below it name = one of particles, fem, interpolation)\n";
  EXPECT_EQ(findings(head), "beam.toml: error: method: the scene has no [[method]] " + add);
  EXPECT_EQ(findings(head + "method = []\n"), "beam.toml:4:10: error: method: the list of methods is empty " + add);
  EXPECT_EQ(findings(head + "[method]\nname = \"fem\"\n"),
            "beam.toml:4:1: error: method: [method] is a single table; methods are a list (write "
            "[[method]])\n");
  EXPECT_EQ(findings(head + "method = [1]\n"),
            "beam.toml:4:11: error: method[0]: expected a table, found the whole number 1 (write "
            "[[method]])\n");
  EXPECT_EQ(findings(head + "method = 1\n"),
            "beam.toml:4:10: error: method: expected a list of tables [[method]], found the whole "
            "number 1\n");
}

TEST(SceneBadScene, TablesOfALaterVersionAreExplained) {
  const std::string tail = " belongs to a geometry of one's own (add [geometry] with file = \"...\", or remove this "
                           "table)\n";
  EXPECT_EQ(findings("schema = 1\nbenchmark = \"beam\"\n[[boundary]]\ngroup = \"b\"\n[[material]]\n"
                     "E = 1\n[[method]]\nname = \"fem\"\nlevels = [\"5 mm\"]\n"),
            "beam.toml:3:3: error: boundary: the table 'boundary'" + tail +
                "beam.toml:5:3: error: material: several materials belong to a geometry of one's own (write [material] "
                "and its keys below, or add [geometry] with file = \"...\")\n");
}

TEST(SceneBadScene, TablesThatAreNone) {
  const std::string text = "schema = \"1\"\ntitle = []\nbenchmark = \"beam\"\nproblem = 1\nmaterial = 2\n"
                           "effects = 3\nmethod = 4\nstudy = 5\noutput = 6\n";
  const auto result = read(text);
  ASSERT_FALSE(result.scene.has_value());
  std::vector<unsigned> lines;
  for (const auto &diagnostic : result.diagnostics.all())
    if (diagnostic.location.line > 0)
      lines.push_back(diagnostic.location.line);
  EXPECT_EQ(lines, (std::vector<unsigned>{1, 2, 4, 5, 6, 7, 8, 9})) << to_text(result.diagnostics);
}

TEST(SceneBadScene, TenErrorsGiveTenFindingsInTheOrderOfTheFile) {
  const auto result = read(R"(schema = 1
titel = "A beam"
benchmark = "beam"
[problem]
length = "8 GPa"
[material]
E = "226.9"
nu = 0.7
[effects]
elasticity = true
heat_conduction = true
[[method]]
name = "particles"
order = 3
support = 2
kernel = "gaus"
[[method]]
name = "fem"
element = "Q9"
[study]
levels = ["16x4", "0x4"]
[output]
formats = ["vtk"]
)");
  EXPECT_FALSE(result.scene.has_value());
  std::vector<std::pair<unsigned, unsigned>> places;
  for (const auto &diagnostic : result.diagnostics.all())
    places.emplace_back(diagnostic.location.line, diagnostic.location.column);
  EXPECT_EQ(places, (std::vector<std::pair<unsigned, unsigned>>{
                        {2, 1}, {5, 10}, {7, 5}, {8, 6}, {11, 1}, {15, 11}, {16, 10}, {19, 11}, {21, 19}, {23, 12}}))
      << to_text(result.diagnostics);
}

TEST(SceneBadScene, ChecksSeeTheEffects) {
  const std::string text = with("length = \"8 m\"", "jitter = 0.5");
  EXPECT_EQ(findings(text), "beam.toml:5:10: error: problem.jitter: 0.5 needs two effects\n");
  EXPECT_EQ(findings(text, {"effects.inertia=true"}), "");
}

// A wrong level must not hide what a method's check says about other keys.
TEST(SceneBadScene, ChecksRunDespiteOtherFindings) {
  std::string text = with("support = 4", "support = 1");
  text.replace(text.find("[\"16x4\", \"31x7\"]"), 16, "[\"0x4\"]        ");
  const std::string found = findings(text);
  EXPECT_NE(found.find(":15:11: error: method[0].support: the support is too small"), std::string::npos) << found;
  EXPECT_NE(found.find(":21:11: error: study.levels"), std::string::npos) << found;
}

// ... but a default that replaces a wrong value is not the author's fault.
TEST(SceneBadScene, ChecksDoNotBlameDefaults) {
  const std::string found =
      findings(with("support = 4", "order = 4\nsupport = \"3.9.1\"")
                   .replace(with("support = 4", "order = 4\nsupport = \"3.9.1\"").find("order = 2\n"), 10, ""));
  EXPECT_EQ(std::ranges::count(found, '\n'), 1) << found;
}

TEST(SceneBadScene, TheSameFindingIsReportedOnce) {
  const std::string found = findings(with("support = 4", "support = 1\nscaled = [true, false]"));
  EXPECT_EQ(std::ranges::count(found, '\n'), 1) << found;
}

TEST(SceneBadScene, RequiredKeysOfTheBenchmark) {
  EXPECT_EQ(findings("schema = 1\nbenchmark = \"bar\"\n[[method]]\nname = \"fem\"\n[study]\nlevels = [8]\n"),
            "beam.toml: error: problem.mode: the required key 'mode' is missing: number of the mode\n"
            "beam.toml: error: material.density: the required key 'density' is missing: density, in "
            "kg/m^3\n");
  EXPECT_EQ(findings("schema = 1\nbenchmark = \"bar\"\nproblem.mode = 1\nmaterial.density = 1\n[[method]]\n"
                     "name = \"fem\"\n[study]\nlevels = [[16, 4]]\n"),
            "beam.toml:8:11: error: study.levels: a level of 2 counts; bar takes 1 a level (write for "
            "example 188)\n");
}

TEST(SceneBadScene, TooManyCellsAreRefusedBeforeTheyAreMade) {
  std::string list = "[";
  for (int i = 0; i < 1000; ++i)
    list += std::to_string(i + 4) + ",";
  list += "]";
  const std::string found = findings(with("support = 4\n", "support = " + list + "\npenalty = " + list + "\n"));
  EXPECT_EQ(found, "beam.toml: error: the scene has 2000002 cells (problems x methods x levels); at "
                   "most 100000 (shorten the lists)\n");
}
