#include "comparisons/program/program.h"

#include "comparisons/metrics/machine.h"
#include "comparisons/program/describe_command.h"
#include "comparisons/program/options.h"
#include "comparisons/program/run_command.h"
#include "comparisons/program/verify_command.h"
#include "comparisons/scene/diagnostics.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

namespace comparisons::program {

namespace {

std::string version_text() {
  const auto program = metrics::describe_program();
  return fmt::format("petrov {} (commit {}, {} build)", program.version, program.commit, program.build_type);
}

/// The limits of the scene's own keys, with a message that says them.
CLI::Validator whole_number(int lowest, int highest) {
  return {[lowest, highest](const std::string &text) {
            int value = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
            const bool good =
                error == std::errc() && end == text.data() + text.size() && value >= lowest && value <= highest;
            return good ? std::string() : fmt::format("'{}' is no whole number from {} to {}", text, lowest, highest);
          },
          fmt::format("{}...{}", lowest, highest)};
}

void add_common_options(CLI::App &command, CommonOptions &options) {
  command.add_option("--output", options.output, "folder of the results (default: the scene's, else 'out')")
      ->type_name("DIR");
  command.add_option("--format", options.formats, "formats of the reports, separated by commas")
      ->delimiter(',')
      ->type_name("LIST")
      ->allow_extra_args(false); // else it would take the scene that follows
  command.add_option("--set", options.sets, "override a key of the scene, e.g. material.nu=0.4999; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_option("--threads", options.threads, "threads of every method")->check(whole_number(1, 1024));
  command.add_option("--repeats", options.repeats, "timed runs of every cell")->check(whole_number(1, 1000));
  command.add_flag("--quiet", options.quiet, "no progress and no messages but errors");
  command.add_flag("--isolate", options.isolate, "run every cell in a process of its own");
  command.add_flag("--resume", options.resume, "go on with an interrupted run of the same command");
}

/// Parses; returns an exit code if the program is to end here (help, version, a usage error).
std::optional<int> parse(CLI::App &app, int argc, const char *const *argv) {
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::ParseError &error) {
    return app.exit(error) == 0 ? all_as_expected : usage_error;
  }
}

/// The first word must be a command, or an option such as --help; says what is wrong otherwise.
bool names_a_command(const CLI::App &app, int argc, const char *const *argv) {
  const std::string word = argc > 1 ? argv[1] : "";
  if (word.starts_with("-"))
    return true;
  std::vector<std::string> commands;
  for (const auto *command : app.get_subcommands({}))
    commands.push_back(command->get_name());
  if (std::find(commands.begin(), commands.end(), word) != commands.end())
    return true;
  const auto near = scene::nearest_name(word, commands);
  fmt::print(stderr, "error: {}; the commands are {}{}\nRun with --help for more information.\n",
             argc > 1 ? "no command " + scene::in_quotes(word) : "no command is given", fmt::join(commands, ", "),
             near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near));
  return false;
}

/// Runs a command; what it throws is a defect or the system's failure, and is told as such.
template <typename Command>
int guarded(const Command &command) {
  try {
    return command();
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return invalid_scene;
  }
}

} // namespace

