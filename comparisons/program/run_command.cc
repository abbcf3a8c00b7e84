#include "comparisons/program/run_command.h"

#include "comparisons/hard_cases/case_table.h"
#include "comparisons/hard_cases/report_cells.h"
#include "comparisons/ledger/ledger.h"
#include "comparisons/metrics/machine.h"
#include "comparisons/program/data_files.h"
#include "comparisons/program/interrupt.h"
#include "comparisons/reports/answers.h"
#include "comparisons/reports/files.h"
#include "comparisons/reports/output_lock.h"
#include "comparisons/reports/reports.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/run_scene.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <set>
#include <stdexcept>
#include <unistd.h>

namespace comparisons::program {

namespace fs = std::filesystem;

namespace {

/// What a run is about to do; complete before anything is computed.
struct Plan {
  std::vector<scene::Scene> scenes;
  fs::path directory;
  std::vector<std::string> formats;
  bool brief = false; ///< on the terminal; the files hold everything
  ledger::MissingCells missing = ledger::MissingCells::count_as_missed;
  /// The matrix of hard cases beside the scenes: the quick cases or all.
  enum class HardCases { none, quick, all } hard_cases = HardCases::none;
};

void print_diagnostics(const scene::Diagnostics &diagnostics) {
  if (!diagnostics.all().empty())
    fmt::print(stderr, "{}", scene::to_text(diagnostics));
}

void print_diagnostic(const scene::Diagnostic &diagnostic) { fmt::print(stderr, "{}\n", scene::to_text(diagnostic)); }

/// Reads all scenes; nothing if one has an error (all findings are printed).
std::optional<std::vector<scene::Scene>> read_scenes(const std::vector<fs::path> &files, const CommonOptions &options,
                                                     const study::Catalogue &catalogue) {
  const auto vocabulary = study::vocabulary_of(catalogue);
  const auto overrides = options.overrides();
  std::vector<scene::Scene> scenes;
  bool valid = true;
  for (const auto &file : files) {
    auto result = scene::read_scene(file, overrides, vocabulary);
    if (!options.quiet || result.diagnostics.has_errors())
      print_diagnostics(result.diagnostics);
    if (result.scene)
      scenes.push_back(std::move(*result.scene));
    else
      valid = false;
  }
  if (!valid)
    return {};
  return scenes;
}

void add_effects(const std::vector<scene::Scene> &scenes, const study::Catalogue &catalogue,
                 reports::Results &results) {
  std::set<std::string> active;
  for (const auto &scene : scenes)
    active.insert(scene.effects.begin(), scene.effects.end());
  for (const auto &effect : study::vocabulary_of(catalogue).effects)
    (active.contains(effect.name) ? results.effects_active : results.effects_absent).push_back(effect.name);
}

void add_scene_json(const std::vector<scene::Scene> &scenes, reports::Results &results) {
  if (scenes.size() == 1) {
    results.scene = scene::to_json(scenes.front());
    return;
  }
  results.scene = nlohmann::ordered_json::array();
  for (const auto &scene : scenes)
    results.scene.push_back(scene::to_json(scene));
}

/// Progress on one line of the terminal. Elsewhere only long cells are worth a line, one every ten seconds.
class Progress {
public:
  explicit Progress(bool quiet) : quiet_(quiet), on_(!quiet && isatty(STDERR_FILENO) == 1) {}
  ~Progress() { show({}); }
  Progress(const Progress &) = delete;
  Progress &operator=(const Progress &) = delete;

  void show(const std::string &text) {
    cell_ = text;
    last_line_ = Clock::now();
    if (!on_)
      return;
    fmt::print(stderr, "\r\033[K{}", text);
    std::fflush(stderr);
  }

