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

using HasScene = std::function<bool(const std::string &scene)>;

class Checker {
public:
  explicit Checker(HasScene has_scene) : has_scene_(std::move(has_scene)) {}

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
    static const std::set<std::string> known{"paper", "item", "what", "scenes", "kind", "why"};
    for (const auto &[key, value] : item)
      if (!known.contains(std::string(key.str())))
        add(fmt::format("{}: unknown key '{}'", where, key.str()));
    if (!papers().contains(paper))
      add(where + ": unknown paper");
    if (item["what"].value_or(std::string()).empty())
      add(where + ": 'what' is missing");
    if (!seen_[paper].insert(name).second)
      add(where + ": listed twice");
    if (item.contains("scenes") == item.contains("kind"))
      add(where + ": exactly one of 'scenes' and 'kind' is needed");
    check_scenes(item, where);
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
      if (!has_scene_(scene))
        add(fmt::format("{}: there is no scene '{}'", where, scene));
    }
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

  HasScene has_scene_;
  std::map<std::string, std::set<std::string>> seen_;
  std::vector<std::string> faults_;
};

fs::path benchmark_folder() { return PETROV_SOURCE_DIR "/comparisons/benchmarks"; }

toml::table shipped() {
  auto result = toml::parse_file(PETROV_SOURCE_DIR "/tests/published/coverage.toml");
  EXPECT_TRUE(result) << result.error().description();
  return result ? std::move(result).table() : toml::table{};
}

bool any_scene(const std::string &) { return true; }

bool has_fault(const std::vector<std::string> &faults, const std::string &part) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const std::string &fault) { return fault.find(part) != std::string::npos; });
}

/// The shipped file with one change to its first item that fits.
std::vector<std::string> faults_after(const std::string &item, const std::function<void(toml::table &)> &change) {
  toml::table coverage = shipped();
  for (toml::node &node : *coverage["item"].as_array())
    if (node.as_table()->at("item").value_or(std::string()) == item) {
      change(*node.as_table());
      break;
    }
  return Checker(any_scene).faults(coverage);
}

} // namespace

TEST(Coverage, EveryResultOfThePapersHasASceneThatExists) {
  Checker checker([](const std::string &scene) { return fs::is_regular_file(benchmark_folder() / (scene + ".toml")); });
  for (const std::string &fault : checker.faults(shipped()))
    ADD_FAILURE() << "coverage.toml: " << fault;
}

TEST(Coverage, TheFileItselfIsComplete) { EXPECT_EQ(Checker(any_scene).faults(shipped()), std::vector<std::string>()); }

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
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert("kind", "sketch"); }), "exactly one of"));
  EXPECT_TRUE(
      has_fault(faults_after("Table 1", [](toml::table &t) { t.insert("scene", "x"); }), "unknown key 'scene'"));
  EXPECT_TRUE(
      has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("paper", "x"); }), "unknown paper"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.erase("what"); }), "'what' is missing"));
  EXPECT_TRUE(has_fault(faults_after("Table 1", [](toml::table &t) { t.insert_or_assign("scenes", toml::array{}); }),
                        "must be a list"));
  EXPECT_TRUE(has_fault(faults_after("Figure 1", [](toml::table &t) { t.erase("why"); }), "says why"));
}

TEST(Coverage, ADanglingSceneIsSeen) {
  Checker checker([](const std::string &scene) { return scene != "cantilever/order"; });
  EXPECT_TRUE(has_fault(checker.faults(shipped()), "there is no scene 'cantilever/order'"));
}
