#include "comparisons/ledger/ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace comparisons::ledger;
using comparisons::reports::Cell;
using comparisons::reports::Kind;
using comparisons::reports::Published;
using comparisons::reports::Status;
using comparisons::reports::Verdict;

namespace {

Cell cell(const std::string &label, const std::string &level, double error) {
  Cell result;
  result.benchmark = "beam";
  result.scene = "scene";
  result.method = label.substr(0, label.find(' '));
  result.label = label;
  result.level = level;
  result.n_points = 64;
  result.parameters = {{"support", 3}, {"corner", "s11 s12"}, {"order", 2}};
  result.errors = {{"error", error}};
  result.quantities = {{"factor", 3.0}};
  result.seconds["total"] = {0.5, 0.4, 0.6};
  return result;
}

Operand operand(const std::string &label, const std::string &level = "16x4", const std::string &quantity = "error") {
  Operand result;
  result.cell.scene = "scene";
  result.cell.label = label;
  result.cell.level = level;
  result.quantity = quantity;
  return result;
}

Entry value(double published, double tolerance, Verdict expect) {
  Entry entry;
  entry.source = "A paper";
  entry.entry = "Table 1";
  entry.benchmark = "beam";
  entry.expect = expect;
  entry.value = operand("weak1");
  entry.published = published;
  entry.tolerance = tolerance;
  return entry;
}

Entry claim(std::vector<Condition> conditions, Verdict expect = Verdict::holds) {
  Entry entry;
  entry.source = "A paper";
  entry.entry = "section 1";
  entry.benchmark = "beam";
  entry.kind = Kind::claim;
  entry.expect = expect;
  entry.statement = "it is so";
  entry.conditions = std::move(conditions);
  return entry;
}

Condition condition(const Operand &left, Relation relation, std::variant<double, Operand> right) {
  Condition result;
  result.left = left;
  result.relation = relation;
  result.right = std::move(right);
  return result;
}

Published settled(const Entry &entry, const std::vector<Cell> &cells) {
  const std::vector<Published> all = settle({entry}, cells);
  EXPECT_EQ(all.size(), 1u);
  return all.empty() ? Published() : all.front();
}

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

} // namespace

TEST(Settle, EveryOutcomeOfAValue) {
  struct Case {
    Verdict expect;
    double computed;
    Verdict verdict;
    bool expected;
  };
  const std::vector<Case> cases{
      {Verdict::reproduced, 1.01, Verdict::reproduced, true},
      {Verdict::reproduced, 1.03, Verdict::differs, false},
      {Verdict::differs, 1.01, Verdict::reproduced, false},
      {Verdict::differs, 1.03, Verdict::differs, true},
      {Verdict::not_reproducible, 1.01, Verdict::reproduced, false},
      {Verdict::not_reproducible, 1.03, Verdict::not_reproducible, true},
  };
  for (const Case &c : cases) {
    const Published line = settled(value(1.0, 0.02, c.expect), {cell("weak1", "16x4", c.computed)});
    EXPECT_EQ(line.verdict, c.verdict) << to_text(c.expect) << " " << c.computed;
    EXPECT_EQ(line.expected, c.expected) << to_text(c.expect) << " " << c.computed;
    EXPECT_EQ(line.computed, c.computed);
    EXPECT_EQ(line.published, 1.0);
    EXPECT_EQ(line.tolerance, 0.02);
  }
}

TEST(Settle, EveryOutcomeOfAClaim) {
  struct Case {
    Verdict expect;
    double left;
    Verdict verdict;
    bool expected;
  };
  const std::vector<Case> cases{{Verdict::holds, 1.0, Verdict::holds, true},
                                {Verdict::holds, 3.0, Verdict::does_not_hold, false},
                                {Verdict::does_not_hold, 1.0, Verdict::holds, false},
                                {Verdict::does_not_hold, 3.0, Verdict::does_not_hold, true}};
  for (const Case &c : cases) {
    const Entry entry = claim({condition(operand("weak1"), Relation::less, operand("strong"))}, c.expect);
    const Published line = settled(entry, {cell("weak1", "16x4", c.left), cell("strong", "16x4", 2.0)});
    EXPECT_EQ(line.verdict, c.verdict);
    EXPECT_EQ(line.expected, c.expected);
    EXPECT_EQ(line.statement, "it is so");
    EXPECT_EQ(line.kind, Kind::claim);
  }
}

