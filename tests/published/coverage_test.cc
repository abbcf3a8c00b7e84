// coverage.toml against the papers' own numbering and the scenes that exist.

#include "comparisons/scene/toml.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct Contents {
  int n_tables;
  int n_figures;
  std::vector<std::string> sections; ///< those with a result
  int n_claims;                      ///< statements of the text that can be measured
};

/// What each paper holds, counted in the papers.
const std::map<std::string, Contents> &papers() {
  static const std::map<std::string, Contents> contents{
      {"batra_zhang_2008", {2, 20, {"2", "4.1", "4.1.1", "4.1.2", "4.1.3", "4.1.4", "4.2", "4.3"}, 15}},
      {"zhang_batra_2008", {7, 16, {"2", "3", "4", "5", "6.1", "6.2", "6.3", "6.4", "6.5"}, 17}},
      {"liu_liu_lam_2003", {0, 13, {"2.1", "2.2", "2.3", "2.4", "3.3.1", "3.3.2", "3.3.3", "3.3.4", "4.1", "4.2"}, 9}},
      {"asprone_2010", {0, 3, {"3.1", "3.2", "3.3", "3.4", "3.5", "4", "5.1", "5.2", "5.3"}, 8}}};
  return contents;
}

/// The benchmarks of the design; once all exist, nothing may stay open.
const std::vector<std::string> &benchmarks() {
  static const std::vector<std::string> names{"function_approximation",
                                              "smoothing_functions",
                                              "rod_derivative",
                                              "rod_static",
                                              "rod_vibration",
                                              "bar_wave",
                                              "cantilever",
                                              "plate_with_hole",
                                              "shock_tube",
                                              "detonation",
                                              "hard_cases",
                                              "scaling"};
  return names;
}

struct Tree {
  std::function<bool(const std::string &scene)> has_scene;
  std::function<bool(const std::string &benchmark)> has_benchmark;
};

class Checker {
public:
  explicit Checker(const Tree &tree) : tree_(tree) {}

  std::vector<std::string> faults(const toml::table &coverage) {
    const toml::array *items = coverage["item"].as_array();
    if (!items)
      return {"there is no [[item]]"};
    for (const toml::node &node : *items)
      if (const toml::table *item = node.as_table())
        check_item(*item);
    for (const auto &[paper, contents] : papers())
      check_paper(paper, contents);
    return faults_;
  }

private:
  void add(const std::string &fault) { faults_.push_back(fault); }

  void check_item(const toml::table &item) {
    const std::string paper = item["paper"].value_or(std::string());
    const std::string name = item["item"].value_or(std::string());
    const std::string where = fmt::format("line {}: {}, {}", item.source().begin.line, paper, name);
    static const std::set<std::string> known{"paper", "item", "what", "scenes", "status", "planned", "kind", "why"};
    for (const auto &[key, value] : item)
      if (!known.contains(std::string(key.str())))
        add(fmt::format("{}: unknown key '{}'", where, key.str()));
    if (!papers().contains(paper))
      add(where + ": unknown paper");
    if (item["what"].value_or(std::string()).empty())
      add(where + ": 'what' is missing");
    if (!seen_[paper].insert(name).second)
      add(where + ": listed twice");
    const int n_ways = int(item.contains("scenes")) + int(item.contains("status")) + int(item.contains("kind"));
    if (n_ways != 1)
      add(where + ": exactly one of 'scenes', 'status' and 'kind' is needed");
    check_scenes(item, where);
    check_open(item, where);
    if (item.contains("kind") && item["kind"].value_or(std::string()) != "sketch")
      add(where + ": the only kind is \"sketch\"");
    if (item.contains("kind") == item["why"].value_or(std::string()).empty())
      add(where + ": a sketch, and nothing else, says why nothing is to be produced");
  }

  void check_scenes(const toml::table &item, const std::string &where) {
    if (!item.contains("scenes"))
      return;
    const toml::array *scenes = item["scenes"].as_array();
    if (!scenes || scenes->empty()) {
      add(where + ": 'scenes' must be a list of names");
      return;
    }
    for (const toml::node &node : *scenes) {
      const std::string scene = node.value_or(std::string());
      if (!tree_.has_scene(scene))
        add(fmt::format("{}: there is no scene '{}'", where, scene));
    }
  }

  void check_open(const toml::table &item, const std::string &where) {
    if (!item.contains("status")) {
      if (item.contains("planned"))
        add(where + ": 'planned' belongs to an open item");
      return;
    }
    if (item["status"].value_or(std::string()) != "open")
      add(where + ": the only status is \"open\"");
    const std::string planned = item["planned"].value_or(std::string());
    if (std::find(benchmarks().begin(), benchmarks().end(), planned) == benchmarks().end())
      add(fmt::format("{}: '{}' is no planned benchmark", where, planned));
    if (std::all_of(benchmarks().begin(), benchmarks().end(), tree_.has_benchmark))
      add(where + ": still open although all benchmarks exist");
  }

