#include "comparisons/study/run_scene.h"

#include "comparisons/metrics/machine.h"
#include "comparisons/metrics/ready_memory.h"
#include "comparisons/reports/json.h"
#include "comparisons/study/cell_run.h"
#include "comparisons/study/isolation.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

namespace comparisons::study {

namespace {

/// A cell that takes longer is run once.
constexpr double long_cell_seconds = 10;
/// Repeats that took less together are not worth a line of the journal, which holds all repeats so far: a thousand
/// short ones would write half a million.
constexpr double least_kept_seconds = 0.1;
/// Memory is made ready for cells that need at least this much: they take a second or more.
constexpr double least_ready_bytes = 256 << 20;
constexpr double most_ready_bytes = 1e15;

/// A cell with the seconds of its repeats.
struct Measured : KeptCell {
  CellTask task;
  bool warm = false; ///< has run in this process
  double bytes = 0;  ///< estimate of its memory; 0: none
  double unkept_seconds = 0;
};

/// The cells of a scene in the order of the tables: variant, method, level.
class SceneRun {
public:
  SceneRun(const scene::Scene &scene, const Catalogue &catalogue, const RunOptions &options)
      : scene_(scene), options_(options) {
    if (scene.study.has("max_seconds"))
      limits_.seconds = scene.study.real("max_seconds");
    if (scene.study.has("max_memory"))
      limits_.memory_bytes = scene.study.integer("max_memory");
    if (options.journal != nullptr)
      identity_ = identity_of(scene, metrics::describe_program(),
                              metrics::describe_machine(static_cast<int>(scene.study.integer("threads"))));
    isolate_ = options.isolate || limits_.seconds || limits_.memory_bytes;
    const auto &benchmark = find_benchmark(catalogue, scene.benchmark);
    for (const auto &variant : scene.problems) {
      experiments_.push_back(benchmark.make_experiment(scene, variant, catalogue.methods));
      experiments_.back()->report_to(options.long_progress);
      for (const auto &request : scene.methods)
        for (const auto &level : request.levels)
          measured_.push_back({{}, {&scene, &variant, experiments_.back().get(), &request, &level}});
    }
  }

  std::vector<reports::Cell> run() {
    metrics::use_threads(static_cast<int>(scene_.study.integer("threads")));
    prepare();
    const auto repeats = static_cast<int>(scene_.study.integer("repeats"));
    std::size_t n_finished = 0;
    for (auto &measured : measured_) {
      if (stopped())
        break;
      report_progress(measured, n_finished);
      if (!recall(measured))
        first_run(measured);
      if (stopped())
        break; // the cell was cut short
      ++n_finished;
    }
    for (int repeat = 0; repeat < repeats && !stopped(); ++repeat)
      for (std::size_t i = 0; i < n_finished && !stopped(); ++i)
        if (n_repeats(measured_[i]) <= repeat)
          repeat_run(measured_[i]);
    std::vector<reports::Cell> cells;
    for (std::size_t i = 0; i < n_finished; ++i) {
      summarise(measured_[i]);
      cells.push_back(std::move(measured_[i].cell));
    }
    return cells;
  }

private:
  void prepare() const {
    for (const auto &experiment : experiments_)
      try {
        experiment->prepare();
      } catch (const std::exception &) {
        // Each cell asks again, and its reason tells.
      }
  }

  bool stopped() const { return options_.stop_requested && options_.stop_requested(); }

  void report_progress(const Measured &measured, std::size_t n_finished) const {
    if (options_.progress)
      options_.progress(fmt::format("{}/{}: cell {} of {}: {} {}", scene_.benchmark, scene_.name, n_finished + 1,
                                    measured_.size(), measured.task.request->label, measured.task.level->text));
  }

  /// Takes what an earlier run has of a cell.
  bool recall(Measured &measured) const {
    if (options_.journal == nullptr)
      return false;
    auto kept = options_.journal->recall(identity_, describe_cell(measured.task));
    if (kept)
      static_cast<KeptCell &>(measured) = std::move(*kept);
    return kept.has_value();
  }

  void keep(const Measured &measured) const {
    if (options_.journal != nullptr)
      options_.journal->keep(identity_, measured);
  }

  static int n_repeats(const Measured &measured) {
    const auto total = measured.samples.find("total");
    return total == measured.samples.end() ? 0 : static_cast<int>(total->second.size());
  }

  /// Bytes that a run should find ready; 0 for a cell that need not. A long cell runs once, without warm-up, and the
  /// repeats of a large one are far apart.
  std::int64_t bytes_to_ready(const Measured &measured) const {
    double bytes = measured.cell.memory_bytes > 0 ? static_cast<double>(measured.cell.memory_bytes) : measured.bytes;
    if (limits_.memory_bytes)
      bytes = std::min(bytes, static_cast<double>(*limits_.memory_bytes));
    return bytes >= least_ready_bytes ? static_cast<std::int64_t>(std::min(bytes, most_ready_bytes)) : 0;
  }