TEST(Settle, ValuesThatCannotBeJudged) {
  const auto refused = [](bool expected) {
    Cell bad = cell("weak1", "16x4", 1.0);
    bad.status = Status::refused;
    bad.reason = "too few neighbours";
    bad.expected = expected;
    return bad;
  };
  for (const Verdict expect : {Verdict::reproduced, Verdict::differs, Verdict::not_reproducible}) {
    const Entry entry = value(1.0, 0.02, expect);
    Published line = settled(entry, {cell("strong", "16x4", 1.0)});
    EXPECT_EQ(line.verdict, Verdict::differs);
    EXPECT_FALSE(line.expected);
    EXPECT_EQ(line.computed, std::nullopt);
    EXPECT_EQ(line.finding, "there is no cell weak1, 16x4");

    line = settled(entry, {refused(false)});
    EXPECT_EQ(line.verdict, Verdict::differs);
    EXPECT_FALSE(line.expected);
    EXPECT_EQ(line.finding, "weak1, 16x4 is refused: too few neighbours");

    line = settled(entry, {cell("weak1", "16x4", std::nan(""))});
    EXPECT_EQ(line.verdict, Verdict::differs);
    EXPECT_FALSE(line.expected);
    EXPECT_EQ(line.finding, "weak1, 16x4 has no finite error");

    line = settled(entry, {cell("weak1", "16x4", 1.0), cell("weak1", "16x4", 1.0)});
    EXPECT_FALSE(line.expected);
    EXPECT_EQ(line.finding, "several cells fit weak1, 16x4");

    // A refusal that the scene declares is what an entry that cannot be reproduced says.
    line = settled(entry, {refused(true)});
    EXPECT_EQ(line.expected, expect == Verdict::not_reproducible);
    EXPECT_EQ(line.verdict, expect == Verdict::not_reproducible ? Verdict::not_reproducible : Verdict::differs);
  }
}

TEST(Settle, ClaimsThatCannotBeJudgedDoNotHoldUnexpectedly) {
  for (const Verdict expect : {Verdict::holds, Verdict::does_not_hold})
    for (const auto &[left, right] : {std::pair{"weak1", "weak2"}, std::pair{"weak2", "weak1"}}) {
      const Entry entry = claim({condition(operand(left), Relation::less, operand(right))}, expect);
      const Published line = settled(entry, {cell("weak1", "16x4", 1.0)});
      EXPECT_EQ(line.verdict, Verdict::does_not_hold);
      EXPECT_FALSE(line.expected);
      EXPECT_EQ(line.finding, "there is no cell weak2, 16x4");
    }
}

TEST(Settle, OtherScenesAndBenchmarksAreLeftOut) {
  Cell other_scene = cell("weak1", "16x4", 1.0);
  other_scene.scene = "order";
  Cell other_benchmark = cell("weak1", "16x4", 1.0);
  other_benchmark.benchmark = "plate";
  EXPECT_TRUE(settle({value(1.0, 0.1, Verdict::reproduced)}, {other_scene, other_benchmark}).empty());
  // A claim over two scenes needs both.
  Operand right = operand("weak1");
  right.cell.scene = "order";
  const Entry two = claim({condition(operand("weak1"), Relation::less_or_equal, right)});
  EXPECT_TRUE(settle({two}, {cell("weak1", "16x4", 1.0)}).empty());
  EXPECT_EQ(settle({two}, {cell("weak1", "16x4", 1.0), other_scene}).size(), 1u);
}

