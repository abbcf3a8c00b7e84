// Every bad input of the scenes in bad_scenes: exit code 3, the place, what was found, what is allowed, a suggestion
// for near misses, all errors of a file in one pass, and nothing written.

#include "system/program_here.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace {

using namespace system_tests;

fs::path bad_scenes() { return fs::path(PETROV_SOURCE_DIR) / "tests/system/bad_scenes"; }

/// What each file must be told beyond place and key: the value found, what is allowed, a near miss or a remedy.
const std::map<std::string, std::vector<std::string>> &words_of_messages() {
  static const std::map<std::string, std::vector<std::string>> words{
      {"E_not_positive", {"0 Pa is out of range", "greater than 0"}},
      {"effect_that_no_method_has", {"no listed method can do the effect 'heat_conduction'"}},
      {"ellipses_shrunk", {"elliptic supports", "subdomains = \"whole\""}},
      {"empty_method_list", {"[[method]]", "strong, weak1, weak2, hybrid, mixed, fem"}},
      {"level_of_zero", {"a count of 0", "from 2 to"}},
      {"missing_unit", {"'226.9' has no unit", "\"226.9 GPa\"", "226.9e9"}},
      {"negative_count", {"-16", "from 2 to"}},
      {"no_method", {"no [[method]]", "strong, weak1, weak2, hybrid, mixed, fem"}},
      {"nu_incompressible_in_plane_strain", {"0.5 is incompressible", "(-1, 0.5)", "plane stress"}},
      {"nu_minus_one", {"-1 is out of range", "(-1, 0.5]"}},
      {"nu_out_of_range", {"0.51 is out of range", "(-1, 0.5]"}},
      {"support_too_small", {"reaches 3 spacings", "order 4", "more than 4", "support = 6"}},
      {"ten_errors",
       {"did you mean 'title'?", "did you mean 'heat_conduction'?", "did you mean 'weak1'?", "did you mean 'support'",
        "did you mean 'json'?", "Q1, Q2, Q3, Q4", "expected a whole number, found the number 2"}},
      {"unknown_benchmark", {"'cantilevr'", "did you mean 'cantilever'?"}},
      {"unknown_element", {"'Q9'", "Q1, Q2, Q3, Q4"}},
      {"unknown_kernel", {"'gaus'", "revised_super_gauss", "did you mean 'gauss'?"}},
      {"unknown_key", {"'suport'", "order", "did you mean 'support'?"}},
      {"unknown_method", {"'waek1'", "strong, weak1, weak2, hybrid, mixed, fem", "did you mean 'weak1'?"}},
      {"unwritable_directory", {"/proc/petrov", "cannot create the output directory"}},
      {"wrong_syntax", {"226.9 GPa"}},
      {"wrong_unit", {"'226.9 mm' is a length [m]", "expected a pressure [Pa]"}},
  };
  return words;
}

/// "6:5 material.E; 7:6 material.nu" of the first line, as ":6:5: error: material.E" ...
std::vector<std::string> expected_places(const std::string &text) {
  const std::string mark = "# expected: ";
  const auto end = text.find('\n');
  if (!text.starts_with(mark))
    throw std::runtime_error("a bad scene begins with '# expected: '");
  std::istringstream list(text.substr(mark.size(), end - mark.size()));
  std::vector<std::string> places;
  for (std::string item; std::getline(list, item, ';');) {
    std::istringstream words(item);
    std::string place;
    std::string key;
    words >> place >> key;
    if (place.find(':') == std::string::npos) {
      key = place;
      place.clear();
    }
    places.push_back((place.empty() ? ": error: " : ":" + place + ": error: ") + key);
  }
  return places;
}

std::size_t count(const std::string &text, const std::string &part) {
  std::size_t n = 0;
  for (auto i = text.find(part); i != std::string::npos; i = text.find(part, i + 1))
    ++n;
  return n;
}

