#pragma once

#include "meshless/linear_algebra/pack.h"

namespace meshless::kernels {

/// What kernels need besides arithmetic, written once for double and once for SIMD packs.
inline double square_root(double x) { return std::sqrt(x); }
/// Lane by lane, which the compiler joins to one vector instruction: with the library's own square root g++ 12 warns
/// of a variable in its intrinsics.
inline linear_algebra::Pack square_root(const linear_algebra::Pack &x) {
  return linear_algebra::Pack([&](auto lane) { return std::sqrt(static_cast<double>(x[lane])); });
}

/// a where the condition holds, b elsewhere.
inline double select(bool condition, double a, double b) { return condition ? a : b; }
inline linear_algebra::Pack select(const linear_algebra::Pack::mask_type &condition, const linear_algebra::Pack &a,
                                   linear_algebra::Pack b) {
  where(condition, b) = a;
  return b;
}

/// x where it is positive, 0 elsewhere.
inline double positive_part(double x) { return x > 0 ? x : 0; }
inline linear_algebra::Pack positive_part(const linear_algebra::Pack &x) { return max(x, linear_algebra::Pack(0)); }

/// x / s, and 0 at s = 0: the slope W'(s) / s of a kernel with a kink, where W'(0) = 0 is agreed.
template <typename T>
T over_distance(const T &x, const T &s) {
  return select(s > T(0), x / select(s > T(0), s, T(1)), T(0));
}

} // namespace meshless::kernels
