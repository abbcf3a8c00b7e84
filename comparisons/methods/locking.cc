#include "comparisons/methods/locking.h"

#include <fmt/format.h>

namespace comparisons::methods {

bool locks(const problems::Material &material) { return material.plane_strain && material.poisson_ratio > 0.49; }

std::string locking_warning(const problems::Material &material) {
  return fmt::format(
      "nu = {} in plane strain: displacement methods lock above 0.49; the method 'mixed' and the element "
      "'Q2Q1' do not",
      material.poisson_ratio);
}

} // namespace comparisons::methods
