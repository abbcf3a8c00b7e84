#include "comparisons/ledger/ledger.h"

#include "comparisons/reports/groups.h"
#include "comparisons/reports/numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace comparisons::ledger {

namespace {

using reports::Cell;
using reports::Kind;
using reports::Published;
using reports::Status;
using reports::Verdict;

/// A number, or why there is none.
struct Reading {
  std::optional<double> value;
  std::string why;
  bool cell_is_missing = false;
  bool refusal_is_expected = false;
};

Reading unreadable(std::string why) { return {std::nullopt, std::move(why), false, false}; }

bool same_value(const nlohmann::ordered_json &a, const nlohmann::ordered_json &b) {
  if (a.is_number() && b.is_number()) {
    const auto x = a.get<double>();
    const auto y = b.get<double>();
    return std::abs(x - y) <= 1e-12 * std::max(std::abs(x), std::abs(y));
  }
  return a == b;
}

bool matches(const Selector &wanted, const Cell &cell) {
  const auto fits = [](const std::string &want, const std::string &have) { return want.empty() || want == have; };
  if (!fits(wanted.scene, cell.scene) || !fits(wanted.label, cell.label) || !fits(wanted.method, cell.method) ||
      !fits(wanted.level, cell.level) || (wanted.variant && *wanted.variant != cell.variant))
    return false;
  for (const auto &[key, value] : wanted.parameters.items())
    if (!cell.parameters.contains(key) || !same_value(value, cell.parameters[key]))
      return false;
  return true;
}

/// What a name must tell to be understood: in a comparison, only that in which its cells differ.
struct Naming {
  bool scene = false;
  bool level = true;
  bool variant = true;
};

std::string name_of(const Selector &cell, const Naming &naming = {}) {
  std::string name = cell.label.empty() ? cell.method : cell.label;
  for (const auto &[key, value] : cell.parameters.items())
    name += fmt::format(" {}={}", key, value.is_string() ? value.get<std::string>() : value.dump());
  if (naming.level && !cell.level.empty())
    name += ", " + cell.level;
  if (naming.variant && cell.variant && !cell.variant->empty())
    name += ", " + *cell.variant;
  return naming.scene ? fmt::format("{} of {}", name, cell.scene) : name;
}

std::optional<double> quantity_of(const Cell &cell, const std::string &name) {
  if (const auto value = reports::reportable(cell, name))
    return value;
  if (cell.status != Status::ok)
    return std::nullopt;
  constexpr std::string_view prefix = "seconds.";
  if (name.starts_with(prefix))
    return reports::median_seconds(cell, std::string_view(name).substr(prefix.size()));
  for (const auto &[size, value] :
       {std::pair{"n_points", cell.n_points}, std::pair{"n_dofs", cell.n_dofs}, std::pair{"nonzeros", cell.nonzeros},
        std::pair{"steps", cell.steps}, std::pair{"memory_bytes", cell.memory_bytes}})
    if (name == size)
      return static_cast<double>(value);
  return std::nullopt;
}

/// The cells of one benchmark and the questions asked of them.
class Cells {
public:
  Cells(const std::string &benchmark, const std::vector<Cell> &all) {
    for (const Cell &cell : all)
      if (cell.benchmark == benchmark)
        cells_.push_back(&cell);
  }

  bool has_scene(const std::string &scene) const {
    return std::any_of(cells_.begin(), cells_.end(), [&](const Cell *cell) { return cell->scene == scene; });
  }

  Reading read(const Operand &operand) const {
    double spacing = 0;
    Reading reading = read(operand.cell, operand.quantity, spacing);
    if (operand.change == Change::none || !reading.value)
      return reading;
    double reference_spacing = 0;
    Reading reference = read(operand.from, operand.quantity, reference_spacing);
    if (!reference.value)
      return reference;
    const double changed = apply(operand.change, *reading.value, *reference.value, spacing, reference_spacing);
    if (!std::isfinite(changed))
      return unreadable(fmt::format("the change of {} from {} to {} has no value", operand.quantity,
                                    name_of(operand.from), name_of(operand.cell)));
    reading.value = changed;
    return reading;
  }

private:
  Reading read(const Selector &selector, const std::string &quantity, double &spacing) const {
    const Cell *found = nullptr;
    for (const Cell *cell : cells_) {
      if (!matches(selector, *cell))
        continue;
      if (found)
        return unreadable(fmt::format("several cells fit {}", name_of(selector)));
      found = cell;
    }
    if (!found) {
      Reading reading = unreadable(fmt::format("there is no cell {}", name_of(selector)));
      reading.cell_is_missing = true;
      return reading;
    }
    if (found->status != Status::ok) {
      Reading reading = unreadable(fmt::format("{} is {}{}", name_of(selector), reports::to_text(found->status),
                                               found->reason.empty() ? "" : ": " + found->reason));
      reading.refusal_is_expected = found->expected;
      return reading;
    }
    spacing = reports::relative_spacing(*found).value_or(std::numeric_limits<double>::quiet_NaN());
    const auto value = quantity_of(*found, quantity);
    if (!value)
      return unreadable(fmt::format("{} has no finite {}", name_of(selector), quantity));
    return {value, {}, false, false};
  }

