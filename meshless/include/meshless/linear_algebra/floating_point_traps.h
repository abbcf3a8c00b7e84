#pragma once

#ifndef NDEBUG
#include <cfenv>
#endif

namespace meshless::linear_algebra {

/// In Debug builds: while it lives, a division by zero and an operation that makes a NaN of numbers (0/0, inf - inf,
/// the root of a negative) end the program with SIGFPE at the place where they happen, in this thread. In other builds
/// nothing. Overflow, underflow and rounding pass.
///
/// For numerics of this library alone: BLAS, UMFPACK, deal.II and gnuplot raise these exceptions in the course of right
/// computations, and so does code that makes a NaN in order to find it afterwards.
class FloatingPointTraps {
public:
#ifdef NDEBUG
  static constexpr bool active = false;
  FloatingPointTraps() {} // not defaulted: a scope that does nothing is no unused variable
  ~FloatingPointTraps() {}
#else
  static constexpr bool active = true;
  FloatingPointTraps() : before_(fegetexcept()) {
    std::feclearexcept(FE_ALL_EXCEPT); // what others have raised would trap with the next operation
    feenableexcept(FE_DIVBYZERO | FE_INVALID);
  }
  ~FloatingPointTraps() {
    std::feclearexcept(FE_ALL_EXCEPT);
    fedisableexcept(FE_ALL_EXCEPT);
    feenableexcept(before_);
  }
#endif
  FloatingPointTraps(const FloatingPointTraps &) = delete;
  FloatingPointTraps &operator=(const FloatingPointTraps &) = delete;

#ifndef NDEBUG
private:
  int before_;
#endif
};

} // namespace meshless::linear_algebra
