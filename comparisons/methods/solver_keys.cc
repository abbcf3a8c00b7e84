#include "comparisons/methods/solver_keys.h"

namespace comparisons::methods {

namespace {

namespace linear_algebra = meshless::linear_algebra;
using linear_algebra::SystemSolver;
using scene::Type;

scene::Declaration ordering_key(const char *meaning) {
  return {.name = "ordering", .type = Type::choice, .choices = ordering_names(), .meaning = meaning};
}

} // namespace

std::vector<std::string> ordering_names() {
  std::vector<std::string> names;
  for (const auto &line : linear_algebra::ordering_table())
    names.emplace_back(line.name);
  return names;
}

std::vector<std::string> preconditioner_names() {
  std::vector<std::string> names;
  for (const auto &line : linear_algebra::preconditioner_table())
    names.emplace_back(line.name);
  return names;
}

std::vector<scene::Declaration> solver_keys() {
  return {{.name = "solver",
           .type = Type::choice,
           .choices = {"automatic", "umfpack", "bicgstab", "gmres"},
           .default_value = "automatic",
           .meaning = "linear solver: sparse LU, or an iteration, after which sparse LU if it does not converge; "
                      "automatic: bicgstab from 200 unknowns up, else umfpack"},
          ordering_key("order of elimination; if absent rcm for an iteration, for sparse LU amd, metis from 40000 "
                       "unknowns up"),
          {.name = "preconditioner",
           .type = Type::choice,
           .choices = preconditioner_names(),
           .meaning = "of an iteration: incomplete factors on the matrix's pattern, on it less what is small, or with "
                      "fill, each alone or with a coarse system; if absent thinned+coarse"}};
}

std::vector<scene::Declaration> mixed_solver_keys() {
  return {{.name = "solver",
           .type = Type::choice,
           .choices = {"umfpack"},
           .default_value = "umfpack",
           .meaning = "linear solver: sparse LU"},
          ordering_key("order of elimination; if absent amd, metis from 40000 unknowns up")};
}

void check_solver_keys(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  if (context.method.has("preconditioner") && context.method.has("solver") &&
      context.method.text("solver") == "umfpack")
    diagnostics.error(context.method.location("preconditioner"), context.method_key + ".preconditioner",
                      "sparse LU has no preconditioner", "remove the key, or use solver = \"bicgstab\"");
}

linear_algebra::SolverRequest solver_request(const scene::Parameters &parameters) {
  linear_algebra::SolverRequest request;
  if (parameters.has("solver")) {
    const auto &name = parameters.text("solver");
    request.solver = name == "umfpack"    ? SystemSolver::direct
                     : name == "bicgstab" ? SystemSolver::bicgstab
                     : name == "gmres"    ? SystemSolver::gmres
                                          : SystemSolver::automatic;
  }
  if (parameters.has("ordering"))
    request.ordering = linear_algebra::ordering_of(parameters.text("ordering"));
  if (parameters.has("preconditioner"))
    request.preconditioner = linear_algebra::preconditioner_of(parameters.text("preconditioner"));
  return request;
}

std::map<std::string, std::string> names_of(const linear_algebra::SolverChoice &choice) {
  std::map<std::string, std::string> names{{"method", choice.krylov ? to_text(*choice.krylov) : "umfpack"},
                                           {"ordering", to_text(choice.ordering)}};
  if (choice.krylov)
    names["preconditioner"] = to_text(choice.preconditioner);
  return names;
}

} // namespace comparisons::methods
