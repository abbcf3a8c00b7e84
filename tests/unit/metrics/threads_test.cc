// The number of threads of a study reaches both libraries.

#include "comparisons/metrics/machine.h"

#include "fem_reference/threads.h"
#include "meshless/parallel/threads.h"

#include <gtest/gtest.h>

TEST(UseThreads, SetsParticlesAndFiniteElements) {
  for (const int n : {2, 1}) {
    comparisons::metrics::use_threads(n);
    EXPECT_EQ(meshless::parallel::threads(), n);
    EXPECT_EQ(fem_reference::threads(), n);
  }
}
