#include "targets.h"

#include "comparisons/study/checkpoint.h"

#include <vector>

namespace fuzzing {

void checkpoint(std::string_view bytes) {
  using namespace comparisons::study;
  const std::vector<double> before{-1, -2, -3};
  std::vector<double> displacement = before;
  std::vector<double> time{-4};
  const meshless::dynamics::State state{{"displacement", displacement}, {"time", time}};
  try {
    parse_checkpoint(std::string(bytes), "checkpoint.cbor", "0123456789abcdef", state);
  } catch (const CheckpointError &error) {
    require(std::string_view(error.what()).starts_with("checkpoint checkpoint.cbor: "), "a refusal names the file");
    require(displacement == before && time[0] == -4, "what is refused leaves the state as it was");
  }
}

} // namespace fuzzing