  void check_paper(const std::string &paper, const Contents &contents) {
    std::set<std::string> wanted;
    for (int i = 1; i <= contents.n_tables; ++i)
      wanted.insert(fmt::format("Table {}", i));
    for (int i = 1; i <= contents.n_figures; ++i)
      wanted.insert(fmt::format("Figure {}", i));
    for (const std::string &section : contents.sections)
      wanted.insert("Section " + section);
    for (const std::string &name : wanted)
      if (!seen_[paper].contains(name))
        add(fmt::format("{}: {} is missing", paper, name));
    int n_claims = 0;
    for (const std::string &name : seen_[paper]) {
      const bool is_claim = name.starts_with("Claim: ");
      n_claims += is_claim;
      if (!is_claim && !wanted.contains(name))
        add(fmt::format("{}: the paper has no {}", paper, name));
    }
    if (n_claims != contents.n_claims)
      add(fmt::format("{}: {} claims are listed, {} were counted", paper, n_claims, contents.n_claims));
  }

  const Tree &tree_;
  std::map<std::string, std::set<std::string>> seen_;
  std::vector<std::string> faults_;
};

fs::path benchmark_folder() { return PETROV_SOURCE_DIR "/comparisons/benchmarks"; }

toml::table shipped() {
  auto result = toml::parse_file(PETROV_SOURCE_DIR "/tests/published/coverage.toml");
  EXPECT_TRUE(result) << result.error().description();
  return result ? std::move(result).table() : toml::table{};
}

/// An item that is open: a sample of one to change.
constexpr const char *open_item = "Claim: its stability is superior to that of the cubic";

Tree anything() {
  return {[](const std::string &) { return true; }, [](const std::string &) { return false; }};
}

bool has_fault(const std::vector<std::string> &faults, const std::string &part) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const std::string &fault) { return fault.find(part) != std::string::npos; });
}

/// The shipped file with one change to its first item that fits.
std::vector<std::string> faults_after(const std::string &item, const std::function<void(toml::table &)> &change,
                                      const Tree &tree = anything()) {
  toml::table coverage = shipped();
  for (toml::node &node : *coverage["item"].as_array())
    if (node.as_table()->at("item").value_or(std::string()) == item) {
      change(*node.as_table());
      break;
    }
  return Checker(tree).faults(coverage);
}

} // namespace

TEST(Coverage, EveryResultOfThePapersHasASceneThatExistsOrIsOpen) {
  const Tree tree{[](const std::string &scene) { return fs::is_regular_file(benchmark_folder() / (scene + ".toml")); },
                  [](const std::string &benchmark) { return fs::is_directory(benchmark_folder() / benchmark); }};
  for (const std::string &fault : Checker(tree).faults(shipped()))
    ADD_FAILURE() << "coverage.toml: " << fault;
}

TEST(Coverage, TheFileItselfIsComplete) {
  EXPECT_EQ(Checker(anything()).faults(shipped()), std::vector<std::string>());
}

TEST(Coverage, EveryFaultIsSeen) {
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("item", "Table 9"); }),
                        "batra_zhang_2008: Table 1 is missing"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("item", "Table 9"); }),
                        "the paper has no Table 9"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("item", "Table 2"); }),
                        "Table 2: listed twice"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("item", "Claim: x"); }),
                        "16 claims are listed, 15 were counted"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.erase("scenes"); }), "exactly one of"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert("status", "open"); }), "exactly one of"));
  EXPECT_TRUE(
      has_fault(faults_after("Table 1", [](toml::table &t) { t.insert("scene", "x"); }), "unknown key 'scene'"));
  EXPECT_TRUE(
      has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("paper", "x"); }), "unknown paper"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.erase("what"); }), "'what' is missing"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("scenes", toml::array{}); }),
                        "must be a list"));
  EXPECT_TRUE(has_fault(faults_after(open_item, [](toml::table &t) { t.insert_or_assign("planned", "x"); }),
                        "'x' is no planned benchmark"));
  EXPECT_TRUE(has_fault(faults_after(open_item, [](toml::table &t) { t.insert_or_assign("status", "done"); }),
                        "the only status"));
  EXPECT_TRUE(has_fault(faults_after("Figure 1", [](toml::table &t) { t.erase("why"); }), "says why"));
}

TEST(Coverage, DanglingScenesAndOpenItemsAreSeen) {
  Tree tree = anything();
  tree.has_scene = [](const std::string &scene) { return scene != "cantilever/order"; };
  EXPECT_TRUE(has_fault(Checker(tree).faults(shipped()), "there is no scene 'cantilever/order'"));
  tree = anything();
  tree.has_benchmark = [](const std::string &benchmark) { return benchmark != "scaling"; };
  EXPECT_TRUE(Checker(tree).faults(shipped()).empty());
  tree.has_benchmark = [](const std::string &) { return true; };
  EXPECT_TRUE(has_fault(Checker(tree).faults(shipped()),
                        std::string(open_item) + ": still open although all benchmarks exist"));
}