TEST(Settle, MissingCellsMayBeLeftOut) {
  const std::vector<Entry> entries{value(1.0, 0.1, Verdict::reproduced),
                                   claim({condition(operand("weak1"), Relation::less, 2.0)})};
  EXPECT_EQ(settle(entries, {cell("strong", "16x4", 1.0)}).size(), 2u);
  EXPECT_TRUE(settle(entries, {cell("strong", "16x4", 1.0)}, MissingCells::leave_out).empty());
  // A cell that was asked for and failed stays.
  Cell failed = cell("weak1", "16x4", 1.0);
  failed.status = Status::failed;
  EXPECT_EQ(settle(entries, {failed}, MissingCells::leave_out).size(), 2u);
}

TEST(Settle, CellsAreFoundByWhatTheEntryNames) {
  Cell jittered = cell("weak1", "16x4", 5.0);
  jittered.variant = "jitter=0.25";
  Cell wide = cell("weak1", "16x4", 7.0);
  wide.parameters["support"] = 4.0;
  Cell regular = cell("weak1", "16x4", 1.0);
  regular.variant = "jitter=0";
  const std::vector<Cell> cells{jittered, wide, regular, cell("weak1", "31x7", 9.0)};
  const auto computed = [&](const auto &change) {
    Entry entry = value(0, 100, Verdict::reproduced);
    change(entry.value);
    return settled(entry, cells).computed;
  };
  EXPECT_EQ(computed([](Operand &o) { o.cell.variant = "jitter=0.25"; }), 5.0);
  EXPECT_EQ(computed([](Operand &o) { o.cell.variant = "jitter=0"; }), 1.0);
  EXPECT_EQ(computed([](Operand &o) { o.cell.parameters = {{"support", 4}}; }), 7.0);
  EXPECT_EQ(computed([](Operand &o) { o.cell.level = "31x7"; }), 9.0);
  EXPECT_EQ(computed([](Operand &o) { o.cell.label.clear(), o.cell.method = "weak1", o.cell.level = "31x7"; }), 9.0);
  EXPECT_EQ(computed([](Operand &o) { o.cell.parameters = {{"support", 5}}; }), std::nullopt);
  EXPECT_EQ(computed([](Operand &o) { o.cell.parameters = {{"shape", 5}}; }), std::nullopt);
  EXPECT_EQ(computed([](Operand &) {}), std::nullopt); // three fit
}

TEST(Settle, QuantitiesOfEveryKind) {
  Cell full = cell("weak1", "16x4", 0.25);
  full.n_dofs = 128;
  full.nonzeros = 1000;
  full.memory_bytes = 5000;
  full.steps = 7;
  const auto computed = [&](const std::string &quantity) {
    Entry entry = value(0, 0, Verdict::differs);
    entry.value.quantity = quantity;
    return settled(entry, {full}).computed;
  };
  EXPECT_EQ(computed("error"), 0.25);
  EXPECT_EQ(computed("factor"), 3.0);
  EXPECT_EQ(computed("seconds.total"), 0.5);
  EXPECT_EQ(computed("seconds.solve"), std::nullopt);
  EXPECT_EQ(computed("n_points"), 64.0);
  EXPECT_EQ(computed("n_dofs"), 128.0);
  EXPECT_EQ(computed("nonzeros"), 1000.0);
  EXPECT_EQ(computed("memory_bytes"), 5000.0);
  EXPECT_EQ(computed("steps"), 7.0);
  EXPECT_EQ(computed("nothing"), std::nullopt);
}

