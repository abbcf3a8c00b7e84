#pragma once

#include "comparisons/reports/answers.h"
#include "comparisons/reports/results.h"

#include <cmath>
#include <limits>

/// Made-up results in which every field is filled and every kind of outcome appears.
namespace reports_sample {

using namespace comparisons::reports;

inline Cell cell(const std::string &scene, const std::string &label, const std::string &level, double error) {
  Cell cell;
  cell.benchmark = "cantilever";
  cell.scene = scene;
  cell.method = label.substr(0, label.find(' '));
  cell.label = label;
  cell.level = level;
  cell.n_points = level == "16x4" ? 64 : 217;
  cell.n_dofs = 2 * cell.n_points;
  cell.nonzeros = 40 * cell.n_dofs;
  cell.parameters = {{"support", 3.0}, {"order", 2}, {"kernel", "gauss"}, {"shrink", false}};
  cell.errors = {{"displacement_l2_relative", error},
                 {"displacement_log10_E", std::log10(error) - 0.01},
                 {"displacement_max_relative", 1.7 * error},
                 {"u2_max_relative", 1.1 * error},
                 {"stress_l2_relative", 3.3 * error}};
  cell.quantities = {{"tip_deflection", -0.017123456789}};
  if (cell.method != "fem")
    cell.quantities.insert({{"cloud_fewest_neighbours", 12},
                            {"cloud_median_neighbours", 46},
                            {"cloud_most_neighbours", 75},
                            {"cloud_smallest_distance", 0.6798123456},
                            {"cloud_pivot_ratio", 0.00623712345},
                            {"cloud_worst_x", 0.09751234},
                            {"cloud_worst_y", -1.050623456}});
  if (scene == "scene")
    cell.quantities.insert({{"fact_nonzeros_per_row", 39.8256123},
                            {"fact_symmetry_defect", cell.method == "fem" ? 1.3256789e-15 : 0.4034567},
                            {"fact_stress_jump", cell.method == "fem" ? 0.2990912 : 4.3046789e-07}});
  cell.linear_solver = {{"method", "bicgstab"}, {"ordering", "rcm"}, {"preconditioner", "thinned+coarse"}};
  if (cell.method == "fem")
    cell.linear_solver = {{"method", "cg"}, {"preconditioner", "multigrid"}};
  cell.quantities.insert({{"solver_iterations", 26}, {"backward_error", 3.5e-16}, {"algebraic_error", 2.5e-12}});
  double total = 0;
  for (const char *phase : phases) {
    const double seconds = 0.001234567 * static_cast<double>(std::char_traits<char>::length(phase));
    if (std::string_view(phase) == "total")
      cell.seconds[phase] = {total, 0.9 * total, 1.25 * total};
    else
      cell.seconds[phase] = {seconds, 0.9 * seconds, 1.25 * seconds};
    if (std::string_view(phase) != "evaluation")
      total += seconds;
  }
  cell.repeats = 5;
  cell.memory_bytes = 23456789;
  cell.steps = 0;
  return cell;
}

inline Cell unusable(const std::string &scene, const std::string &label, Status status, bool expected) {
  Cell bad = cell(scene, label, "16x4", 0.25);
  bad.status = status;
  bad.expected = expected;
  bad.reason = "singular moment matrix at particle 7 (0.1, 0.2): 9 neighbours, 15 are needed";
  return bad;
}

inline std::vector<Cell> cells() {
  std::vector<Cell> all;
  all.push_back(cell("convergence", "strong", "16x4", 0.168291));
  all.push_back(cell("convergence", "weak1", "16x4", 0.010431));
  all.push_back(cell("convergence", "strong", "31x7", 0.055289));
  all.push_back(cell("convergence", "weak1", "31x7", 0.002475));
  all.push_back(unusable("convergence", "weak1 order=4", Status::refused, true));
  all.push_back(unusable("convergence", "broken | *odd*, \"name\"", Status::failed, false));
  all.push_back(cell("scene", "strong", "16x4", 0.181234));
  all.push_back(cell("scene", "weak1", "16x4", 0.012345678));
  all.back().warnings = {"3 points lay outside and were moved"};
  all.back().series = {{"u2 bottom", "u2_bottom.csv", 2e-6}};
  all.back().steps = 12;
  all.push_back(cell("scene", "fem Q2", "16x4", 1.5e-5));
  all.back().errors["stress_l2_relative"] = std::numeric_limits<double>::quiet_NaN();
  all.back().quantities["tip_deflection"] = std::numeric_limits<double>::infinity();
  all.push_back(cell("order", "weak1", "16x4", 0.3));
  all.back().variant = "jitter=0.25";
  return all;
}

inline Published value(const std::string &entry, double published, double computed, Verdict verdict, bool expected) {
  Published line;
  line.source = "Batra & Zhang 2008";
  line.entry = entry;
  line.benchmark = "cantilever";
  line.scene = "scene";
  line.method = "weak1";
  line.level = "16x4";
  line.quantity = "displacement_log10_E";
  line.published = published;
  line.computed = computed;
  line.tolerance = 0.02;
  line.verdict = verdict;
  line.expected = expected;
  return line;
}

inline Published claim(const std::string &entry, Verdict verdict, bool expected) {
  Published line;
  line.source = "Batra & Zhang 2008";
  line.entry = entry;
  line.benchmark = "cantilever";
  line.scene = "order";
  line.variant = "jitter=0.25";
  line.method = "weak1";
  line.level = "16x4";
  line.quantity = "displacement_l2_relative";
  line.kind = Kind::claim;
  line.computed = 0.3;
  line.verdict = verdict;
  line.expected = expected;
  line.statement = "m = 1 is as good as m = 2";
  line.finding = "weak1 order=1, 16x4 = 0.3 not <= 2 * weak1 order=2, 16x4 = 0.01";
  line.remark = "an artefact of the uniform grid";
  return line;
}

inline Results results() {
  Results all;
  all.program = {"petrov", "0.1.0", "0123abc", "Release", "-O3 -DNDEBUG"};
  all.machine = {
      "Some CPU", 2, 24000000000, 0.25, 1.125, "OpenBLAS 0.3.21", 1, 4, {{"deal.II", "9.4.1"}, {"Eigen", "3.4.0"}},
      0.125};
  all.scene = {{"title", "A beam"},
               {"benchmark", "cantilever"},
               {"name", "scene"},
               {"hash", "cbf29ce484222325"},
               {"study", {{"threads", 1}, {"repeats", 5}, {"seed", 42}}}};
  all.effects_active = {"elasticity"};
  all.effects_absent = {"inertia", "damping"};
  all.cells = cells();
  all.published = {value("section 4.1", -2.012, -2.017345, Verdict::reproduced, true),
                   value("Table 9", -1.5, -2.017345, Verdict::differs, true),
                   value("Table 10", -1.25, -2.017345, Verdict::differs, false),
                   claim("section 5", Verdict::does_not_hold, true), claim("Fig. 4", Verdict::holds, true)};
  all.published[1].remark = "a misprint";
  all.equal_error = equal_errors(all);
  all.not_comparable = {"the machine was loaded"};
  all.interrupted = true;
  return all;
}

} // namespace reports_sample
