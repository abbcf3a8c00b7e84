#include "comparisons/study/experiment.h"

#include <cctype>

namespace comparisons::study {

std::string series_file(const reports::Cell &cell, const std::string &name) {
  std::string stem = cell.benchmark + "-" + cell.scene + "-" + cell.label;
  if (!cell.variant.empty())
    stem += "-" + cell.variant;
  stem += "-" + cell.level + "-" + name;
  for (char &c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-')
      c = '_';
  return "series/" + stem + ".csv";
}

} // namespace comparisons::study
