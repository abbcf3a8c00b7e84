#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>

namespace meshless::linear_algebra {

/// One double per SIMD lane: as many evaluation points as the machine's vectors hold (8 with
/// AVX-512, 4 with AVX2, 2 with SSE2).
using Pack = std::experimental::native_simd<double>;
inline constexpr int n_lanes = static_cast<int>(Pack::size());

inline Pack load(const double *from) { return Pack(from, std::experimental::element_aligned); }
inline void store(const Pack &pack, double *to) { pack.copy_to(to, std::experimental::element_aligned); }

/// Smallest multiple of the number of lanes that holds n points.
inline constexpr std::size_t padded(std::size_t n) { return (n + n_lanes - 1) / n_lanes * n_lanes; }

/// e^x for -700 <= x <= 700, relative error below 4e-16.
///
/// x = k ln 2 + r with |r| <= ln 2 / 2; e^r by its Taylor polynomial of degree 13, whose remainder
/// r^14 / 14! is below 5e-18; 2^k through the exponent bits. The library's own exp for simd calls
/// the scalar function lane by lane.
inline Pack exponential(const Pack &x) {
  constexpr double log2_e = 1.44269504088896340736;
  constexpr double ln2_high = 6.93147180369123816490e-01; // 33 significant bits: k ln2_high is exact
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double round_magic = 0x1.8p52; // adding it rounds to an integer held in the low bits
  const Pack shifted = x * log2_e + round_magic;
  const Pack k = shifted - round_magic;
  const Pack r = (x - k * ln2_high) - k * ln2_low;
  constexpr double inverse_factorial[] = {1.0 / 6227020800.0,
                                          1.0 / 479001600.0,
                                          1.0 / 39916800.0,
                                          1.0 / 3628800.0,
                                          1.0 / 362880.0,
                                          1.0 / 40320.0,
                                          1.0 / 5040.0,
                                          1.0 / 720.0,
                                          1.0 / 120.0,
                                          1.0 / 24.0,
                                          1.0 / 6.0,
                                          0.5,
                                          1.0,
                                          1.0};
  Pack sum = inverse_factorial[0];
#pragma GCC unroll 16
  for (int i = 1; i < 14; ++i)
    sum = sum * r + inverse_factorial[i];
  // Unsigned: for x out of range, in lanes whose result is thrown away, the sum may pass the largest number.
  using Bits = std::experimental::rebind_simd_t<std::uint64_t, Pack>;
  const Bits exponent = (std::bit_cast<Bits>(shifted) << 52) + (std::uint64_t{1023} << 52);
  return sum * std::bit_cast<Pack>(exponent);
}

/// The scalar counterpart, so that kernels are written once for both.
inline double exponential(double x) { return std::exp(x); }

} // namespace meshless::linear_algebra
