#include "comparisons/program/describe_command.h"

#include "comparisons/program/data_files.h"
#include "comparisons/program/geometry_description.h"
#include "comparisons/reports/files.h"
#include "comparisons/reports/json.h"
#include "comparisons/reports/latex.h"
#include "comparisons/reports/reports.h"
#include "comparisons/reports/side_by_side.h"
#include "comparisons/reports/table.h"
#include "comparisons/scene/describe.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/run_scene.h"

#include "meshless/linear_algebra/stopwatch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

namespace comparisons::program {

namespace fs = std::filesystem;

namespace {

std::optional<scene::Scene> read(const fs::path &file, const CommonOptions &options,
                                 const study::Catalogue &catalogue) {
  auto result = scene::read_scene(file, options.overrides(), study::vocabulary_of(catalogue));
  if (!result.diagnostics.all().empty())
    fmt::print(stderr, "{}", scene::to_text(result.diagnostics));
  return std::move(result.scene);
}

std::string bytes_text(double bytes) {
  const double megabytes = std::max(0.1, bytes / 1e6);
  return bytes >= 1e9      ? fmt::format("{:.1f} GB", bytes / 1e9)
         : megabytes >= 10 ? fmt::format("{:.0f} MB", megabytes)
                           : fmt::format("{:.1f} MB", megabytes);
}

std::string seconds_text(double seconds) {
  return seconds >= 60  ? fmt::format("{:.0f} min", seconds / 60)
         : seconds >= 1 ? fmt::format("{:.1f} s", seconds)
                        : fmt::format("{:.3f} s", seconds);
}

/// Looks at the particles of cells while it is quick: the description of a scene is to take a few seconds at most.
class Inspector {
public:
  std::optional<methods::CloudReport> look(const study::Experiment &experiment, const scene::MethodRequest &request,
                                           const scene::Level &level, const study::Estimate &rough,
                                           std::string &trouble) {
    constexpr double seconds_per_particle = 3e-4;
    constexpr double most_seconds = 3;
    if (spent_ + seconds_per_particle * rough.n_points > most_seconds) {
      ++n_left_out_;
      return {};
    }
    meshless::linear_algebra::Stopwatch watch;
    std::optional<methods::CloudReport> report;
    try {
      report = experiment.inspect(request, level);
    } catch (const std::exception &error) {
      trouble = error.what();
    }
    spent_ += watch.lap();
    return report;
  }

