// In Debug builds a NaN ends the program where it is made; in Release it goes its way to the checks of the cells.

#include "meshless/linear_algebra/floating_point_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <limits>

namespace {

using meshless::linear_algebra::FloatingPointTraps;

volatile double zero = 0; // volatile: computed when the program runs
volatile double largest = std::numeric_limits<double>::max();
volatile double result = 0;

void divide_by_zero() { result = 1 / zero; }
void zero_over_zero() { result = zero / zero; }
void root_of_a_negative() { result = std::sqrt(zero - 1); }

} // namespace

TEST(FloatingPointTraps, ADebugProgramEndsWhereANumberIsLost) {
  for (const auto operation : {divide_by_zero, zero_over_zero, root_of_a_negative}) {
    const auto guarded = [&] {
      const FloatingPointTraps traps;
      operation();
    };
    if (FloatingPointTraps::active) {
      EXPECT_EXIT(
          {
            std::signal(SIGFPE, SIG_DFL); // a sanitizer has a handler of its own
            guarded();
          },
          testing::KilledBySignal(SIGFPE), "");
    } else {
      guarded();
      EXPECT_FALSE(std::isfinite(result));
    }
  }
}

TEST(FloatingPointTraps, OverflowPassesAndOutsideOfTheScopeAllDoes) {
  {
    const FloatingPointTraps traps;
    result = 2 * largest;
    EXPECT_TRUE(std::isinf(result));
  }
  divide_by_zero();
  EXPECT_TRUE(std::isinf(result));
  { // What was raised before does not trap within.
    const FloatingPointTraps traps;
    result = largest - 1;
  }
  zero_over_zero();
  EXPECT_TRUE(std::isnan(result));
}
