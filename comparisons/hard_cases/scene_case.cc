#include "comparisons/hard_cases/scene_case.h"

#include "comparisons/scene/reader.h"
#include "comparisons/study/run_scene.h"

#include "meshless/dynamics/violation.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace comparisons::hard_cases {

Measurement with_named_ends(const std::function<Measurement()> &run) {
  try {
    return run();
  } catch (const meshless::dynamics::Violation &violation) {
    throw NamedRefusal(violation.what());
  } catch (const std::exception &failure) {
    // Explicit finite elements and gas schemes name time and cell in words of their own.
    const std::string reason = failure.what();
    if (reason.find("t = ") != std::string::npos || reason.find("time") != std::string::npos)
      throw NamedRefusal(reason);
    throw;
  }
}

Measurement measure_scene(const study::Catalogue &catalogue, const std::string &text,
                          const std::function<double(const reports::Cell &)> &error) {
  const auto read = scene::read_scene_text(text, "hard case", {}, study::vocabulary_of(catalogue));
  if (!read.scene) {
    for (const auto &finding : read.diagnostics.all())
      throw std::logic_error(finding.key + ": " + finding.message);
    throw std::logic_error("the scene is not valid");
  }
  const auto &scene = *read.scene;
  const auto experiment = study::find_benchmark(catalogue, scene.benchmark)
                              .make_experiment(scene, scene.problems.front(), catalogue.methods);
  reports::Cell cell;
  return with_named_ends([&] {
    experiment->run(scene.methods.front(), scene.levels.front(), true, {}, cell);
    return Measurement{error(cell), {}, cell.warnings};
  });
}

double value_of(const std::map<std::string, double> &values, const std::string &name) {
  const auto found = values.find(name);
  return found == values.end() ? std::nan("") : found->second;
}

std::string bar_scene(const std::string &method, const std::string &keys, const std::string &problem,
                      const std::string &time, int level) {
  return fmt::format("schema = 1\ntitle = \"hard case\"\nbenchmark = \"bar_wave\"\n[problem]\n{}\n[[method]]\nname = "
                     "\"{}\"\n{}\n[time]\n{}\n[study]\nlevels = [{}]\n",
                     problem, method, keys, time, level);
}

std::string tube_scene(const std::string &method, const std::string &problem, const std::string &material,
                       const std::string &time) {
  return fmt::format(
      "schema = 1\ntitle = \"hard case\"\nbenchmark = \"shock_tube\"\n[problem]\n{}\n{}[[method]]\nname = "
      "\"{}\"\n[time]\n{}\n[study]\nlevels = [400]\n",
      problem, material, method, time);
}

std::string plate_scene(const std::string &method, const std::string &problem, const std::string &rest) {
  const bool element = method.starts_with("fem ");
  return fmt::format(
      "schema = 1\ntitle = \"hard case\"\nbenchmark = \"plate_vibration\"\n[problem]\n{}\n[[method]]\nname = "
      "\"{}\"\n{}{}\n",
      problem, element ? "fem" : method, element ? "element = \"" + method.substr(4) + "\"\n" : "", rest);
}

} // namespace comparisons::hard_cases