  static double apply(Change change, double value, double reference, double spacing, double reference_spacing) {
    switch (change) {
    case Change::difference:
      return value - reference;
    case Change::relative:
      return (value - reference) / std::abs(reference);
    case Change::ratio:
      return value / reference;
    case Change::rate:
      return std::log(reference / value) / std::log(reference_spacing / spacing);
    case Change::none:
      break;
    }
    return value;
  }

  std::vector<const Cell *> cells_;
};

/// Decimal fractions as printed (0.7097 - 0.7087 against 0.001) must not fail by a rounding of the last bit.
bool is_within(double value, double target, double tolerance) {
  const double slack = 8 * std::numeric_limits<double>::epsilon() * std::max({1.0, std::abs(value), std::abs(target)});
  return std::abs(value - target) <= tolerance + slack;
}

bool holds(const Condition &condition, double left, double right) {
  switch (condition.relation) {
  case Relation::less:
    return left < right;
  case Relation::less_or_equal:
    return left <= right;
  case Relation::greater:
    return left > right;
  case Relation::greater_or_equal:
    return left >= right;
  case Relation::within:
    break;
  }
  return is_within(left, right,
                   condition.tolerance.value_or(0) + condition.relative_tolerance.value_or(0) * std::abs(right));
}

const char *symbol(Relation relation, bool satisfied) {
  switch (relation) {
  case Relation::less:
    return satisfied ? "<" : "not <";
  case Relation::less_or_equal:
    return satisfied ? "<=" : "not <=";
  case Relation::greater:
    return satisfied ? ">" : "not >";
  case Relation::greater_or_equal:
    return satisfied ? ">=" : "not >=";
  case Relation::within:
    break;
  }
  return satisfied ? "within tolerance of" : "not within tolerance of";
}

std::string shown(const Operand &operand, double value) {
  if (operand.change == Change::rate)
    return reports::rate(value);
  const bool is_logarithm = operand.quantity.find("log10") != std::string::npos;
  return operand.change == Change::none && is_logarithm ? reports::logarithm(value) : reports::significant(value);
}

/// What the reference cell of a change has that the cell itself has not.
std::string difference_in_name(const Operand &operand, const Naming &naming) {
  if (operand.from.level != operand.cell.level)
    return operand.from.level;
  return name_of(operand.from, naming);
}

std::string described(const Operand &operand, double value, const Naming &naming) {
  std::string name = name_of(operand.cell, naming);
  if (operand.change == Change::rate)
    name += fmt::format(" (rate from {})", difference_in_name(operand, naming));
  else if (operand.change != Change::none)
    name += fmt::format(" (change from {})", difference_in_name(operand, naming));
  return fmt::format("{} = {}", name, shown(operand, value));
}

/// Every cell that an entry looks at.
std::vector<const Selector *> selectors_of(const Entry &entry) {
  std::vector<const Selector *> selectors;
  const auto add = [&](const Operand &operand) {
    selectors.push_back(&operand.cell);
    if (operand.change != Change::none)
      selectors.push_back(&operand.from);
  };
  if (entry.kind == Kind::value)
    add(entry.value);
  for (const Condition &condition : entry.conditions) {
    add(condition.left);
    if (const auto *right = std::get_if<Operand>(&condition.right))
      add(*right);
  }
  return selectors;
}

Naming naming_of(const Entry &entry) {
  const std::vector<const Selector *> cells = selectors_of(entry);
  const auto differ = [&](auto member) {
    return std::any_of(cells.begin(), cells.end(),
                       [&](const Selector *cell) { return cell->*member != cells.front()->*member; });
  };
  return {differ(&Selector::scene), differ(&Selector::level), differ(&Selector::variant)};
}

std::string quantity_name(const Operand &operand) {
  switch (operand.change) {
  case Change::difference:
    return "difference of " + operand.quantity;
  case Change::relative:
    return "relative change of " + operand.quantity;
  case Change::ratio:
    return "ratio of " + operand.quantity;
  case Change::rate:
    return "rate of " + operand.quantity;
  case Change::none:
    break;
  }
  return operand.quantity;
}

struct Outcome {
  Published published;
  bool cell_is_missing = false;
};

void cannot_be_judged(Outcome &outcome, const Reading &reading, const Entry &entry) {
  outcome.cell_is_missing = reading.cell_is_missing;
  outcome.published.finding = reading.why;
  const bool excused = reading.refusal_is_expected && entry.expect == Verdict::not_reproducible;
  outcome.published.verdict = entry.kind == Kind::claim ? Verdict::does_not_hold
                              : excused                 ? Verdict::not_reproducible
                                                        : Verdict::differs;
  outcome.published.expected = excused;
}

void settle_value(Outcome &outcome, const Entry &entry, const Cells &cells) {
  Published &published = outcome.published;
  const Selector &cell = entry.value.cell;
  published.scene = cell.scene;
  published.variant = cell.variant.value_or("");
  published.method = cell.label.empty() ? cell.method : cell.label;
  published.level = cell.level;
  published.quantity = quantity_name(entry.value);
  published.published = entry.published;
  published.tolerance = entry.tolerance;
  const Reading reading = cells.read(entry.value);
  if (!reading.value)
    return cannot_be_judged(outcome, reading, entry);
  published.computed = reading.value;
  const bool reproduced = is_within(*reading.value, entry.published, entry.tolerance);
  if (reproduced)
    published.verdict = Verdict::reproduced;
  else
    published.verdict = entry.expect == Verdict::not_reproducible ? Verdict::not_reproducible : Verdict::differs;
  published.expected = published.verdict == entry.expect;
}

/// All comparisons if they are few, otherwise what decides: those that fail, or one example.
std::string summary_of(const std::vector<std::string> &satisfied, const std::vector<std::string> &missed) {
  constexpr std::size_t few = 3;
  const std::size_t count = satisfied.size() + missed.size();
  if (count <= few)
    return fmt::format("{}{}{}", fmt::join(missed, "; "), missed.empty() || satisfied.empty() ? "" : "; ",
                       fmt::join(satisfied, "; "));
  if (missed.empty())
    return fmt::format("all {} comparisons hold, the first: {}", count, satisfied.front());
  const std::vector<std::string> shown(missed.begin(), missed.begin() + std::min(few, missed.size()));
  return fmt::format("{} of {} comparisons fail: {}{}", missed.size(), count, fmt::join(shown, "; "),
                     missed.size() > few ? " ..." : "");
}

void settle_claim(Outcome &outcome, const Entry &entry, const Cells &cells) {
  Published &published = outcome.published;
  const Operand &first = entry.conditions.front().left;
  published.scene = first.cell.scene;
  published.variant = first.cell.variant.value_or("");
  published.method = first.cell.label.empty() ? first.cell.method : first.cell.label;
  published.level = first.cell.level;
  published.quantity = quantity_name(first);
  published.statement = entry.statement;
  const Naming naming = naming_of(entry);
  std::vector<std::string> satisfied_texts, missed_texts;
  for (const Condition &condition : entry.conditions) {
    const Reading left = cells.read(condition.left);
    if (!left.value)
      return cannot_be_judged(outcome, left, entry);
    const auto *right_operand = std::get_if<Operand>(&condition.right);
    const Reading right =
        right_operand ? cells.read(*right_operand) : Reading{std::get<double>(condition.right), {}, false, false};
    if (!right.value)
      return cannot_be_judged(outcome, right, entry);
    const bool satisfied = holds(condition, *left.value, condition.factor * *right.value);
    if (!published.computed)
      published.computed = left.value;
    const std::string factor = condition.factor == 1 ? "" : reports::exact(condition.factor) + " * ";
    const std::string right_text =
        right_operand ? described(*right_operand, *right.value, naming) : reports::exact(right.value);
    (satisfied ? satisfied_texts : missed_texts)
        .push_back(fmt::format("{} {} {}{}", described(condition.left, *left.value, naming),
                               symbol(condition.relation, satisfied), factor, right_text));
  }
  if (entry.conditions.size() == 1 && std::holds_alternative<double>(entry.conditions.front().right)) {
    published.published = std::get<double>(entry.conditions.front().right);
    published.tolerance = entry.conditions.front().tolerance;
  }
  published.finding = summary_of(satisfied_texts, missed_texts);
  published.verdict = missed_texts.empty() ? Verdict::holds : Verdict::does_not_hold;
  published.expected = published.verdict == entry.expect;
}

} // namespace

std::vector<Published> settle(const std::vector<Entry> &entries, const std::vector<Cell> &cells, MissingCells missing) {
  std::vector<Published> settled;
  for (const Entry &entry : entries) {
    const Cells own(entry.benchmark, cells);
    const std::vector<const Selector *> asked = selectors_of(entry);
    if (!std::all_of(asked.begin(), asked.end(), [&](const Selector *cell) { return own.has_scene(cell->scene); }))
      continue;
    Outcome outcome;
    outcome.published.source = entry.source;
    outcome.published.entry = entry.entry;
    outcome.published.benchmark = entry.benchmark;
    outcome.published.kind = entry.kind;
    outcome.published.remark = entry.remark;
    if (entry.kind == Kind::value)
      settle_value(outcome, entry, own);
    else
      settle_claim(outcome, entry, own);
    if (outcome.cell_is_missing && missing == MissingCells::leave_out)
      continue;
    settled.push_back(std::move(outcome.published));
  }
  return settled;
}

} // namespace comparisons::ledger
