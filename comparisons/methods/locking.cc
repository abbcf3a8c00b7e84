#include "comparisons/methods/locking.h"

#include <fmt/format.h>

namespace comparisons::methods {

bool locks(const problems::Material &material) { return material.plane_strain && material.poisson_ratio > 0.49; }

void check_locking(const scene::CheckContext &context, scene::Diagnostics &diagnostics) {
  const double nu = context.material.real("nu");
  if (nu < 0.5 && locks({1, nu, context.material.text("model") == "plane strain"}))
    diagnostics.warning(
        context.material.location("nu"), "material.nu",
        fmt::format("{} is nearly incompressible: displacement methods in plane strain lock above 0.49, "
                    "and their errors grow",
                    nu));
}

std::string locking_warning(const problems::Material &material) {
  return fmt::format(
      "nu = {} in plane strain: displacement methods lock above 0.49; the method 'mixed' and the element "
      "'Q2Q1' do not",
      material.poisson_ratio);
}

} // namespace comparisons::methods
