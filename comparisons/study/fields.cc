#include "comparisons/study/fields.h"

#include <algorithm>
#include <cmath>

namespace comparisons::study {

namespace {

using problems::Stress2;
using problems::Vector2;

const problems::Material &material_at(const problems::PlaneProblem &problem, const reports::FieldGrid &grid,
                                      std::size_t i) {
  const std::size_t region = grid.regions.empty() ? 0 : static_cast<std::size_t>(grid.regions[i]);
  return problem.statement().regions.at(region).material;
}

/// Hooke's law in the plane, from stress to strain; epsilon_12 of the tensor.
Stress2 strain_of(const double *s, const problems::Material &material) {
  const double nu = material.poisson_ratio;
  const double e0 = material.plane_strain ? material.youngs_modulus / ((1 - nu) * (1 + nu)) : material.youngs_modulus;
  const double nu0 = material.plane_strain ? nu / (1 - nu) : nu;
  return {(s[0] - nu0 * s[1]) / e0, (s[1] - nu0 * s[0]) / e0, (1 + nu) / material.youngs_modulus * s[2]};
}

double von_mises(const double *s, const problems::Material &material) {
  const double s33 = material.plane_strain ? material.poisson_ratio * (s[0] + s[1]) : 0;
  const auto square = [](double x) { return x * x; };
  return std::sqrt(0.5 * (square(s[0] - s[1]) + square(s[1] - s33) + square(s33 - s[0])) + 3 * square(s[2]));
}

void add_errors(const reports::FieldGrid &grid, const std::vector<double> &u, const std::vector<double> &s,
                const problems::ExactSolution &exact, std::vector<reports::PointField> &fields) {
  const std::size_t n = grid.points.size();
  std::vector<Vector2> exact_u(n);
  std::vector<Stress2> exact_s(n);
  exact.displacement(grid.points, exact_u);
  exact.stress(grid.points, exact_s);
  reports::PointField of_u{"displacement_error", {}, std::vector<double>(n)};
  reports::PointField of_s{"stress_error", {}, std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    of_u.values[i] = std::hypot(u[2 * i] - exact_u[i][0], u[2 * i + 1] - exact_u[i][1]);
    of_s.values[i] = std::hypot(s[3 * i] - exact_s[i][0], s[3 * i + 1] - exact_s[i][1],
                                std::sqrt(2.0) * (s[3 * i + 2] - exact_s[i][2]));
  }
  fields.push_back(std::move(of_u));
  fields.push_back(std::move(of_s));
}

/// Points and parts of one quadrilateral.
void add_quadrilateral(const problems::Mesh &mesh, const problems::Mesh::Cell &cell, int degree,
                       reports::FieldGrid &grid) {
  const std::size_t first = grid.points.size();
  const auto n = static_cast<std::size_t>(degree) + 1;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) {
      const double a = static_cast<double>(i) / degree, b = static_cast<double>(j) / degree;
      const double weights[] = {(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b};
      std::array<double, 2> point{};
      for (std::size_t v = 0; v < 4; ++v)
        for (std::size_t k = 0; k < 2; ++k)
          point[k] += weights[v] * mesh.vertices[cell.vertices[v]][k];
      grid.points.push_back(point);
    }
  for (std::size_t j = 0; j + 1 < n; ++j)
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const std::size_t corner = first + j * n + i;
      grid.cells.push_back({corner, corner + 1, corner + n + 1, corner + n});
    }
}

} // namespace

reports::FieldGrid grid_of(const std::vector<std::array<double, 2>> &points, const std::vector<int> &regions) {
  reports::FieldGrid grid{points, {}, regions};
  for (std::size_t i = 0; i < points.size(); ++i)
    grid.cells.push_back({i});
  return grid;
}

reports::FieldGrid grid_of(const problems::Mesh &mesh, int degree) {
  reports::FieldGrid grid;
  for (const auto &cell : mesh.cells) {
    if (cell.n_vertices == 4)
      add_quadrilateral(mesh, cell, degree, grid);
    else {
      const std::size_t first = grid.points.size();
      for (std::size_t v = 0; v < 3; ++v)
        grid.points.push_back(mesh.vertices[cell.vertices[v]]);
      grid.cells.push_back({first, first + 1, first + 2});
    }
    grid.regions.resize(grid.points.size(), cell.region);
  }
  return grid;
}

std::vector<reports::PointField> fields_on(const reports::FieldGrid &grid, const methods::Solution &solution,
                                           const problems::PlaneProblem &problem) {
  const std::size_t n = grid.points.size();
  reports::PointField u{"displacement", {"1", "2"}, std::vector<double>(2 * n)};
  reports::PointField s{"stress", {"11", "22", "12"}, std::vector<double>(3 * n)};
  solution.evaluate("displacement", grid.points, u.values);
  solution.evaluate("stress", grid.points, s.values);
  reports::PointField strain{"strain", {"11", "22", "12"}, {}};
  reports::PointField mises{"von_mises", {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const auto &material = material_at(problem, grid, i);
    const Stress2 e = strain_of(&s.values[3 * i], material);
    strain.values.insert(strain.values.end(), e.begin(), e.end());
    mises.values.push_back(von_mises(&s.values[3 * i], material));
  }
  std::vector<reports::PointField> fields{u, strain, s, mises};
  const auto names = solution.fields();
  if (std::find(names.begin(), names.end(), "pressure") != names.end()) {
    reports::PointField pressure{"pressure", {}, std::vector<double>(n)};
    solution.evaluate("pressure", grid.points, pressure.values);
    fields.push_back(std::move(pressure));
  }
  if (problem.exact().displacement && problem.exact().stress && !problem.exact().only_at)
    add_errors(grid, u.values, s.values, problem.exact(), fields);
  for (auto &[name, values] : solution.own_figures())
    fields.push_back({name, {}, values});
  return fields;
}

} // namespace comparisons::study
