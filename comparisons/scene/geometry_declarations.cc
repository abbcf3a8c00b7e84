#include "comparisons/scene/geometry_tables.h"

namespace comparisons::scene {

namespace {

constexpr Range positive{.lower = 0, .lower_open = true};
constexpr Dimension force_per_volume{.mass = 1, .length = -2, .time = -2};

} // namespace

std::vector<Declaration> geometry_declarations() {
  return {
      {.name = "file",
       .type = Type::text,
       .required = true,
       .meaning = "Gmsh mesh (.msh 2.2 or 4.1) or drawing (.geo), relative to the scene's folder"},
      {.name = "size",
       .dimension = dimensions::length,
       .range = positive,
       .meaning = "size of the cells at the level \"mesh\", only for a .geo; if absent, as drawn"},
      {.name = "cell_order",
       .type = Type::integer,
       .range = {.lower = 1, .upper = 2},
       .default_value = std::int64_t{2},
       .meaning = "only for a .geo: 1 straight cells, 2 cells that follow round boundaries"},
      {.name = "cells",
       .type = Type::choice,
       .choices = {"triangles", "quadrilaterals"},
       .default_value = "triangles",
       .meaning = "only for a .geo: what the drawing is meshed with"},
      {.name = "cloud",
       .type = Type::choice,
       .choices = {"nodes", "generated", "file"},
       .default_value = "nodes",
       .meaning =
           "particles of the meshless methods: the corners of the level's cells, or as many, relaxed, of the same "
           "local spacing, or those of cloud_file at every level"},
      {.name = "cloud_file",
       .type = Type::text,
       .meaning = "particles: CSV with a line of names x, y and, if wanted, h (distance of neighbours) and region "
                  "(0, 1 ... as [[material]]), or VTK with points; in m, relative to the scene's folder"},
  };
}

std::vector<Declaration> region_material_declarations() {
  return {
      {.name = "region", .type = Type::text, .meaning = "physical surface it is for; absent: the whole domain"},
      {.name = "E",
       .dimension = dimensions::pressure,
       .range = positive,
       .required = true,
       .meaning = "Young's modulus"},
      {.name = "nu",
       .range = {.lower = -1, .upper = 0.5, .lower_open = true},
       .required = true,
       .meaning = "Poisson's ratio"},
      {.name = "model",
       .type = Type::choice,
       .choices = {"plane stress", "plane strain"},
       .required = true,
       .meaning = "plane model"},
      {.name = "density", .dimension = dimensions::density, .range = positive, .meaning = "mass per volume"},
  };
}

std::vector<Declaration> boundary_declarations() {
  const std::vector<std::string> words{"reference"};
  return {
      {.name = "group", .type = Type::text, .required = true, .meaning = "physical curve that the condition is for"},
      {.name = "u1",
       .type = Type::expression,
       .dimension = dimensions::length,
       .choices = words,
       .meaning = "displacement in x; \"reference\": that of [reference]"},
      {.name = "u2",
       .type = Type::expression,
       .dimension = dimensions::length,
       .choices = words,
       .meaning = "displacement in y; \"reference\": that of [reference]"},
      {.name = "traction",
       .type = Type::expressions,
       .dimension = dimensions::pressure,
       .choices = words,
       .meaning = "force per area in x and y on the components without displacement; \"reference\": of its stress"},
      {.name = "pressure",
       .type = Type::expression,
       .dimension = dimensions::pressure,
       .meaning = "force per area against the outward normal, in place of traction"},
  };
}

std::vector<Declaration> reference_declarations() {
  std::vector<Declaration> keys{
      {.name = "solution",
       .type = Type::choice,
       .choices = {"finer fem", "expressions", "elliptic hole", "re-entrant corner", "file"},
       .meaning = "what errors are relative to; if absent, expressions where u1 is given, the file where one is, else "
                  "finer finite elements"},
      {.name = "file",
       .type = Type::text,
       .meaning = "CSV with a line of names: x, y, u1, u2 and, if wanted, s11, s22, s12 and weight, in SI units, "
                  "relative to the scene's folder; errors are taken at its points"}};
  for (const auto *name : {"u1", "u2"})
    keys.push_back(
        {.name = name, .type = Type::expression, .dimension = dimensions::length, .meaning = "exact displacement"});
  for (const auto *name : {"s11", "s22", "s12"})
    keys.push_back(
        {.name = name, .type = Type::expression, .dimension = dimensions::pressure, .meaning = "exact stress"});
  keys.insert(keys.end(),
              {{.name = "semi_axis_1",
                .dimension = dimensions::length,
                .range = positive,
                .meaning = "elliptic hole around the origin: half its width in x"},
               {.name = "semi_axis_2",
                .dimension = dimensions::length,
                .range = positive,
                .meaning = "elliptic hole: half its height in y"},
               {.name = "stress",
                .dimension = dimensions::pressure,
                .meaning = "elliptic hole: stress in y far away; re-entrant corner: stress at the distance of 1 m"},
               {.name = "element",
                .type = Type::choice,
                .choices = {"Q1", "Q2", "Q3", "Q4"},
                .default_value = "Q3",
                .meaning = "finer finite elements: degree"},
               {.name = "refinements",
                .type = Type::integer,
                .range = {.lower = 0, .upper = 6},
                .default_value = std::int64_t{1},
                .meaning = "finer finite elements: refinements beyond the finest level of the scene"}});
  return keys;
}

std::vector<Declaration> quantity_declarations() {
  return {
      {.name = "name", .type = Type::text, .required = true, .meaning = "its name in tables and files"},
      {.name = "kind",
       .type = Type::choice,
       .choices = {"displacement", "stress", "largest_von_mises", "reaction", "strain_energy", "line"},
       .required = true,
       .meaning = "what it is; a line writes displacement and stress along it as data"},
      {.name = "component",
       .type = Type::choice,
       .choices = {"1", "2", "magnitude", "11", "22", "12", "von_mises"},
       .meaning = "displacement: 1, 2, magnitude; stress: 11, 22, 12, von_mises; reaction: 1, 2"},
      {.name = "point",
       .type = Type::point,
       .dimension = dimensions::length,
       .meaning = "where, for displacement and stress"},
      {.name = "from", .type = Type::point, .dimension = dimensions::length, .meaning = "begin of a line"},
      {.name = "to", .type = Type::point, .dimension = dimensions::length, .meaning = "end of a line"},
      {.name = "points",
       .type = Type::integer,
       .range = {.lower = 2, .upper = 100000},
       .default_value = std::int64_t{101},
       .meaning = "points of a line"},
      {.name = "group", .type = Type::text, .meaning = "physical curve of a reaction"},
      {.name = "scale",
       .default_value = 1.0,
       .meaning = "the value in SI is divided by this: a far stress makes a concentration factor"},
      {.name = "reference", .meaning = "what it should be, after the division; the relative error is then reported"},
  };
}

std::vector<Declaration> body_force_declarations() {
  return {{.name = "force",
           .type = Type::expressions,
           .dimension = force_per_volume,
           .required = true,
           .meaning = "force per volume in x and y"}};
}

std::vector<Declaration> thermal_expansion_declarations() {
  return {{.name = "expansion",
           .range = {.lower = -1, .upper = 1},
           .required = true,
           .meaning = "coefficient of linear expansion, 1/K, of all regions"},
          {.name = "temperature",
           .type = Type::expression,
           .required = true,
           .meaning = "temperature above that without stress, K"}};
}

} // namespace comparisons::scene