TEST(BadInput, every_bad_scene_is_refused_with_place_and_remedy) {
  std::size_t n_files = 0;
  for (const auto &entry : fs::directory_iterator(bad_scenes())) {
    const auto &file = entry.path();
    SCOPED_TRACE(file.filename().string());
    ++n_files;
    const Folder folder;
    std::vector<std::string> arguments{"run", file.string()};
    if (file.stem() != "unwritable_directory")
      arguments.insert(arguments.end(), {"--output", "out"});
    const auto answer = run_here(arguments, folder.path());
    EXPECT_EQ(answer.exit_code, 3);
    EXPECT_EQ(answer.out, "");
    EXPECT_FALSE(fs::exists(folder / "out"));
    const auto places = expected_places(contents(file));
    for (const auto &place : places)
      EXPECT_NE(answer.err.find(file.string() + place), std::string::npos) << place << " is not in\n" << answer.err;
    EXPECT_EQ(count(answer.err, ": error: "), places.size()) << answer.err;
    const auto words = words_of_messages().find(file.stem().string());
    ASSERT_NE(words, words_of_messages().end()) << "say above what its message must hold";
    for (const auto &word : words->second)
      EXPECT_NE(answer.err.find(word), std::string::npos) << "'" << word << "' is not in\n" << answer.err;
  }
  EXPECT_EQ(n_files, words_of_messages().size());
}