int run_program(int argc, const char *const *argv, const study::Catalogue &catalogue) {
  CLI::App app("Petrov: meshless methods and finite elements, side by side", "petrov");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  app.footer("Exit codes: 0 as expected, 2 usage, 3 invalid scene or unwritable output, 4 a cell failed,\n"
             "5 a published number missed, 6 a limit reached, 130 interrupted.");
  CommonOptions options;
  std::vector<std::string> names;
  std::string name;
  std::string file;
  bool quick = false;
  bool full = false;
  int code = 0;

  auto *run = app.add_subcommand("run", "run scenes and write their reports");
  run->add_option("SCENE", names, "scene files (TOML)")->required();
  add_common_options(*run, options);
  run->callback([&] { code = guarded([&] { return run_scenes({names.begin(), names.end()}, options, catalogue); }); });

  auto *compare = app.add_subcommand("compare", "run the shipped scenes and compare with the papers");
  compare->add_option("BENCHMARK", names, "benchmarks; all when none is named");
  auto *quick_flag = compare->add_flag("--quick", quick, "every benchmark, at most 3 minutes (default)");
  compare->add_flag("--full", full, "everything")->excludes(quick_flag);
  add_common_options(*compare, options);
  compare->callback([&] { code = guarded([&] { return compare_benchmarks(names, full, options, catalogue); }); });

  auto *check = app.add_subcommand("check", "validate scenes without solving");
  check->add_option("SCENE", names, "scene files (TOML)")->required();
  add_common_options(*check, options);
  check->callback([&] {
    code = guarded([&] { return check_scenes({names.begin(), names.end()}, options, catalogue); });
  });

  auto *explain = app.add_subcommand("explain", "what a scene calls for, its cost, and what each key means");
  explain->add_option("SCENE", name, "scene file (TOML)")->required();
  add_common_options(*explain, options);
  explain->callback([&] { code = guarded([&] { return explain_scene(name, options, catalogue); }); });

  auto *list = app.add_subcommand("list", "list methods, bases, kernels, effects or benchmarks");
  list->add_option("WHAT", name, "methods|bases|kernels|effects|benchmarks")->required();
  list->callback([&] { code = guarded([&] { return list_names(name, catalogue); }); });

  auto *init = app.add_subcommand("init", "write a scene to start from");
  init->add_option("BENCHMARK", name, "benchmark to start from")->required();
  init->add_option("FILE", file, "file to write, '-' for the terminal (default BENCHMARK.toml)");
  init->callback([&] {
    code = guarded([&] { return write_initial_scene(name, file.empty() ? name + ".toml" : file, catalogue); });
  });

  auto *report = app.add_subcommand("report", "rebuild the reports of a run, or put two runs side by side");
  report->add_option("RESULTS", names, "results.json of a run, or of two")->required()->expected(1, 2);
  add_common_options(*report, options);
  report->callback([&] {
    code = guarded([&] {
      return names.size() == 2 ? compare_runs(names[0], names[1], options) : rebuild_report(names[0], options);
    });
  });

  VerifyOptions verification;
  auto *verify_command = app.add_subcommand("verify", "which hard cases each method survives, with figures");
  verify_command->add_flag("--quick", verification.quick, "the quick cases, under a minute");
  verify_command->add_flag("--list", verification.list, "what the cases are, their references and thresholds");
  verify_command->add_option("--cases", verification.cases, "parts of their names, separated by commas")
      ->delimiter(',')
      ->type_name("LIST");
  verify_command->add_option("--methods", verification.methods, "parts of their labels, separated by commas")
      ->delimiter(',')
      ->type_name("LIST");
  verify_command->add_option("--json", verification.json, "write the matrix to this file")->type_name("FILE");
  verify_command->add_option("--max-seconds", verification.max_seconds, "limit of one cell")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS");
  verify_command->add_flag("--quiet", verification.quiet, "no progress");
  verify_command->callback([&] { code = guarded([&] { return verify(verification, catalogue); }); });

  if (!names_a_command(app, argc, argv))
    return usage_error;
  const auto ended = parse(app, argc, argv);
  return ended.value_or(code);
}

int run_comparison(const std::string &benchmark, int argc, const char *const *argv, const study::Catalogue &catalogue) {
  CLI::App app("Petrov: the benchmark " + benchmark + " beside its papers", "compare_" + benchmark);
  app.set_version_flag("--version", version_text());
  CommonOptions options;
  bool quick = false;
  bool full = false;
  auto *quick_flag = app.add_flag("--quick", quick, "the quick scenes (default)");
  app.add_flag("--full", full, "all scenes")->excludes(quick_flag);
  add_common_options(app, options);
  if (const auto ended = parse(app, argc, argv))
    return *ended;
  return guarded([&] { return compare_benchmarks({benchmark}, full, options, catalogue); });
}

} // namespace comparisons::program
