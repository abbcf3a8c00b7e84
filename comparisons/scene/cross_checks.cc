#include "comparisons/scene/scene_reader.h"

#include <fmt/format.h>

#include <exception>
#include <set>

namespace comparisons::scene {

namespace {

/// Calls the checks of benchmark and methods and keeps each finding once.
///
/// The checks also run when some table has findings, so that one pass shows as much as possible:
/// wrong values are then replaced by defaults. What a check says about a table with findings is
/// kept only if it is about a value that the scene gives, not about a default.
class CheckRunner {
public:
  CheckRunner(Location file, Diagnostics &diagnostics) : file_(std::move(file)), diagnostics_(diagnostics) {}

  /// Findings without a place about keys that begin with `prefix` are kept only if `valid`.
  struct Trust {
    std::string prefix;
    bool valid = true;
  };

  void run(const Check &check, const CheckContext &context, const std::vector<Trust> &trusts, const Location &fallback,
           const std::string &who) {
    if (!check)
      return;
    Diagnostics found;
    try {
      check(context, found);
    } catch (const std::exception &exception) {
      found.error({}, {}, fmt::format("the check of {} failed: {}", who, exception.what()));
    }
    for (Diagnostic diagnostic : found.all()) {
      const bool placed = !diagnostic.location.file.empty();
      if (!placed && !is_trusted(diagnostic.key, trusts))
        continue;
      if (!placed)
        diagnostic.location = fallback.file.empty() ? file_ : fallback;
      if (seen_.insert(to_text(diagnostic)).second)
        diagnostics_.add(std::move(diagnostic));
    }
  }

private:
  static bool is_trusted(const std::string &key, const std::vector<Trust> &trusts) {
    bool all = true;
    for (const Trust &trust : trusts) {
      if (key == trust.prefix || key.starts_with(trust.prefix + "."))
        return trust.valid;
      all = all && trust.valid;
    }
    return all;
  }

  Location file_;
  Diagnostics &diagnostics_;
  std::set<std::string> seen_;
};

/// Stands in when no level of the scene is valid: fine enough that no check finds it too coarse.
Level stand_in(int counts_per_level) {
  constexpr int fine = 64;
  Level level;
  level.counts.assign(static_cast<std::size_t>(counts_per_level), fine);
  level.text = fmt::format("{}", fmt::join(level.counts, "x"));
  return level;
}

} // namespace

void SceneReader::cross_check() {
  if (benchmark_ == nullptr || !problem_.complete || !material_.complete || !time_.complete)
    return;
  const Parameters material = std::move(material_.combinations().front().parameters);
  const Parameters no_method;
  const Parameters time = std::move(time_.combinations().front().parameters);
  CheckRunner runner(here(), diagnostics_);
  const std::vector<Level> replacement{stand_in(benchmark_->counts_per_level)};
  const auto usable = [&](const std::vector<Level> &levels) -> const std::vector<Level> & {
    return levels.empty() ? replacement : levels;
  };

  std::vector<Level> levels;
  std::set<std::string> texts;
  const auto collect = [&](const std::vector<Level> &some) {
    for (const Level &level : some)
      if (texts.insert(level.text).second)
        levels.push_back(level);
  };
  if (scene_.methods.empty())
    collect(scene_.levels); // else those that a method uses
  for (const auto &method : methods_)
    collect(method.levels);

  const std::vector<CheckRunner::Trust> common{
      {"material", material_.valid}, {"problem", problem_.valid}, {"time", time_.valid}};
  for (const auto &variant : scene_.problems)
    for (const auto &level : usable(levels))
      runner.run(
          benchmark_->check,
          {material, variant.parameters, no_method, level, {}, scene_.effects, &scene_.effect_parameters, &time},
          [&] {
            auto trusts = common;
            trusts.push_back({"study", !levels.empty()});
            return trusts;
          }(),
          here(), benchmark_->name);

  for (std::size_t i = 0; i < scene_.methods.size(); ++i) {
    const MethodRequest &request = scene_.methods[i];
    const MethodTable &owner = methods_[owners_[i]];
    if (!owner.table.complete)
      continue;
    const bool has_levels = !request.levels.empty();
    auto trusts = common;
    trusts.push_back({owner.key + ".levels", has_levels});
    trusts.push_back({owner.key, owner.table.valid});
    trusts.push_back({"study", has_levels});
    for (const auto &variant : scene_.problems)
      for (const auto &level : usable(request.levels))
        runner.run(owner.description->check,
                   {material, variant.parameters, request.parameters, level, owner.key, scene_.effects,
                    &scene_.effect_parameters, &time},
                   trusts, request.location, owner.description->name);
  }
}

} // namespace comparisons::scene