TEST(Settle, ChangesBetweenCells) {
  const std::vector<Cell> cells{cell("weak1", "16x4", 0.08), cell("weak1", "31x7", 0.02)};
  const auto computed = [&](Change change) {
    Entry entry = value(0, 0, Verdict::differs);
    entry.value = operand("weak1", "31x7");
    entry.value.change = change;
    entry.value.from = operand("weak1", "16x4").cell;
    return settled(entry, cells).computed.value();
  };
  // Exact but for rounding.
  EXPECT_NEAR(computed(Change::difference), -0.06, 1e-15);
  EXPECT_NEAR(computed(Change::relative), -0.75, 1e-15);
  EXPECT_NEAR(computed(Change::ratio), 0.25, 1e-15);
  EXPECT_NEAR(computed(Change::rate), 2.0, 1e-14); // 15 -> 30 intervals, a quarter of the error
}

TEST(Settle, ARelativeChangeHasTheSignOfTheDifference) {
  Entry entry = value(-0.0036, 0.001, Verdict::reproduced);
  entry.value = operand("weak1", "31x7");
  entry.value.change = Change::relative;
  entry.value.from = operand("weak1", "16x4").cell;
  // log E falls from -2 by 0.4 %.
  const Published line = settled(entry, {cell("weak1", "16x4", -2.0), cell("weak1", "31x7", -2.008)});
  EXPECT_NEAR(line.computed.value(), -0.004, 1e-15);
  EXPECT_EQ(line.quantity, "relative change of error");
  EXPECT_EQ(line.verdict, Verdict::reproduced);
}

TEST(Settle, ARateOfAnErrorThatIsZeroCannotBeJudged) {
  Entry entry = value(2, 0.1, Verdict::reproduced);
  entry.value = operand("weak1", "31x7");
  entry.value.change = Change::rate;
  entry.value.from = operand("weak1", "16x4").cell;
  const Published line = settled(entry, {cell("weak1", "16x4", 0.1), cell("weak1", "31x7", 0.0)});
  EXPECT_FALSE(line.expected);
  EXPECT_TRUE(contains(line.finding, "has no value"));
}

TEST(Settle, EveryRelation) {
  const auto verdict = [](double left, Relation relation, double right) {
    Condition one = condition(operand("weak1"), relation, right);
    one.tolerance = 0.5;
    return settled(claim({one}), {cell("weak1", "16x4", left)}).verdict == Verdict::holds;
  };
  EXPECT_TRUE(verdict(1, Relation::less, 2));
  EXPECT_FALSE(verdict(2, Relation::less, 2));
  EXPECT_TRUE(verdict(2, Relation::less_or_equal, 2));
  EXPECT_FALSE(verdict(3, Relation::less_or_equal, 2));
  EXPECT_TRUE(verdict(3, Relation::greater, 2));
  EXPECT_FALSE(verdict(2, Relation::greater, 2));
  EXPECT_TRUE(verdict(2, Relation::greater_or_equal, 2));
  EXPECT_FALSE(verdict(1, Relation::greater_or_equal, 2));
  EXPECT_TRUE(verdict(1.5, Relation::within, 2));
  EXPECT_TRUE(verdict(2.5, Relation::within, 2));
  EXPECT_FALSE(verdict(2.6, Relation::within, 2));
  EXPECT_FALSE(verdict(1.4, Relation::within, 2));
}

TEST(Settle, FactorAndRelativeTolerance) {
  Condition one = condition(operand("weak1"), Relation::less, operand("strong"));
  one.factor = 2;
  EXPECT_EQ(settled(claim({one}), {cell("weak1", "16x4", 1.9), cell("strong", "16x4", 1.0)}).verdict, Verdict::holds);
  EXPECT_EQ(settled(claim({one}), {cell("weak1", "16x4", 2.1), cell("strong", "16x4", 1.0)}).verdict,
            Verdict::does_not_hold);
  one = condition(operand("weak1"), Relation::within, operand("strong"));
  one.relative_tolerance = 0.01;
  EXPECT_EQ(settled(claim({one}), {cell("weak1", "16x4", -2.01), cell("strong", "16x4", -2.0)}).verdict,
            Verdict::holds);
  EXPECT_EQ(settled(claim({one}), {cell("weak1", "16x4", -2.03), cell("strong", "16x4", -2.0)}).verdict,
            Verdict::does_not_hold);
}