/// The same through the program, all files at once: the errors of every file are told, and nothing is run.
TEST(BadInput, the_program_tells_the_errors_of_all_files) {
  const Folder folder;
  std::vector<std::string> arguments{"run", "--output", "out"};
  std::vector<std::string> files;
  for (const auto &entry : fs::directory_iterator(bad_scenes()))
    if (entry.path().stem() != "unwritable_directory")
      files.push_back(entry.path().string());
  files.push_back(folder
                      .write("good.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n"
                                          "[study]\nlevels = [\"16x4\"]\n")
                      .string());
  arguments.insert(arguments.end(), files.begin(), files.end());
  const auto ended = run_program(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_EQ(ended.out, "");
  files.pop_back();
  for (const auto &file : files)
    EXPECT_NE(ended.err.find(file + ":"), std::string::npos) << file;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(BadInput, a_scene_that_is_no_file) {
  const Folder folder;
  fs::create_directory(folder / "folder.toml");
  folder.write("empty.toml", "");
  folder.write("bytes.toml", "schema = 1\n\xff\xfe\n");
  const std::vector<std::pair<std::string, std::string>> files{
      {"absent.toml", "absent.toml: error: no such file"},
      {"folder.toml", "folder.toml: error: is a directory"},
      {"empty.toml", "empty.toml: error: schema: the required key 'schema' is missing"},
      {"bytes.toml", "bytes.toml:2:1: error: the text is not UTF-8"}};
  for (const auto &[file, message] : files) {
    const auto ended = run_here({"run", file, "--output", "out"}, folder.path());
    EXPECT_EQ(ended.exit_code, 3) << file;
    EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(BadInput, an_output_directory_below_a_file) {
  const Folder folder;
  const std::string text = "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n[study]\n"
                           "levels = [\"16x4\"]\n[output]\ndirectory = \"scene.toml/out\"\n";
  folder.write("scene.toml", text);
  const auto scene = run_here({"run", "scene.toml"}, folder.path());
  EXPECT_EQ(scene.exit_code, 3);
  EXPECT_EQ(scene.out, "");
  EXPECT_NE(scene.err.find("scene.toml:8:13: error: output.directory: scene.toml/out: cannot create"),
            std::string::npos)
      << scene.err;
  const auto option = run_here({"run", "scene.toml", "--output", "scene.toml"}, folder.path());
  EXPECT_EQ(option.exit_code, 3);
  EXPECT_NE(option.err.find("error: output.directory: scene.toml: cannot create"), std::string::npos) << option.err;
  const auto comparison = run_here({"compare", "cantilever", "--output", "scene.toml/a/b"}, folder.path());
  EXPECT_EQ(comparison.exit_code, 3);
  EXPECT_NE(comparison.err.find("error: output.directory: scene.toml/a/b: cannot create"), std::string::npos)
      << comparison.err;
  EXPECT_EQ(contents(folder / "scene.toml"), text);
}

TEST(BadInput, overrides) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n[study]\n"
                             "levels = [\"16x4\"]\n");
  const std::vector<std::pair<std::string, std::string>> overrides{
      {"materal.nu=0.3", "did you mean 'material'?"},
      {"material.mu=0.3", "did you mean 'nu'?"},
      {"material.nu", "KEY=VALUE"},
      {"=3", "the key before '=' is empty"},
      {"method[5].order=2", "no method number '5'"},
      {"method.weak2.order=2", "weak2"},
      {"method[0].order=two", "expected a whole number, found the text 'two'"},
      {"method[0].order=[2", "no TOML value"},
      {"study.levels=[]", "study.levels"},
      {"study.levels=[\"31622x31622\"]", "1e+09 points; at most 2e7"},
      {"study.levels=[\"1e-9 m\"]", "points; at most 2e7"},
      {"study.levels=[\"1x1\"]", "study.levels"},
      {"study.repeats=1000000", "from 1 to 1000"},
      {"study.seed=-1", "at least 0"},
      {"method[0].support=21", "20"},
      {"problem.jitter=0.5", "0.49"},
      {"problem.force=0", "problem.force: 0"},
      {"study.max_memory=\"1e10 GB\"", "bytes"},
      {"output.directory=\"\"", "empty"},
  };
  for (const auto &[text, message] : overrides) {
    std::vector<std::string> arguments{"run", "scene.toml", "--set", text};
    if (!text.starts_with("output"))
      arguments.insert(arguments.end(), {"--output", "out"});
    const auto answer = run_here(arguments, folder.path());
    EXPECT_EQ(answer.exit_code, 3) << text;
    EXPECT_NE(answer.err.find(": error: "), std::string::npos) << answer.err;
    EXPECT_NE(answer.err.find(message), std::string::npos) << "'" << message << "' is not in " << answer.err;
    EXPECT_EQ(answer.out, "");
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
}

TEST(BadInput, options_that_are_no_text) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n[study]\n"
                             "levels = [\"16x4\"]\n");
  for (const std::string option : {"--output", "--format"}) {
    const auto answer = run_here({"run", "scene.toml", option, "o\xff"}, folder.path());
    EXPECT_EQ(answer.exit_code, 3) << option;
    EXPECT_EQ(answer.err, "error: " + option + ": the text is not UTF-8\n");
    EXPECT_EQ(answer.out, "");
  }
}

TEST(BadInput, usage_errors_end_with_2) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"weak1\"\n[study]\n"
                             "levels = [\"16x4\"]\n");
  const std::vector<std::pair<std::vector<std::string>, std::string>> calls{
      {{}, "run, compare, check, explain, list, init, report"},
      {{"comapre"}, "did you mean 'compare'?"},
      {{"run"}, "SCENE is required"},
      {{"run", "scene.toml", "--set"}, "--set"},
      {{"run", "scene.toml", "--threads", "0"}, "from 1 to 1024"},
      {{"run", "scene.toml", "--repeats", "many"}, "--repeats"},
      {{"run", "scene.toml", "--unknown"}, "--unknown"},
      {{"compare", "cantilevr"}, "did you mean 'cantilever'?"},
      {{"compare", "--quick", "--full"}, "--full"},
      {{"list", "metods"}, "methods, bases, kernels, effects, benchmarks"},
      {{"init", "cantilevr"}, "did you mean 'cantilever'?"}};
  for (const auto &[arguments, message] : calls) {
    const auto ended = run_here(arguments, folder.path());
    const std::string line = arguments.empty() ? "no argument" : arguments[0];
    EXPECT_EQ(ended.exit_code, 2) << line;
    EXPECT_EQ(ended.out, "") << line;
    EXPECT_NE(ended.err.find(message), std::string::npos) << line << ": " << ended.err;
    EXPECT_LT(ended.err.size(), 500u) << line << ": " << ended.err;
  }
  EXPECT_FALSE(fs::exists(folder / "out"));
}

} // namespace
