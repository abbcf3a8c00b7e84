#include "small_vocabulary.h"

#include "comparisons/scene/time_keys.h"

#include <stdexcept>

namespace scene_tests {

using namespace comparisons::scene;

namespace {

constexpr double open_bound = 0.5;

std::vector<Declaration> beam_material() {
  return {
      {.name = "E",
       .dimension = dimensions::pressure,
       .range = {.lower = 0, .lower_open = true},
       .default_value = 1.0e9,
       .meaning = "Young's modulus, in Pa"},
      {.name = "nu",
       .range = {.lower = -1, .upper = open_bound, .lower_open = true},
       .default_value = 0.25,
       .meaning = "Poisson's ratio"},
      {.name = "model",
       .type = Type::choice,
       .choices = {"plane stress", "plane strain"},
       .default_value = "plane stress",
       .meaning = "plane stress or plane strain"},
  };
}

BenchmarkDescription beam() {
  return {.name = "beam",
          .meaning = "a beam under a load at its end",
          .problem = {{.name = "length",
                       .dimension = dimensions::length,
                       .range = {.lower = 0, .lower_open = true},
                       .default_value = 8.0,
                       .meaning = "length, in m"},
                      {.name = "jitter",
                       .range = {.lower = 0, .upper = 0.5},
                       .default_value = 0.0,
                       .meaning = "random displacement of particles over their spacing"},
                      {.name = "load",
                       .dimension = dimensions::force_per_length,
                       .default_value = -1.0,
                       .meaning = "load at the end, in N/m"},
                      {.name = "corner",
                       .type = Type::point,
                       .dimension = dimensions::length,
                       .default_value = Point{0, 0},
                       .meaning = "lower left corner, in m"}},
          .material = beam_material(),
          .effects = {"elasticity"},
          .check =
              [](const CheckContext &context, Diagnostics &diagnostics) {
                if (!context.level.counts.empty() && context.level.counts[0] > 1000)
                  diagnostics.error({}, "study.levels", "the level is finer than the beam allows");
                if (context.problem.real("jitter") == 0.5 && context.effects.size() < 2)
                  diagnostics.error(context.problem.location("jitter"), "problem.jitter", "0.5 needs two effects");
              },
          .counts_per_level = 2};
}

BenchmarkDescription bar() {
  return {.name = "bar",
          .meaning = "a bar in one dimension",
          .problem = {{.name = "mode",
                       .type = Type::integer,
                       .range = {.lower = 1},
                       .required = true,
                       .meaning = "number of the mode"}},
          .material = {{.name = "density",
                        .dimension = dimensions::density,
                        .range = {.lower = 0, .lower_open = true},
                        .required = true,
                        .meaning = "density, in kg/m^3"}},
          .effects = {},
          .check = {},
          .counts_per_level = 1,
          .time = time_declarations({.end = 2, .cfl = 0.5, .snapshots = 3, .cfl_meaning = "the stable one"}),
          .effect_defaults = {{"body_force.factor", 7.0}},
          .analyses = {"transient", "modes"}};
}

MethodDescription particles() {
  return {
      .name = "particles",
      .meaning = "a meshless method",
      .parameters = {{.name = "order",
                      .type = Type::integer,
                      .range = {.lower = 1, .upper = 4},
                      .default_value = std::int64_t{2},
                      .meaning = "order of the basis"},
                     {.name = "support",
                      .range = {.lower = 0, .lower_open = true},
                      .default_value = 4.0,
                      .meaning = "radius of the support over h"},
                     {.name = "kernel",
                      .type = Type::choice,
                      .choices = {"gauss", "super_gauss"},
                      .default_value = "gauss",
                      .meaning = "kernel"},
                     {.name = "scaled", .type = Type::boolean, .default_value = true, .meaning = "rows scaled to one"},
                     {.name = "penalty", .dimension = dimensions::pressure, .meaning = "penalty, in Pa"}},
      .effects = {"elasticity", "body_force"},
      .check = [](const CheckContext &context, Diagnostics &diagnostics) {
        const auto &method = context.method;
        if (method.real("support") < static_cast<double>(method.integer("order")))
          diagnostics.error(method.location("support"), context.method_key + ".support",
                            "the support is too small for the order");
        const auto &material = context.material;
        if (material.has("nu") && material.real("nu") == open_bound && material.text("model") == "plane strain")
          diagnostics.error(material.location("nu"), "material.nu", "nu = 0.5 in plane strain needs a mixed method");
      }};
}

MethodDescription fem() {
  return {.name = "fem",
          .meaning = "finite elements",
          .parameters = {{.name = "element",
                          .type = Type::choice,
                          .choices = {"Q1", "Q2", "Q3"},
                          .default_value = "Q2",
                          .meaning = "element"}},
          .effects = {"elasticity", "inertia"},
          .check = {}};
}

MethodDescription no_effects() {
  return {.name = "interpolation",
          .meaning = "interpolation",
          .parameters = {{.name = "file", .type = Type::text, .required = true, .meaning = "a file"}},
          .effects = {},
          .check = [](const CheckContext &, Diagnostics &) { throw std::runtime_error("boom"); }};
}

} // namespace

Vocabulary small_vocabulary() {
  return {.methods = {particles(), fem(), no_effects()},
          .benchmarks = {beam(), bar()},
          .effects = {{"elasticity", "linear elasticity"},
                      {"body_force",
                       "a force per volume",
                       {{.name = "factor", .range = {.lower = 0}, .default_value = 1.0, .meaning = "a factor"}}},
                      {"inertia", "mass times acceleration"},
                      {"heat_conduction", "Fourier's law"}},
          .kernels = {{"gauss", "a bell"}},
          .bases = {},
          .formats = {{"text", ""}, {"json", ""}, {"csv", ""}, {"md", ""}, {"vtu", ""}}};
}

std::string valid_scene() {
  return R"(schema = 1
title = "A beam"
benchmark = "beam"
[problem]
length = "8 m"
[material]
E = "226.9 GPa"
nu = 0.3
model = "plane strain"
[effects]
elasticity = true
[[method]]
name = "particles"
order = 2
support = 4
kernel = "gauss"
[[method]]
name = "fem"
element = "Q1"
[study]
levels = ["16x4", "31x7"]
repeats = 5
max_memory = "4 GiB"
[output]
formats = ["text", "vtu"]
)";
}

ReadResult read(const std::string &text, const std::vector<std::string> &overrides) {
  static const Vocabulary vocabulary = small_vocabulary();
  return read_scene_text(text, "beam.toml", overrides, vocabulary);
}

std::string findings(const std::string &text, const std::vector<std::string> &overrides) {
  return to_text(read(text, overrides).diagnostics);
}

std::string with(const std::string &from, const std::string &to) {
  std::string text = valid_scene();
  const auto place = text.find(from);
  if (place == std::string::npos)
    throw std::invalid_argument("the valid scene has no " + from);
  return text.replace(place, from.size(), to);
}

} // namespace scene_tests
