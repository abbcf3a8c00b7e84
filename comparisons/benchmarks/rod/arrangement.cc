#include "comparisons/benchmarks/rod/arrangement.h"

#include "comparisons/problems/random.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace comparisons::benchmarks::rod {

using scene::Type;

std::vector<double> Arrangement::places() const {
  std::vector<double> x(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    x[static_cast<std::size_t>(i)] = length * i / (n - 1);
  if (perturbation == 0)
    return x;
  problems::Random random(seed * 0x9e3779b97f4a7c15ULL);
  for (std::size_t i = 1; i + 1 < x.size(); ++i)
    x[i] += perturbation * spacing() * random.symmetric();
  return x;
}

meshless::cloud::Particles<1> make_particles(const std::vector<double> &places, double smoothing_length,
                                             Volumes volumes) {
  const std::size_t n = places.size();
  const double spacing = (places.back() - places.front()) / static_cast<double>(n - 1);
  std::vector<meshless::cloud::Point<1>> positions(n);
  std::vector<double> v(n, spacing);
  for (std::size_t i = 0; i < n; ++i) {
    positions[i] = {places[i]};
    if (volumes == Volumes::voronoi)
      v[i] = 0.5 * (places[std::min(i + 1, n - 1)] - places[i == 0 ? 0 : i - 1]);
  }
  return {std::move(positions), std::vector<double>(n, smoothing_length * spacing), std::move(v)};
}

int count_of(const scene::Level &level, double length) {
  if (level.spacing)
    return std::max(2, 1 + static_cast<int>(std::lround(length / *level.spacing)));
  return level.counts.front();
}

std::vector<scene::Declaration> arrangement_keys(bool seeds) {
  std::vector<scene::Declaration> keys{
      {.name = "length",
       .dimension = scene::dimensions::length,
       .range = {.lower = 0, .lower_open = true},
       .default_value = 1.0,
       .meaning = "length of the rod"},
      {.name = "perturbation",
       .range = {.lower = 0, .upper = 0.49},
       .default_value = 0.0,
       .meaning = "largest random move of an interior particle or vertex, in spacings; the paper's is 0.25"}};
  if (seeds)
    keys.push_back({.name = "seeds",
                    .type = Type::integer,
                    .range = {.lower = 1, .upper = 1000},
                    .default_value = std::int64_t{1},
                    .meaning = "perturbed arrangements of a cell; its errors are geometric means over them"});
  return keys;
}

void check_arrangement(const scene::CheckContext &context, int least, int most, scene::Diagnostics &diagnostics) {
  const auto &problem = context.problem;
  const int n = count_of(context.level, problem.real("length"));
  if (n < least || n > most)
    diagnostics.error(
        {}, "study.levels",
        fmt::format("level {} has {} particles; this benchmark takes {} to {}", context.level.text, n, least, most),
        fmt::format("use N = {} or {}", n < least ? least : most, n < least ? "more" : "fewer"));
  if (problem.has("seeds") && problem.integer("seeds") > 1 && problem.real("perturbation") == 0)
    diagnostics.warning(problem.location("seeds"), "problem.seeds",
                        "without a perturbation all arrangements are the same; one is computed");
}

std::vector<Arrangement> arrangements(const scene::Parameters &problem, const scene::Level &level, std::int64_t seed) {
  Arrangement arrangement;
  arrangement.length = problem.real("length");
  arrangement.n = count_of(level, arrangement.length);
  arrangement.perturbation = problem.real("perturbation");
  const bool several = arrangement.perturbation > 0 && problem.has("seeds");
  std::vector<Arrangement> all(several ? static_cast<std::size_t>(problem.integer("seeds")) : 1, arrangement);
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k].seed = static_cast<std::uint64_t>(seed) + k;
  return all;
}

} // namespace comparisons::benchmarks::rod
