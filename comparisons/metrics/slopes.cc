#include "comparisons/metrics/slopes.h"

#include <cmath>
#include <cstdlib>
#include <map>

namespace comparisons::metrics {

double least_squares_slope(std::span<const double> counts, std::span<const double> errors) {
  double sum_x = 0;
  double sum_y = 0;
  double sum_xx = 0;
  double sum_xy = 0;
  const auto n = static_cast<double>(counts.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double x = -std::log(counts[i]);
    const double y = std::log(errors[i]);
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

void add_slopes(const std::string &error, std::vector<reports::Cell> &cells) {
  std::map<std::string, std::vector<reports::Cell *>> series;
  for (auto &cell : cells)
    series[cell.variant + "|" + cell.label].push_back(&cell);
  for (const auto &[key, members] : series) {
    std::vector<double> counts;
    std::vector<double> errors;
    reports::Cell *finest = nullptr;
    double finest_count = 0;
    for (auto *cell : members) {
      const double count = std::atof(cell->level.c_str());
      const auto found = cell->errors.find(error);
      if (cell->status != reports::Status::ok || found == cell->errors.end() || !(found->second > 0) || !(count > 0))
        break;
      counts.push_back(count);
      errors.push_back(found->second);
      if (count > finest_count) {
        finest_count = count;
        finest = cell;
      }
    }
    if (counts.size() == members.size() && counts.size() >= 3)
      finest->quantities[error + "_slope"] = least_squares_slope(counts, errors);
  }
}

} // namespace comparisons::metrics