TEST(Settle, AllConditionsMustHold) {
  const auto verdict = [](double second, double third) {
    const Entry entry =
        claim({condition(operand("weak1"), Relation::less, 10.0), condition(operand("weak2"), Relation::less, 10.0),
               condition(operand("strong"), Relation::less, 10.0)});
    return settled(entry, {cell("weak1", "16x4", 1), cell("weak2", "16x4", second), cell("strong", "16x4", third)});
  };
  EXPECT_EQ(verdict(1, 1).verdict, Verdict::holds);
  EXPECT_EQ(verdict(11, 1).verdict, Verdict::does_not_hold);
  EXPECT_EQ(verdict(1, 11).verdict, Verdict::does_not_hold);
  EXPECT_EQ(verdict(1, 11).finding, "strong = 11 not < 10; weak1 = 1 < 10; weak2 = 1 < 10");
}

TEST(Settle, FindingsNameWhatDiffers) {
  const auto finding = [](const Operand &left, const Operand &right) {
    Cell other = cell("weak1", "16x4", 4.0);
    other.scene = "order";
    return settled(claim({condition(left, Relation::less, right)}),
                   {cell("weak1", "16x4", 1.0), cell("weak1", "31x7", 0.25), cell("strong", "16x4", 2.0), other})
        .finding;
  };
  Operand other_scene = operand("weak1");
  other_scene.cell.scene = "order";
  Operand change = operand("weak1", "31x7");
  change.change = Change::rate;
  change.from = operand("weak1").cell;
  EXPECT_EQ(finding(operand("weak1"), operand("strong")), "weak1 = 1 < strong = 2");
  EXPECT_EQ(finding(operand("weak1", "31x7"), operand("weak1")), "weak1, 31x7 = 0.25 < weak1, 16x4 = 1");
  EXPECT_EQ(finding(operand("weak1"), other_scene), "weak1 of scene = 1 < weak1 of order = 4");
  EXPECT_EQ(finding(operand("weak1"), change), "weak1, 16x4 = 1 < weak1, 31x7 (rate from 16x4) = 2.00");
}

TEST(Settle, ManyConditionsAreSummed) {
  std::vector<Condition> many(8, condition(operand("weak1"), Relation::less, 10.0));
  EXPECT_EQ(settled(claim(many), {cell("weak1", "16x4", 1)}).finding,
            "all 8 comparisons hold, the first: weak1 = 1 < 10");
  many[5].right = 0.5;
  EXPECT_EQ(settled(claim(many), {cell("weak1", "16x4", 1)}).finding, "1 of 8 comparisons fail: weak1 = 1 not < 0.5");
}

TEST(Settle, TheToleranceItselfIsWithin) {
  // As decimal fractions these differ by exactly the tolerance; in binary by a last bit more.
  EXPECT_EQ(settled(value(-0.7097, 0.001, Verdict::reproduced), {cell("weak1", "16x4", -0.7107)}).verdict,
            Verdict::reproduced);
  EXPECT_EQ(settled(value(-0.7097, 0.001, Verdict::reproduced), {cell("weak1", "16x4", -0.71071)}).verdict,
            Verdict::differs);
  EXPECT_EQ(settled(value(0, 0, Verdict::reproduced), {cell("weak1", "16x4", 0.0)}).verdict, Verdict::reproduced);
}

TEST(Settle, AnInfiniteErrorIsNeverReproduced) {
  const double infinite = std::numeric_limits<double>::infinity();
  const Published line = settled(value(1, infinite, Verdict::reproduced), {cell("weak1", "16x4", infinite)});
  EXPECT_EQ(line.verdict, Verdict::differs);
  EXPECT_EQ(line.computed, std::nullopt);
}
