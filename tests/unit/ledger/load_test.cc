#include "comparisons/ledger/ledger.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace comparisons::ledger;
using comparisons::reports::Kind;
using comparisons::reports::Verdict;
namespace fs = std::filesystem;

namespace {

constexpr const char *head = "schema = 1\nbenchmark = \"beam\"\nsource = \"A paper\"\n";
constexpr const char *good_value =
    "[[value]]\nentry = \"Table 1\"\nscene = \"scene\"\nlabel = \"weak1\"\nlevel = \"16x4\"\n"
    "quantity = \"error\"\npublished = -2\ntolerance = 0.01\n";
constexpr const char *good_claim =
    "[[claim]]\nentry = \"Fig. 1\"\nstatement = \"so\"\nscene = \"scene\"\n"
    "quantity = \"error\"\nleft = {label = \"a\"}\nrelation = \"<\"\nright = {label = \"b\"}\n";

class Load : public testing::Test {
protected:
  void SetUp() override {
    file_ = fs::temp_directory_path() / ("petrov_published_" + std::to_string(::getpid()) + ".toml");
  }
  void TearDown() override { fs::remove(file_); }

  std::vector<Entry> load(const std::string &text) const {
    std::ofstream(file_) << text;
    return load_published(file_);
  }
  /// The message of a file that is not valid, without the file's name.
  std::string complaint(const std::string &text) const {
    try {
      load(text);
    } catch (const PublishedError &error) {
      std::string message = error.what();
      for (auto at = message.find(file_.string()); at != std::string::npos; at = message.find(file_.string()))
        message.erase(at, file_.string().size() + 1);
      return message;
    }
    return "no complaint";
  }

