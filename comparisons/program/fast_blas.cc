#include "comparisons/program/fast_blas.h"

#include <cstdlib>
#include <string_view>
#include <unistd.h>

// OpenBLAS's own call; its header clashes with other CBLAS headers.
extern "C" char *openblas_get_corename(void);

namespace comparisons::program {

void restart_with_fast_blas(char **argv) {
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr)
    return; // the user's choice, or ours after the restart
#if defined(__x86_64__)
  const std::string_view core = openblas_get_corename();
  if (core != "Prescott" || !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    return;
  setenv("OPENBLAS_CORETYPE", "Haswell", 1);
  execv("/proc/self/exe", argv);
  // Without /proc the program goes on, only slower.
#endif
}

} // namespace comparisons::program