  reports::Cell run_once(const Measured &measured, bool with_errors) {
    const CellTask &task = measured.task;
    const metrics::ReadyMemory ready(bytes_to_ready(measured), options_.stop_requested);
    if (stopped()) { // meanwhile: there may be much to make ready
      reports::Cell cell = describe_cell(task);
      cell.status = reports::Status::failed;
      cell.reason = "interrupted";
      return cell;
    }
    const std::filesystem::path series =
        with_errors && options_.write_series ? options_.directory : std::filesystem::path();
    if (!isolate_)
      return run_cell(task, with_errors, series);
    const auto outcome = run_isolated(
        [&] {
          reports::Results results;
          results.cells.push_back(run_cell(task, with_errors, series));
          return reports::json_text(results);
        },
        limits_, options_.stop_requested);
    using Kind = IsolatedOutcome::Kind;
    if (outcome.kind == Kind::finished) {
      auto cell = reports::parse_results(outcome.payload).cells.at(0);
      if (cell.status == reports::Status::limit && limits_.memory_bytes)
        cell.reason = fmt::format("needs more than max_memory = {} bytes: {}", *limits_.memory_bytes, cell.reason);
      return cell;
    }
    reports::Cell cell = describe_cell(task);
    const bool limit = outcome.kind == Kind::out_of_time || outcome.kind == Kind::out_of_memory;
    cell.status = limit ? reports::Status::limit : reports::Status::failed;
    cell.reason = outcome.reason;
    return cell;
  }

  static double estimated_bytes(const CellTask &task) {
    try {
      return task.experiment->estimate(*task.request, *task.level).bytes;
    } catch (const std::exception &) {
      return 0; // what is wrong with the level, the run itself will say
    }
  }

  /// Why a cell is hopeless on this machine; empty if it is not. The estimate may be too high by a factor of
  /// about 2, so only what exceeds that is refused beforehand.
  static std::string too_large(double bytes) {
    const double memory = static_cast<double>(metrics::describe_machine(1).memory_bytes);
    if (memory > 0 && bytes > 2 * memory)
      return fmt::format("would need about {:.0f} GB, more than this machine has ({:.0f} GB); choose a coarser level",
                         bytes / 1e9, memory / 1e9);
    return {};
  }

  void first_run(Measured &measured) {
    const bool refused = !measured.task.request->refused.empty();
    if (!refused)
      measured.bytes = estimated_bytes(measured.task);
    if (refused) {
      measured.cell = describe_cell(measured.task);
      measured.cell.status = reports::Status::refused;
      measured.cell.reason = measured.task.request->refused;
    } else if (const auto reason = too_large(measured.bytes); !reason.empty()) {
      measured.cell = describe_cell(measured.task);
      measured.cell.status = reports::Status::limit;
      measured.cell.reason = reason;
    } else
      measured.cell = run_once(measured, true);
    measured.cell.expected = measured.task.request->expect == reports::to_text(measured.cell.status);
    const auto total = measured.cell.seconds.find("total");
    // The first run is the warm-up, unless the cell is long: then it is the only one.
    if (measured.cell.status != reports::Status::ok || total == measured.cell.seconds.end())
      measured.done = true;
    else if (total->second.median > long_cell_seconds) {
      measured.done = true;
      measured.cell.warnings.push_back(fmt::format("longer than {} s: timed once, without warm-up", long_cell_seconds));
      keep_seconds(measured, measured.cell);
    }
    measured.warm = true;
    if (!stopped())
      keep(measured);
  }

  void repeat_run(Measured &measured) {
    if (measured.done)
      return;
    if (!measured.warm)
      run_once(measured, false); // its first run was another process's
    measured.warm = true;
    if (stopped())
      return;
    const auto cell = run_once(measured, false);
    if (cell.status != reports::Status::ok) {
      if (stopped())
        return;
      measured.cell.warnings.push_back("a repeat ended with '" + cell.reason + "'");
      measured.done = true;
      keep(measured);
      return;
    }
    keep_seconds(measured, cell);
    measured.cell.memory_bytes = std::max(measured.cell.memory_bytes, cell.memory_bytes);
    if (const auto total = cell.seconds.find("total"); total != cell.seconds.end())
      measured.unkept_seconds += total->second.median;
    if (measured.unkept_seconds >= least_kept_seconds || n_repeats(measured) >= scene_.study.integer("repeats")) {
      keep(measured);
      measured.unkept_seconds = 0;
    }
  }

  static void keep_seconds(Measured &measured, const reports::Cell &cell) {
    for (const auto &[phase, spread] : cell.seconds)
      if (phase != "evaluation")
        measured.samples[phase].push_back(spread.median);
  }

  static void summarise(Measured &measured) {
    for (auto &[phase, samples] : measured.samples) {
      std::sort(samples.begin(), samples.end());
      const std::size_t n = samples.size();
      const double median = n % 2 == 1 ? samples[n / 2] : 0.5 * (samples[n / 2 - 1] + samples[n / 2]);
      measured.cell.seconds[phase] = {median, samples.front(), samples.back()};
    }
    measured.cell.repeats = n_repeats(measured);
  }

  const scene::Scene &scene_;
  const RunOptions &options_;
  Limits limits_;
  bool isolate_ = false;
  std::string identity_; ///< for the journal
  std::vector<std::unique_ptr<Experiment>> experiments_;
  std::vector<Measured> measured_;
};

} // namespace

std::vector<reports::Cell> run_scene(const scene::Scene &scene, const Catalogue &catalogue, const RunOptions &options) {
  auto cells = SceneRun(scene, catalogue, options).run();
  if (const auto &finish = find_benchmark(catalogue, scene.benchmark).finish)
    finish(cells);
  return cells;
}

const Benchmark &find_benchmark(const Catalogue &catalogue, const std::string &name) {
  for (const auto &benchmark : catalogue.benchmarks)
    if (benchmark.description.name == name)
      return benchmark;
  throw std::invalid_argument(fmt::format("no benchmark '{}'", name));
}

} // namespace comparisons::study
