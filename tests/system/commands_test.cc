// The commands as a user types them, their texts and exit codes.

#include "comparisons/reports/json.h"
#include "comparisons/scene/reader.h"
#include "system/program_here.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace system_tests;
using namespace comparisons;

const std::string small_scene = "schema = 1\ntitle = \"A small scene\"\nbenchmark = \"cantilever\"\n[[method]]\n"
                                "name = \"strong\"\n[[method]]\nname = \"fem\"\nelement = [\"Q1\", \"Q2\"]\n"
                                "[study]\nlevels = [\"16x4\", \"31x7\"]\n";

bool has(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

TEST(Commands, help_and_version) {
  const Folder folder;
  const auto help = run_here({"--help"}, folder.path());
  EXPECT_EQ(help.exit_code, 0);
  for (const auto *word : {"run", "compare", "check", "explain", "list", "init", "report", "verify", "Exit codes"})
    EXPECT_TRUE(has(help.out, word)) << word;
  EXPECT_EQ(help.err, "");
  const auto version = run_program({"--version"}, folder.path());
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(version.out.starts_with("petrov ")) << version.out;
  const auto help_of_run = run_here({"run", "--help"}, folder.path());
  EXPECT_EQ(help_of_run.exit_code, 0);
  for (const auto *option :
       {"--output", "--format", "--set", "--threads", "--repeats", "--quiet", "--isolate", "--resume"})
    EXPECT_TRUE(has(help_of_run.out, option)) << option;
}

TEST(Commands, list) {
  const Folder folder;
  const std::vector<std::pair<std::string, std::vector<std::string>>> lists{
      {"methods", {"strong", "weak1", "weak2", "hybrid", "mixed", "fem"}},
      {"bases", {"ssph"}},
      {"kernels", {"gauss", "revised_super_gauss"}},
      {"effects", {"elasticity", "body_force", "inertia"}},
      {"benchmarks", {"cantilever", "hard_cases"}}};
  for (const auto &[what, names] : lists) {
    const auto ended = run_here({"list", what}, folder.path());
    EXPECT_EQ(ended.exit_code, 0) << what;
    EXPECT_EQ(ended.err, "");
    for (const auto &name : names)
      EXPECT_TRUE(has("\n" + ended.out, "\n" + name + " ")) << ended.out;
  }
}

TEST(Commands, init_writes_a_scene_that_is_valid_and_runs) {
  const Folder folder;
  const auto written = run_here({"init", "cantilever"}, folder.path());
  EXPECT_EQ(written.exit_code, 0) << written.err;
  ASSERT_TRUE(fs::exists(folder / "cantilever.toml"));
  const auto shown = run_here({"init", "cantilever", "-"}, folder.path());
  EXPECT_EQ(shown.exit_code, 0);
  EXPECT_EQ(shown.out, contents(folder / "cantilever.toml"));
  const auto check = run_here({"check", "cantilever.toml"}, folder.path());
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_TRUE(has(check.out, "cantilever.toml: valid"));
  EXPECT_FALSE(fs::exists(folder / "out")) << "check solves nothing";
  const auto run = run_here({"run", "cantilever.toml"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.out;
  // A user's file is not overwritten.
  folder.write("cantilever.toml", "mine");
  const auto again = run_here({"init", "cantilever"}, folder.path());
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_TRUE(has(again.err, "exists")) << again.err;
  EXPECT_EQ(contents(folder / "cantilever.toml"), "mine");
  EXPECT_EQ(run_here({"init", "cantilever", "no_folder/x.toml"}, folder.path()).exit_code, 3);
}

TEST(Commands, explain_names_effects_unknowns_cost_and_keys) {
  const Folder folder;
  folder.write("scene.toml", small_scene);
  const auto ended = run_here({"explain", "scene.toml", "--set", "study.max_memory=\"1 GiB\""}, folder.path());
  EXPECT_EQ(ended.exit_code, 0);
  for (const auto *word : {"A small scene", "effects called for", "elasticity", "effects absent", "heat_conduction",
                           "Fields allocated", "unknowns", "memory", "time", "434", "[problem]", "[material]",
                           "[study]", "[output]", "support", "Poisson's ratio"})
    EXPECT_TRUE(has(ended.out, word)) << word;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(Commands, every_shipped_scene_is_valid) {
  const Folder folder;
  std::vector<std::string> arguments{"check", "--quiet"};
  for (const char *folder_name : {"benchmarks", "examples"})
    for (const auto &entry :
         fs::recursive_directory_iterator(fs::path(PETROV_SOURCE_DIR) / "comparisons" / folder_name))
      if (entry.path().extension() == ".toml" && entry.path().filename() != "published.toml")
        arguments.push_back(entry.path().string());
  ASSERT_GT(arguments.size(), 60u);
  const auto ended = run_here(arguments, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(static_cast<std::size_t>(std::count(ended.out.begin(), ended.out.end(), '\n')), arguments.size() - 2);
}

/// The scene of the README and the commands that it names with it.
TEST(Commands, the_scene_of_the_readme_is_valid) {
  const std::string readme = contents(fs::path(PETROV_SOURCE_DIR) / "README.md");
  const std::string fence = "```toml\n";
  const auto begin = readme.find(fence);
  ASSERT_NE(begin, std::string::npos);
  const auto end = readme.find("```", begin + fence.size());
  const Folder folder;
  folder.write("scene.toml", readme.substr(begin + fence.size(), end - begin - fence.size()));
  const auto check = run_here({"check", "scene.toml"}, folder.path());
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_EQ(check.err, "");
  // Its overrides, as they stand there.
  std::size_t n_overrides = 0;
  for (auto place = readme.find("`--set "); place != std::string::npos; place = readme.find("`--set ", place + 1)) {
    std::string text = readme.substr(place + 7, readme.find('`', place + 1) - place - 7);
    std::erase(text, '\''); // the shell's
    ++n_overrides;
    const auto changed = run_here({"check", "scene.toml", "--set", text}, folder.path());
    EXPECT_EQ(changed.exit_code, 0) << changed.err;
  }
  EXPECT_GE(n_overrides, 3u);
}

TEST(Commands, the_readme_names_every_key) {
  const std::string readme = contents(fs::path(PETROV_SOURCE_DIR) / "README.md");
  const auto vocabulary = study::vocabulary_of(study::shipped_catalogue());
  const auto expect_named = [&](const std::vector<scene::Declaration> &declarations) {
    for (const auto &declaration : declarations)
      EXPECT_TRUE(has(readme, "`" + declaration.name + "`")) << declaration.name;
  };
  for (const auto &method : vocabulary.methods)
    expect_named(method.parameters);
  for (const auto &benchmark : vocabulary.benchmarks)
    if (benchmark.name == "cantilever") {
      expect_named(benchmark.problem);
      expect_named(benchmark.material);
    }
  expect_named(scene::study_declarations());
  expect_named(scene::output_declarations());
}

TEST(Commands, run_and_report) {
  const Folder folder;
  folder.write("scene.toml", small_scene);
  const auto run = run_program({"run", "scene.toml", "--output", "a", "--repeats", "2"}, folder.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(has(run.err, "Written:")) << run.err;
  EXPECT_EQ(run.out, contents(folder / "a/results.txt"));
  for (const auto *name : {"results.txt", "results.md", "results.csv", "results.json"})
    EXPECT_TRUE(fs::exists(folder / "a" / name)) << name;
  const auto results = reports::read_results(folder / "a/results.json");
  ASSERT_EQ(results.cells.size(), 6u);
  for (const auto &cell : results.cells) {
    EXPECT_EQ(cell.repeats, 2);
    EXPECT_EQ(cell.series.size(), 2u);
    for (const auto &series : cell.series)
      EXPECT_TRUE(fs::exists(folder / "a" / series.file)) << series.file;
    EXPECT_GT(cell.memory_bytes, -1);
    EXPECT_LT(cell.seconds.at("total").minimum, cell.seconds.at("total").maximum + 1e-12);
  }
  EXPECT_TRUE(results.published.empty()) << "a scene of one's own is not held against the papers";

  // The report can be rebuilt from the results alone, byte for byte.
  const auto report = run_here({"report", "a/results.json", "--output", "b"}, folder.path());
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(report.out, run.out);
  for (const auto *name : {"results.txt", "results.md", "results.csv", "results.json"})
    EXPECT_EQ(contents(folder / "a" / name), contents(folder / "b" / name)) << name;
  EXPECT_EQ(run_here({"report", "absent.json"}, folder.path()).exit_code, 3);
  folder.write("half.json", contents(folder / "a/results.json").substr(0, 1000));
  const auto half = run_here({"report", "half.json"}, folder.path());
  EXPECT_EQ(half.exit_code, 3);
  EXPECT_TRUE(has(half.err, "half.json")) << half.err;
}

TEST(Commands, quiet_and_formats) {
  const Folder folder;
  folder.write("scene.toml", small_scene);
  const auto ended = run_here(
      {"run", "scene.toml", "--quiet", "--format", "json,csv", "--set", "title=Ünï 漢字 😀", "--output", "ein Ordner/ü"},
      folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  std::vector<std::string> names;
  for (const auto &entry : fs::directory_iterator(folder / "ein Ordner/ü"))
    if (entry.is_regular_file())
      names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"results.csv", "results.json"}));
  EXPECT_TRUE(has(contents(folder / "ein Ordner/ü/results.json"), "Ünï 漢字 😀"));
}

TEST(Commands, options_stand_before_or_after_the_scene) {
  const Folder folder;
  folder.write("scene.toml", small_scene);
  const std::vector<std::string> words{
      "--set",  "study.levels=[\"8x3\"]", "--set", "material.nu=0.2", "--format", "json", "--format", "csv,text",
      "--quiet"};
  for (const bool before : {true, false}) {
    std::vector<std::string> arguments = words;
    arguments.insert(before ? arguments.end() : arguments.begin(), "scene.toml");
    arguments.insert(arguments.begin(), "run");
    const auto ended = run_here(arguments, folder.path());
    EXPECT_EQ(ended.exit_code, 0) << before << ": " << ended.err;
    for (const auto *name : {"results.json", "results.csv", "results.txt"})
      EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
    EXPECT_EQ(reports::read_results(folder / "out/results.json").cells.at(0).level, "8x3");
    fs::remove_all(folder / "out");
  }
}

TEST(Commands, a_method_may_have_levels_of_its_own) {
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n[[method]]\n"
                             "name = \"fem\"\nelement = \"Q2\"\nlevels = [\"8x3\", \"16x4\"]\n[study]\n"
                             "levels = [\"16x4\"]\n");
  EXPECT_EQ(run_here({"run", "scene.toml"}, folder.path()).exit_code, 0);
  const auto results = reports::read_results(folder / "out/results.json");
  ASSERT_EQ(results.cells.size(), 3u);
  EXPECT_EQ(results.cells[1].level, "8x3");
  // By default the mesh has the particles as vertices.
  EXPECT_EQ(results.cells[0].n_points, 64);
  EXPECT_EQ(results.cells[2].n_points, 64);
}

} // namespace