  fs::path file_;
};

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_F(Load, AValue) {
  const std::vector<Entry> entries = load(std::string(head) + good_value +
                                          "variant = \"jitter=0\"\nparameters = {support = 3.0, corner = \"x\"}\n"
                                          "expect = \"differs\"\nremark = \"a misprint\"\n");
  ASSERT_EQ(entries.size(), 1u);
  const Entry &entry = entries[0];
  EXPECT_EQ(entry.kind, Kind::value);
  EXPECT_EQ(entry.source, "A paper");
  EXPECT_EQ(entry.benchmark, "beam");
  EXPECT_EQ(entry.expect, Verdict::differs);
  EXPECT_EQ(entry.published, -2.0);
  EXPECT_EQ(entry.tolerance, 0.01);
  EXPECT_EQ(entry.value.cell.variant, "jitter=0");
  EXPECT_EQ(entry.value.cell.parameters["support"], 3.0);
  EXPECT_EQ(entry.value.cell.parameters["corner"], "x");
  EXPECT_EQ(entry.remark, "a misprint");
}

TEST_F(Load, ARelativeToleranceIsOfThePublished) {
  std::string text = std::string(head) + good_value;
  text.replace(text.find("tolerance = 0.01"), 16, "relative_tolerance = 0.05");
  EXPECT_DOUBLE_EQ(load(text)[0].tolerance, 0.1);
}

TEST_F(Load, AChangeInheritsWhatItDoesNotName) {
  const Entry entry = load(std::string(head) + good_value + "from = {level = \"8x2\"}\nchange = \"rate\"\n")[0];
  EXPECT_EQ(entry.value.change, Change::rate);
  EXPECT_EQ(entry.value.from.level, "8x2");
  EXPECT_EQ(entry.value.from.label, "weak1");
  EXPECT_EQ(entry.value.cell.level, "16x4");
}

TEST_F(Load, AClaimGivesItsOperandsDefaults) {
  const Entry entry = load(std::string(head) + good_claim)[0];
  EXPECT_EQ(entry.kind, Kind::claim);
  EXPECT_EQ(entry.expect, Verdict::holds);
  ASSERT_EQ(entry.conditions.size(), 1u);
  EXPECT_EQ(entry.conditions[0].left.cell.scene, "scene");
  EXPECT_EQ(entry.conditions[0].left.quantity, "error");
  EXPECT_EQ(std::get<Operand>(entry.conditions[0].right).cell.label, "b");
}

TEST_F(Load, SeveralConditionsInBothSpellings) {
  const std::string start =
      std::string(head) + "[[claim]]\nentry = \"e\"\nstatement = \"s\"\nscene = \"scene\"\nquantity = \"q\"\n";
  const std::string array =
      "condition = [\n  {left = {label = \"a\"}, relation = \"<\", right = 1},\n"
      "  {left = {label = \"b\"}, relation = \"within\", right = {method = \"c\"}, tolerance = 0.5},\n]\n";
  const std::string tables =
      "[[claim.condition]]\nleft = {label = \"a\"}\nrelation = \"<\"\nright = 1\n"
      "[[claim.condition]]\nleft = {label = \"b\"}\nrelation = \"within\"\nright = {method = \"c\"}\n"
      "tolerance = 0.5\n";
  for (const std::string &text : {start + array, start + tables}) {
    const Entry entry = load(text)[0];
    ASSERT_EQ(entry.conditions.size(), 2u);
    EXPECT_EQ(std::get<double>(entry.conditions[0].right), 1.0);
    EXPECT_EQ(entry.conditions[1].relation, Relation::within);
    EXPECT_EQ(entry.conditions[1].tolerance, 0.5);
    EXPECT_EQ(std::get<Operand>(entry.conditions[1].right).cell.method, "c");
  }
}

TEST_F(Load, FaultsNameTheirLine) {
  const std::string text = std::string(head) + good_value;
  EXPECT_EQ(complaint(text), "no complaint");
  EXPECT_TRUE(contains(complaint(text + "colour = 3\n"), "12:1: unknown key 'colour'; known here are "))
      << complaint(text + "colour = 3\n");
  EXPECT_TRUE(
      contains(complaint(text + "expect = \"perhaps\"\n"),
               "12:10: 'expect' is \"perhaps\"; allowed are \"reproduced\", \"differs\", \"not reproducible\""));
  EXPECT_TRUE(contains(complaint(text + "expect = \"differs\"\n"), "needs a 'remark'"));
  EXPECT_TRUE(contains(complaint(text + "relative_tolerance = 1\n"), "one of 'tolerance' and 'relative_tolerance'"));
  EXPECT_TRUE(contains(complaint(text + "change = \"rate\"\n"), "'from' and 'change' belong together"));
  EXPECT_TRUE(contains(complaint(text + "remark = 3\n"), "'remark' must be a text"));
  EXPECT_TRUE(contains(complaint(text + "parameters = {a = [1]}\n"), "parameter 'a'"));
  EXPECT_TRUE(contains(complaint(text + "parameters = 1\n"), "'parameters' must be a table"));
  EXPECT_TRUE(contains(complaint("benchmark = \"x\"\nschema = 2\n"), "'schema' must be 1"));
  EXPECT_TRUE(contains(complaint("schema = 1\n"), "'benchmark' is missing"));
  EXPECT_TRUE(contains(complaint(std::string(head) + "value = 3\n"), "'value' must be an array of tables"));
  EXPECT_TRUE(contains(complaint("schema = = 1\n"), "1:"));
}

TEST_F(Load, MissingKeysOfAValue) {
  for (const std::string key : {"entry", "scene", "label", "quantity", "published", "tolerance"}) {
    std::string text = std::string(head) + good_value;
    const auto begin = text.find("\n" + key + " = ") + 1;
    text.erase(begin, text.find('\n', begin) + 1 - begin);
    EXPECT_TRUE(contains(complaint(text), "4:1: ")) << complaint(text);
    EXPECT_TRUE(contains(complaint(text), "'" + key + "'")) << complaint(text);
  }
}

TEST_F(Load, NumbersMustBeFiniteAndTolerancesPositive) {
  const std::string text = std::string(head) + good_value;
  const auto with = [&](const std::string &old, const std::string &fresh) {
    std::string changed = text;
    changed.replace(changed.find(old), old.size(), fresh);
    return complaint(changed);
  };
  EXPECT_TRUE(contains(with("published = -2", "published = nan"), "'published' is not finite"));
  EXPECT_TRUE(contains(with("published = -2", "published = \"-2\""), "'published' must be a number"));
  EXPECT_TRUE(contains(with("tolerance = 0.01", "tolerance = -0.01"), "'tolerance' is negative"));
}

TEST_F(Load, FaultsOfClaims) {
  const std::string text = std::string(head) + good_claim;
  const auto with = [&](const std::string &old, const std::string &fresh) {
    std::string changed = text;
    changed.replace(changed.find(old), old.size(), fresh);
    return complaint(changed);
  };
  EXPECT_EQ(complaint(text), "no complaint");
  EXPECT_TRUE(contains(with("\"<\"", "\"=\""), "allowed are \"<\", \"<=\""));
  EXPECT_TRUE(contains(with("\"<\"", "\"within\""), "'within' needs 'tolerance'"));
  EXPECT_TRUE(contains(complaint(text + "tolerance = 1\n"), "nothing else takes them"));
  EXPECT_TRUE(contains(with("{label = \"a\"}", "{label = \"a\", color = 1}"), "unknown key 'color'"));
  EXPECT_TRUE(contains(with("{label = \"a\"}", "{level = \"a\"}"), "'label' or 'method' is missing"));
  EXPECT_TRUE(contains(with("left = {label = \"a\"}\n", ""), "'left' is missing"));
  EXPECT_TRUE(contains(with("right = {label = \"b\"}\n", ""), "'right' is missing"));
  EXPECT_TRUE(contains(with("relation = \"<\"\n", ""), "'relation' is missing"));
  EXPECT_TRUE(contains(with("statement = \"so\"\n", ""), "'statement' is missing"));
  EXPECT_TRUE(contains(complaint(text + "condition = []\n"), "'condition'"));
  EXPECT_TRUE(contains(complaint(text + "expect = \"differs\"\n"), "allowed are \"holds\", \"does not hold\""));
  EXPECT_TRUE(contains(complaint(text + "expect = \"does not hold\"\n"), "needs a 'remark'"));
}

TEST_F(Load, AllFaultsOfAFileAreToldAtOnce) {
  const std::string message =
      complaint(std::string(head) + good_value + "colour = 3\nshape = 1\n" + good_claim + "size = 1\n");
  EXPECT_TRUE(contains(message, "colour"));
  EXPECT_TRUE(contains(message, "shape"));
  EXPECT_TRUE(contains(message, "size"));
}

TEST_F(Load, AFileThatDoesNotExist) {
  try {
    load_published("/nonexistent/published.toml");
    FAIL();
  } catch (const PublishedError &error) {
    EXPECT_TRUE(contains(error.what(), "/nonexistent/published.toml"));
  }
}

TEST(CantileverPublished, HoldsEveryPrintedFigure) {
  const std::vector<Entry> entries =
      load_published(PETROV_SOURCE_DIR "/comparisons/benchmarks/cantilever/published.toml");
  const auto count = [&](const std::string &scene, const std::string &label, const std::string &level,
                         const std::string &quantity, double published) {
    return std::count_if(entries.begin(), entries.end(), [&](const Entry &entry) {
      const Selector &cell = entry.value.cell;
      return entry.kind == Kind::value && cell.scene == scene && cell.label == label && cell.level == level &&
             entry.value.quantity == quantity && entry.published == published;
    });
  };
  const char *log_e = "displacement_log10_E";
  struct Figure {
    const char *scene, *label, *level;
    double published;
  };
  // Tables 1 and 2 and the figures of the text of section 4.1, as printed.
  const std::vector<Figure> figures{
      {"scene", "strong", "16x4", -0.710},
      {"scene", "weak1", "16x4", -2.012},
      {"scene", "weak2", "16x4", -1.628},
      {"corner_essential", "u1 u2", "16x4", -0.7097},
      {"corner_essential", "u1 t1", "16x4", -0.7092},
      {"corner_essential", "u1 t2", "16x4", -0.7094},
      {"corner_essential", "u2 t2", "16x4", -0.6955},
      {"corner_essential", "u2 t1", "16x4", -0.7020},
      {"corner_essential", "t1 t2", "16x4", -0.7049},
      {"corner_natural", "s11 s12", "16x4", -0.7501},
      {"corner_natural", "s11 s12", "31x7", -1.215},
      {"corner_natural", "s11 s12", "61x13", -1.814},
      {"corner_natural", "s11 s12", "91x19", -2.166},
      {"corner_natural", "s12 s22", "16x4", -0.6319},
      {"corner_natural", "s12 s22", "31x7", -1.146},
      {"corner_natural", "s12 s22", "61x13", -1.776},
      {"corner_natural", "s12 s22", "91x19", -2.140},
      {"corner_natural", "s11 s22", "16x4", -0.7097},
      {"corner_natural", "s11 s22", "31x7", -1.195},
      {"corner_natural", "s11 s22", "61x13", -1.804},
      {"corner_natural", "s11 s22", "91x19", -2.159},
      {"order", "weak1 order=1", "16x4", -1.743},
      {"order", "weak1 order=2", "16x4", -1.980},
      {"order", "weak2 order=1", "16x4", -0.683},
      {"order", "weak2 order=2", "16x4", -1.638},
  };
  for (const Figure &figure : figures)
    EXPECT_EQ(count(figure.scene, figure.label, figure.level, log_e, figure.published), 1)
        << figure.scene << " " << figure.label << " " << figure.level;
  EXPECT_EQ(count("scene", "strong", "16x4", "u2_max_relative", 0.1951), 1);
  EXPECT_EQ(count("scene", "weak1", "16x4", "u2_max_relative", 0.0106), 1);
  EXPECT_EQ(count("scene", "weak2", "16x4", "u2_max_relative", 0.0234), 1);
  EXPECT_EQ(count("quadrature", "weak1 quadrature_points=32", "16x4", log_e, -0.0036), 1);
  EXPECT_EQ(count("quadrature", "weak2 quadrature_points=32", "16x4", log_e, -0.0049), 1);
  EXPECT_EQ(std::count_if(entries.begin(), entries.end(), [](const Entry &entry) { return entry.kind == Kind::value; }),
            30);
}
