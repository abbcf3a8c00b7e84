// One thread, one machine, twice: the same bits, but for times and memory.

#include "system/program_process.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace {

using namespace system_tests;
using Json = nlohmann::ordered_json;

/// A run's results.json without what the clock and the state of the machine decide, and its curves.
std::map<std::string, std::string> lasting(const fs::path &out) {
  std::map<std::string, std::string> files;
  Json json = Json::parse(contents(out / "results.json"));
  for (const char *key : {"machine", "not_comparable", "equal_error"}) // the last: seconds at equal errors
    json.erase(key);
  for (auto &cell : json["cells"]) {
    cell.erase("seconds");
    cell.erase("memory_bytes");
  }
  files["results.json"] = json.dump(1);
  for (const auto &file : fs::directory_iterator(out / "series"))
    files[file.path().filename().string()] = contents(file.path());
  return files;
}

void expect_same_twice(const std::string &scene, std::vector<std::string> more) {
  std::vector<std::string> words{"run",       std::string(PETROV_SOURCE_DIR) + "/comparisons/benchmarks/" + scene,
                                 "--repeats", "1",
                                 "--threads", "1",
                                 "--format",  "json",
                                 "--quiet",   "--output",
                                 "out"};
  words.insert(words.end(), more.begin(), more.end());
  const Folder first, second;
  for (const auto *folder : {&first, &second}) {
    const auto ended = run_program(words, folder->path());
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
  }
  const auto a = lasting(first / "out");
  const auto b = lasting(second / "out");
  EXPECT_GT(a.at("results.json").size(), 1000u);
  ASSERT_EQ(a.size(), b.size());
  for (const auto &[name, text] : a)
    EXPECT_TRUE(b.contains(name) && b.at(name) == text) << name << " differs";
}

} // namespace

TEST(Determinism, StaticsByEveryKindOfMethod) {
  expect_same_twice("cantilever/scene.toml", {"--set", "study.levels=[\"16x4\"]"});
}

TEST(Determinism, GeneratedClouds) {
  expect_same_twice("plate_with_hole/fresh_clouds.toml",
                    {"--set", "study.levels=[188]", "--set", "problem.cloud_seed=3"});
}

TEST(Determinism, AGasInTime) { expect_same_twice("shock_tube/scene.toml", {}); }

TEST(Determinism, AWaveInABar) { expect_same_twice("bar_wave/scene.toml", {"--set", "study.levels=[100]"}); }