  int n_left_out() const { return n_left_out_; }

private:
  double spent_ = 0;
  int n_left_out_ = 0;
};

std::string recoveries_text(const methods::CloudReport &cloud) {
  std::string text;
  if (cloud.n_orders_lowered > 0)
    text += fmt::format("; order {} does not exist: order {}", cloud.order + cloud.n_orders_lowered, cloud.order);
  if (cloud.n_enlarged > 0)
    text += fmt::format("; h of {} particles enlarged, at most by {:.2f}", cloud.n_enlarged, cloud.largest_enlargement);
  if (cloud.n_pivoted > 0)
    text += fmt::format("; {} moment matrices not positive definite", cloud.n_pivoted);
  return text;
}

std::string cloud_row(const std::string &name, const scene::Level &level, const methods::CloudReport &cloud) {
  return fmt::format("  {:<34} {:>8} {:>6} {:>6} {:>6} {:>10.3g} {:>10.2e}  ({:.4g}, {:.4g}){}\n", name, level.text,
                     cloud.fewest_neighbours, cloud.median_neighbours, cloud.most_neighbours, cloud.smallest_distance,
                     cloud.pivot_ratio, cloud.worst_point[0], cloud.worst_point[1], recoveries_text(cloud));
}

void print_cells(const scene::Scene &scene, const study::Catalogue &catalogue) {
  const auto &benchmark = study::find_benchmark(catalogue, scene.benchmark);
  const auto runs = static_cast<double>(scene.study.integer("repeats")) + 1;
  double total = 0;
  Inspector inspector;
  std::string clouds;
  fmt::print("\nCells ({} run each: one warm-up, {} timed)\n  {:<34} {:>8} {:>9} {:>9} {:>9} {:>9}\n", runs, runs - 1,
             "method", "level", "points", "unknowns", "memory", "time");
  for (const auto &variant : scene.problems) {
    const auto experiment = benchmark.make_experiment(scene, variant, catalogue.methods);
    for (const auto &request : scene.methods)
      for (const auto &level : request.levels) {
        const std::string name = request.label + (variant.label.empty() ? "" : " [" + variant.label + "]");
        if (!request.refused.empty()) {
          fmt::print("  {:<34} {:>8} refused: {}\n", name, level.text, request.refused);
          continue;
        }
        auto e = experiment->estimate(request, level);
        std::string trouble;
        if (const auto cloud = inspector.look(*experiment, request, level, e, trouble)) {
          e = experiment->estimate(request, level, *cloud);
          clouds += cloud_row(name, level, *cloud);
        } else if (!trouble.empty())
          clouds += fmt::format("  {:<34} {:>8} {}\n", name, level.text, trouble);
        total += e.seconds * runs;
        fmt::print("  {:<34} {:>8} {:>9.0f} {:>9.0f} {:>9} {:>9}\n", name, level.text, e.n_points, e.n_dofs,
                   bytes_text(e.bytes), seconds_text(e.seconds));
      }
  }
  fmt::print("Estimated time of all runs: {} (one core; the evaluation of errors not included; unknowns of Q2 to Q4 "
             "from the vertices)\n",
             seconds_text(total));
  if (!clouds.empty())
    fmt::print("\nParticles and bases (neighbours: particles in whose support one lies; pivot ratio: least pivot of a "
               "moment matrix over its diagonal entry, 1 at best)\n  {:<34} {:>8} {:>6} {:>6} {:>6} {:>10} {:>10}  "
               "where\n{}",
               "method", "level", "fewest", "median", "most", "distance/h", "pivot", clouds);
  if (inspector.n_left_out() > 0)
    fmt::print("Not looked at, to be quick: {} larger cells; their estimates are rough.\n", inspector.n_left_out());
}

} // namespace

int check_scenes(const std::vector<fs::path> &files, const CommonOptions &options, const study::Catalogue &catalogue) {
  int code = all_as_expected;
  for (const auto &file : files) {
    const auto scene = read(file, options, catalogue);
    if (!scene) {
      code = invalid_scene;
      continue;
    }
    std::size_t n_cells = 0;
    try {
      for (const auto &variant : scene->problems) {
        const auto experiment =
            study::find_benchmark(catalogue, scene->benchmark).make_experiment(*scene, variant, catalogue.methods);
        for (const auto &request : scene->methods)
          for (const auto &level : request.levels) {
            experiment->estimate(request, level);
            ++n_cells;
          }
      }
    } catch (const std::exception &error) {
      fmt::print(stderr, "{}: error: {}\n", file.string(), error.what());
      code = invalid_scene;
      continue;
    }
    fmt::print("{}: valid, {} cells\n", file.string(), n_cells);
  }
  return code;
}

int explain_scene(const fs::path &file, const CommonOptions &options, const study::Catalogue &catalogue) {
  const auto scene = read(file, options, catalogue);
  if (!scene)
    return invalid_scene;
  const auto &benchmark = study::find_benchmark(catalogue, scene->benchmark).description;
  const auto vocabulary = study::vocabulary_of(catalogue);
  fmt::print("{}\nBenchmark {}: {}\n\n{}", scene->title, benchmark.name, benchmark.meaning,
             scene::describe_effects(*scene, vocabulary));
  const auto called = [&](const char *effect) { return scene->effect_parameters.contains(effect); };
  if (benchmark.time.empty())
    fmt::print(
        "\nFields allocated: displacement (2 per point){}. Stress and strain are computed where they are asked for.\n",
        called("body_force") ? "; the body force is evaluated at quadrature points, not stored" : "");
  else
    fmt::print("\nFields allocated: {}; of effects that are absent none.\n",
               called("gas_pressure") ? "mass, position, velocity, energy, density, smoothing length and their rates"
                                      : "displacement, velocity and the rows of derivatives");
  if (scene->geometry != nullptr)
    fmt::print("\n{}", describe_geometry(*scene));
  print_cells(*scene, catalogue);
  if (benchmark.own_geometry)
    fmt::print("\n{}", describe_geometry_keys());
  else
    fmt::print("\n[problem]\n{}\n[material]\n{}\n", scene::describe_declarations(benchmark.problem),
               scene::describe_declarations(benchmark.material));
  for (const auto &effect : vocabulary.effects)
    if (called(effect.name.c_str()) && !effect.parameters.empty())
      fmt::print("[effects.{}]\n{}\n", effect.name, scene::describe_declarations(effect.parameters));
  if (!benchmark.time.empty())
    fmt::print("[time]\n{}\n", scene::describe_declarations(benchmark.time));
  std::vector<std::string> shown;
  for (const auto &request : scene->methods) {
    if (std::find(shown.begin(), shown.end(), request.name) != shown.end())
      continue;
    shown.push_back(request.name);
    for (const auto &method : benchmark.methods.empty() ? vocabulary.methods : benchmark.methods)
      if (method.name == request.name)
        fmt::print("[[method]] name = \"{}\": {}\n{}\n", method.name, method.meaning,
                   scene::describe_declarations(method.parameters));
  }
  fmt::print("[study]\n{}\n[output]\n{}", scene::describe_declarations(scene::study_declarations()),
             scene::describe_declarations(scene::output_declarations()));
  return all_as_expected;
}

int list_names(const std::string &what, const study::Catalogue &catalogue) {
  const auto vocabulary = study::vocabulary_of(catalogue);
  const auto print = [](const auto &entries) {
    std::size_t width = 0;
    for (const auto &entry : entries)
      width = std::max(width, entry.name.size());
    for (const auto &entry : entries)
      fmt::print("{:<{}}  {}\n", entry.name, width, entry.meaning);
  };
  if (what == "methods")
    print(vocabulary.methods);
  else if (what == "bases")
    print(vocabulary.bases);
  else if (what == "kernels")
    print(vocabulary.kernels);
  else if (what == "effects")
    print(vocabulary.effects);
  else if (what == "benchmarks") {
    auto benchmarks = vocabulary.benchmarks;
    benchmarks.emplace_back().name = "hard_cases";
    benchmarks.back().meaning =
        "the matrix of `petrov verify`, hard cases and methods; for compare alone, it has no scenes";
    print(benchmarks);
  } else {
    fmt::print(stderr, "error: cannot list '{}'; there are methods, bases, kernels, effects, benchmarks\n", what);
    return usage_error;
  }
  return all_as_expected;
}

int write_initial_scene(const std::string &benchmark, const std::string &file, const study::Catalogue &catalogue) {
  const auto vocabulary = study::vocabulary_of(catalogue);
  std::vector<std::string> names;
  for (const auto &entry : vocabulary.benchmarks) {
    names.push_back(entry.name);
    if (entry.name != benchmark)
      continue;
    const std::string text = scene::initial_scene(entry, entry.methods.empty() ? vocabulary.methods : entry.methods);
    if (file == "-") {
      fmt::print("{}", text);
      return all_as_expected;
    }
    if (fs::exists(file)) {
      fmt::print(stderr, "error: {} exists; it is not overwritten\n", file);
      return usage_error;
    }
    try {
      reports::write_file_atomically(file, text);
    } catch (const reports::OutputError &error) {
      fmt::print(stderr, "error: {}\n", error.what());
      return invalid_scene;
    }
    fmt::print(stderr, "{} written; try: petrov explain {}\n", file, file);
    return all_as_expected;
  }
  const auto near = scene::nearest_name(benchmark, names);
  fmt::print(stderr, "error: no benchmark '{}'; there are {}{}\n", benchmark, fmt::join(names, ", "),
             near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near));
  return usage_error;
}

