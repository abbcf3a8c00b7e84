// What libFuzzer calls; compiled once for every target, PETROV_FUZZ_TARGET being its name.

#include "targets/targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  fuzzing::PETROV_FUZZ_TARGET({reinterpret_cast<const char *>(data), size});
  return 0;
}