  /// From within the cell shown last.
  void show_within(const std::string &text) {
    if (on_) {
      fmt::print(stderr, "\r\033[K{}: {}", cell_, text);
      std::fflush(stderr);
    } else if (!quiet_ && Clock::now() - last_line_ >= std::chrono::seconds(10)) {
      fmt::print(stderr, "{}: {}\n", cell_, text);
      last_line_ = Clock::now();
    }
  }

private:
  using Clock = std::chrono::steady_clock;
  bool quiet_;
  bool on_;
  std::string cell_;
  Clock::time_point last_line_ = Clock::now();
};

void settle_published(const Plan &plan, reports::Results &results) {
  std::set<std::string> benchmarks;
  for (const auto &scene : plan.scenes)
    benchmarks.insert(scene.benchmark);
  for (const auto &benchmark : benchmarks) {
    const auto file = published_file(benchmark);
    if (!fs::exists(file))
      continue;
    auto settled = ledger::settle(ledger::load_published(file), results.cells, plan.missing);
    results.published.insert(results.published.end(), settled.begin(), settled.end());
  }
}

void add_hard_cases(const Plan &plan, bool quiet, const study::Catalogue &catalogue, study::CellJournal &journal,
                    reports::Results &results) {
  const auto cases =
      hard_cases::select(hard_cases::case_table(catalogue),
                         {.cases = {}, .methods = {}, .quick = plan.hard_cases == Plan::HardCases::quick});
  Progress progress(quiet);
  hard_cases::MatrixOptions options;
  options.stop_requested = [] { return Interrupt::requested(); };
  options.progress = [&](const std::string &text) { progress.show(text); };
  auto cells =
      hard_cases::run_reported_matrix(cases, options, journal, study::identity_of(results.program, results.machine));
  results.cells.insert(results.cells.end(), std::make_move_iterator(cells.begin()),
                       std::make_move_iterator(cells.end()));
}

int execute(const Plan &plan, const CommonOptions &options, const study::Catalogue &catalogue, bool with_ledger) {
  std::optional<reports::OutputLock> lock;
  try {
    reports::prepare_output_directory(plan.directory);
    lock.emplace(plan.directory);
    if (!plan.scenes.empty())
      fs::create_directories(plan.directory / "series");
  } catch (const std::exception &error) {
    const auto place = plan.scenes.empty() ? scene::Location() : plan.scenes.front().output.location("directory");
    print_diagnostic({scene::Severity::error, place, "output.directory", error.what(),
                      "name another folder, here or with --output"});
    return invalid_scene;
  }
  std::set<int> threads;
  for (const auto &scene : plan.scenes)
    threads.insert(static_cast<int>(scene.study.integer("threads")));
  reports::Results results;
  results.program = metrics::describe_program();
  results.machine = metrics::describe_machine(threads.empty() ? 1 : *threads.rbegin());
  meshless::linear_algebra::Stopwatch watch;
  add_scene_json(plan.scenes, results);
  add_effects(plan.scenes, catalogue, results);

  const Interrupt interrupt;
  const metrics::CompetingWork others;
  study::CellJournal journal(plan.directory / ".cells", options.resume);
  {
    Progress progress(options.quiet);
    study::RunOptions run;
    run.isolate = options.isolate;
    run.directory = plan.directory;
    run.journal = &journal;
    run.stop_requested = [] { return Interrupt::requested(); };
    run.progress = [&](const std::string &text) { progress.show(text); };
    run.long_progress = [&](const std::string &text) { progress.show_within(text); };
    for (const auto &scene : plan.scenes) {
      if (Interrupt::requested())
        break;
      auto cells = study::run_scene(scene, catalogue, run);
      results.cells.insert(results.cells.end(), std::make_move_iterator(cells.begin()),
                           std::make_move_iterator(cells.end()));
    }
  }
  if (plan.hard_cases != Plan::HardCases::none && !Interrupt::requested())
    add_hard_cases(plan, options.quiet, catalogue, journal, results);
  results.interrupted = Interrupt::requested();
  results.machine.competing_cores = others.cores();
  results.machine.load_at_end = metrics::current_load();
  results.not_comparable = metrics::reasons_not_comparable(results.program, results.machine, threads, watch.lap());
  if (const auto n = journal.n_recalled(); n > 0) {
    results.not_comparable.push_back(
        fmt::format("{} of {} cells were timed, at least in part, by an earlier run, which was interrupted", n,
                    results.cells.size()));
    if (!options.quiet)
      fmt::print(stderr, "{} of {} cells were kept from an earlier run\n", n, results.cells.size());
  }
  results.equal_error = reports::equal_errors(results);
  if (with_ledger && !results.interrupted)
    settle_published(plan, results);

  std::vector<std::string> complaints;
  const auto files =
      reports::write_reports(results, plan.directory, plan.formats, "results", {page_directory(), {}}, &complaints);
  for (const std::string &complaint : complaints)
    fmt::print(stderr, "warning: {}\n", complaint);
  if (results.published.empty()) {
    // The ledger of an earlier run in this folder would pass for this one's.
    std::error_code ignored;
    fs::remove(plan.directory / "results_published.csv", ignored);
  }
  fmt::print("{}", plan.brief ? reports::brief_report(results) : reports::text_report(results));
  std::fflush(stdout);
  std::string names;
  for (const auto &file : files)
    names += " " + file.string();
  if (!results.interrupted)
    journal.remove();
  else if (!options.quiet)
    fmt::print(stderr, "\nInterrupted; the same command with --resume goes on with the cells that are missing\n");
  if (!options.quiet)
    fmt::print(stderr, "\nWritten:{} and curves in {}\n", names, (plan.directory / "series").string());
  return exit_code_of(results);
}

} // namespace

namespace {

/// As TOML reads it.
std::string quoted(const char *option, const nlohmann::json &value) {
  try {
    return value.dump();
  } catch (const nlohmann::json::type_error &) {
    throw std::invalid_argument(fmt::format("{}: the text is not UTF-8", option));
  }
}

} // namespace

std::vector<std::string> CommonOptions::overrides() const {
  std::vector<std::string> result = sets;
  if (output)
    result.push_back("output.directory=" + quoted("--output", *output));
  if (!formats.empty())
    result.push_back("output.formats=" + quoted("--format", formats));
  if (threads)
    result.push_back(fmt::format("study.threads={}", *threads));
  if (repeats)
    result.push_back(fmt::format("study.repeats={}", *repeats));
  return result;
}

int run_scenes(const std::vector<fs::path> &files, const CommonOptions &options, const study::Catalogue &catalogue) {
  auto scenes = read_scenes(files, options, catalogue);
  if (!scenes)
    return invalid_scene;
  Plan plan;
  plan.directory = scenes->front().output.text("directory");
  plan.formats = scenes->front().formats;
  plan.scenes = std::move(*scenes);
  // A user's own scene is held against the papers only when it is one of the shipped files.
  bool shipped = options.sets.empty();
  for (const auto &file : files) {
    std::error_code error;
    shipped = shipped && fs::weakly_canonical(file, error)
                             .string()
                             .starts_with(fs::weakly_canonical(benchmarks_directory(), error).string() + "/");
  }
  return execute(plan, options, catalogue, shipped);
}

int compare_benchmarks(const std::vector<std::string> &benchmarks, bool full, const CommonOptions &options,
                       const study::Catalogue &catalogue) {
  std::vector<std::string> known;
  for (const auto &benchmark : catalogue.benchmarks)
    if (!benchmark.description.own_geometry)
      known.push_back(benchmark.description.name);
  known.emplace_back(hard_cases::benchmark_name);
  const auto all = known;
  known.emplace_back("examples");
  std::vector<fs::path> files;
  for (const auto &name : benchmarks.empty() ? all : benchmarks) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const auto near = scene::nearest_name(name, known);
      const std::string hint = name.ends_with(".toml") ? fmt::format(" (a scene is run by: petrov run {})", name)
                               : near.empty()          ? std::string()
                                                       : fmt::format(" (did you mean '{}'?)", near);
      fmt::print(stderr, "error: no benchmark '{}'; there are {}{}\n", name, fmt::join(known, ", "), hint);
      return usage_error;
    }
    if (name == hard_cases::benchmark_name)
      continue; // has no scenes
    const auto scenes = name == "examples" ? example_scenes() : shipped_scenes(name);
    files.insert(files.end(), scenes.begin(), scenes.end());
  }
  auto scenes = read_scenes(files, options, catalogue);
  if (!scenes)
    return invalid_scene;
  Plan plan;
  const auto &chosen = benchmarks.empty() ? all : benchmarks;
  if (std::find(chosen.begin(), chosen.end(), hard_cases::benchmark_name) != chosen.end())
    plan.hard_cases = full ? Plan::HardCases::all : Plan::HardCases::quick;
  if (!options.sets.empty())
    plan.missing = ledger::MissingCells::leave_out;
  plan.directory = options.output.value_or("out");
  plan.brief = true;
  if (scenes->empty())
    plan.formats = options.formats.empty() ? std::vector<std::string>{"text", "md", "csv", "json", "tex", "html"}
                                           : options.formats;
  else
    plan.formats = scenes->front().formats;
  for (auto &scene : *scenes)
    if (full || scene.study.text("effort") == "quick")
      plan.scenes.push_back(std::move(scene));
  return execute(plan, options, catalogue, true);
}

int exit_code_of(const reports::Results &results) {
  if (results.interrupted)
    return interrupted;
  bool limit = false;
  bool failed = false;
  bool missed = false;
  for (const auto &cell : results.cells)
    if (!cell.expected)
      (cell.status == reports::Status::limit ? limit : failed) = true;
  for (const auto &entry : results.published)
    missed = missed || !entry.expected;
  return limit ? limit_reached : failed ? cell_failed : missed ? published_missed : all_as_expected;
}

} // namespace comparisons::program
