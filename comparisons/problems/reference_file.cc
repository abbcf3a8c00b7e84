#include "comparisons/problems/reference_file.h"

#include <fmt/format.h>

#include <map>
#include <memory>
#include <stdexcept>

namespace comparisons::problems {

namespace {

const CsvFormat &reference_format() {
  static const CsvFormat format{.needed = {"x", "y", "u1", "u2"},
                                .optional = {"s11", "s22", "s12", "weight"},
                                .row = "point",
                                .table = "a reference",
                                .check = [](std::string_view column, double value) -> std::optional<std::string> {
                                  if (column == "weight" && !(value > 0))
                                    return "it must be greater than 0";
                                  return {};
                                }};
  return format;
}

using Index = std::map<Point2, std::size_t>;

/// The values of points that are those of the file, to the last bit.
template <typename Value>
std::function<void(std::span<const Point2>, std::span<Value>)> lookup(std::shared_ptr<const Index> index,
                                                                      std::vector<Value> known) {
  return [index = std::move(index), known = std::move(known)](std::span<const Point2> points, std::span<Value> values) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto found = index->find(points[i]);
      if (found == index->end())
        throw std::logic_error(
            fmt::format("the reference is not known at ({:.6g}, {:.6g})", points[i][0], points[i][1]));
      values[i] = known[found->second];
    }
  };
}

} // namespace

ReferenceFile parse_reference_csv(std::string_view text, const std::string &name) {
  auto table = parse_csv(text, name, reference_format());
  const auto x = table.column("x");
  const auto y = table.column("y");
  const auto u1 = table.column("u1");
  const auto u2 = table.column("u2");
  const std::array stress{table.column("s11"), table.column("s22"), table.column("s12")};
  const bool some = !stress[0].empty() || !stress[1].empty() || !stress[2].empty();
  const bool all = !stress[0].empty() && !stress[1].empty() && !stress[2].empty();
  if (some && !all)
    throw CsvError(fmt::format("{}:1:1: s11, s22 and s12 are given together or not at all", name));
  ReferenceFile file;
  const auto weights = table.column("weight");
  file.weights.assign(weights.begin(), weights.end());
  Index known;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const Point2 point{x[i], y[i]};
    if (const auto [first, is_new] = known.try_emplace(point, i); !is_new)
      throw CsvError(fmt::format("{}:{}:{}: the point ({}, {}) stands on line {} already", name, table.places[i].first,
                                 table.places[i].second, x[i], y[i], table.places[first->second].first));
    file.points.push_back(point);
    file.displacement.push_back({u1[i], u2[i]});
    if (all)
      file.stress.push_back({stress[0][i], stress[1][i], stress[2][i]});
  }
  file.places = std::move(table.places);
  return file;
}

ExactSolution known_at_points(const ReferenceFile &file, double area, std::vector<int> regions) {
  auto index = std::make_shared<Index>();
  for (std::size_t i = 0; i < file.points.size(); ++i)
    index->emplace(file.points[i], i);
  auto where = std::make_shared<Quadrature>();
  where->points = file.points;
  where->weights = file.weights;
  if (where->weights.empty())
    where->weights.assign(file.points.size(), area / static_cast<double>(file.points.size()));
  where->regions = std::move(regions);
  ExactSolution solution{lookup<Vector2>(index, file.displacement), {}, std::move(where)};
  if (!file.stress.empty())
    solution.stress = lookup<Stress2>(index, file.stress);
  return solution;
}

} // namespace comparisons::problems