int rebuild_report(const fs::path &file, const CommonOptions &options) {
  try {
    const auto results = reports::read_results(file);
    const fs::path directory = options.output.value_or(file.has_parent_path() ? file.parent_path().string() : ".");
    auto formats = options.formats;
    if (formats.empty())
      formats = reports::report_formats();
    reports::prepare_output_directory(directory);
    std::vector<std::string> complaints;
    reports::write_reports(results, directory, formats, "results",
                           {page_directory(), file.parent_path().empty() ? "." : file.parent_path()}, &complaints);
    for (const std::string &complaint : complaints)
      fmt::print(stderr, "warning: {}\n", complaint);
    fmt::print("{}", reports::text_report(results));
    return all_as_expected;
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return invalid_scene;
  }
}

int compare_runs(const fs::path &first, const fs::path &second, const CommonOptions &options) {
  try {
    const reports::Document document = reports::side_by_side({first.string(), reports::read_results(first)},
                                                             {second.string(), reports::read_results(second)});
    if (options.output) {
      reports::prepare_output_directory(*options.output);
      const fs::path directory = *options.output;
      reports::write_file_atomically(directory / "side_by_side.txt", reports::render_text(document));
      reports::write_file_atomically(directory / "side_by_side.md", reports::render_markdown(document));
      reports::write_file_atomically(directory / "side_by_side.tex", reports::render_latex(document));
    }
    fmt::print("{}", reports::render_text(document));
    return all_as_expected;
  } catch (const std::exception &error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return invalid_scene;
  }
}

} // namespace comparisons::program
