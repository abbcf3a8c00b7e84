#include "targets.h"

#include <array>

namespace fuzzing {

std::span<const Target> targets() {
  static constexpr std::array<Target, 7> all{{{"scene", scene},
                                              {"cloud_csv", cloud_csv},
                                              {"cloud_vtk", cloud_vtk},
                                              {"results", results},
                                              {"checkpoint", checkpoint},
                                              {"mesh_structure", mesh_structure},
                                              {"mesh_data", mesh_data}}};
  return all;
}

} // namespace fuzzing
