#include "comparisons/hard_cases/solvers.h"

#include "comparisons/scene/default_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace comparisons::hard_cases {

namespace {

using scene::Value;

std::vector<std::string> labels(const std::function<bool(const Solver &)> &wanted) {
  std::vector<std::string> result;
  for (const auto &solver : solvers())
    if (wanted(solver))
      result.push_back(solver.label);
  return result;
}

} // namespace

const std::vector<Solver> &solvers() {
  static const std::vector<Solver> table{
      {"strong", "strong", {}},
      {"weak1", "weak1", {}},
      {"weak1 consistent", "weak1", {{"quadrature", std::string("consistent")}}},
      {"weak2", "weak2", {}},
      {"hybrid", "hybrid", {}},
      {"mixed", "mixed", {}},
      {"fem Q1", "fem", {{"element", std::string("Q1")}}},
      {"fem Q2", "fem", {{"element", std::string("Q2")}}},
      {"fem Q2Q1", "fem", {{"element", std::string("Q2Q1")}}},
  };
  return table;
}

std::vector<std::string> all_solvers() {
  return labels([](const Solver &) { return true; });
}
std::vector<std::string> particle_solvers() {
  return labels([](const Solver &s) { return s.method != "fem"; });
}
std::vector<std::string> weak_solvers() {
  return labels([](const Solver &s) { return s.method == "weak1" || s.method == "weak2"; });
}
std::vector<std::string> finite_elements() {
  return labels([](const Solver &s) { return s.method == "fem"; });
}

std::unique_ptr<methods::Solution> solve(const std::string &label, const problems::PlaneStatement &statement,
                                         const problems::Cloud &cloud, const problems::Mesh &mesh,
                                         const std::map<std::string, Value> &keys) {
  const auto solver =
      std::find_if(solvers().begin(), solvers().end(), [&](const Solver &s) { return s.label == label; });
  if (solver == solvers().end())
    throw std::logic_error(fmt::format("no method '{}' in the hard cases", label));
  static const std::vector<methods::Method> table = methods::method_table();
  const auto method =
      std::find_if(table.begin(), table.end(), [&](const auto &m) { return m.description.name == solver->method; });
  auto given = solver->keys;
  for (const auto &[key, value] : keys)
    given.insert_or_assign(key, value);
  const auto parameters = scene::default_parameters(method->description.parameters, given);
  return method->solve({statement, [&] { return cloud; }, [&] { return mesh; }, parameters});
}

} // namespace comparisons::hard_cases
