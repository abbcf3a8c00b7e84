#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#ifdef __AVX512F__
#include <immintrin.h>
#endif

namespace meshless::linear_algebra {

/// One double per SIMD lane: as many evaluation points as the machine's vectors hold (8 with
/// AVX-512, 4 with AVX2, 2 with SSE2).
using Pack = std::experimental::native_simd<double>;
inline constexpr int n_lanes = static_cast<int>(Pack::size());

inline Pack load(const double *from) { return Pack(from, std::experimental::element_aligned); }
inline void store(const Pack &pack, double *to) { pack.copy_to(to, std::experimental::element_aligned); }

/// from[step * index] of every lane's index.
template <int step>
inline Pack gather(const double *from, const std::int32_t *index) {
#ifdef __AVX512F__
  static_assert(step >= 1 && step <= 3);
  // With masks of all lanes: of the plain intrinsics g++ 12 warns that they use a variable uninitialised.
  const __m512i wide = _mm512_maskz_cvtepi32_epi64(0xff, _mm256_loadu_si256(reinterpret_cast<const __m256i *>(index)));
  __m512i places = wide;
  for (int i = 1; i < step; ++i)
    places = _mm512_add_epi64(places, wide);
  return std::bit_cast<Pack>(_mm512_mask_i64gather_pd(_mm512_setzero_pd(), 0xff, places, from, sizeof(double)));
#else
  return Pack([&](auto lane) { return from[std::ptrdiff_t{step} * index[lane]]; });
#endif
}

/// Writes the indices of the lanes where the condition holds one after another.
/// @param to room for those of all lanes
/// @returns the place behind the last one
inline std::int32_t *append_where(const Pack::mask_type &condition, const std::int32_t *indices, std::int32_t *to) {
#ifdef __AVX512VL__
  const auto mask = std::bit_cast<__mmask8>(condition);
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(indices));
  _mm256_storeu_si256(reinterpret_cast<__m256i *>(to), _mm256_maskz_compress_epi32(mask, all));
  return to + std::popcount(mask);
#else
  for (int lane = 0; lane < n_lanes; ++lane) {
    *to = indices[lane];
    to += condition[lane];
  }
  return to;
#endif
}

/// Smallest multiple of the number of lanes that holds n points.
inline constexpr std::size_t padded(std::size_t n) { return (n + n_lanes - 1) / n_lanes * n_lanes; }

/// e^x for -700 <= x <= 700, relative error below 4e-16. The library's own exp for simd calls the scalar function lane
/// by lane.
///
/// x = (k + j / 16) ln 2 + r with |r| <= a = ln 2 / 32; 2^(j/16) from a table that two registers hold, 2^k through the
/// exponent bits, e^r - 1 by its Taylor polynomial of degree 7 with r^7 economised: on [-a, a] it is
/// 7/4 a^2 r^5 - 7/8 a^4 r^3 + 7/64 a^6 r but for a^7 / 64, which leaves 7e-18. Without such registers j = 0,
/// a = ln 2 / 2 and the Taylor polynomial has degree 13, whose remainder r^14 / 14! is below 5e-18.
inline Pack exponential(const Pack &x) {
  constexpr double log2_e = 1.44269504088896340736;
  constexpr double ln2_high = 6.93147180369123816490e-01; // 33 significant bits: k ln2_high is exact
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr double round_magic = 0x1.8p52; // adding it rounds to an integer held in the low bits
  using Bits = std::experimental::rebind_simd_t<std::uint64_t, Pack>;
#ifdef __AVX512F__
  alignas(64) static constexpr double roots[] = {0x1p+0,
                                                 0x1.0b5586cf9890fp+0,
                                                 0x1.172b83c7d517bp+0,
                                                 0x1.2387a6e756238p+0,
                                                 0x1.306fe0a31b715p+0,
                                                 0x1.3dea64c123422p+0,
                                                 0x1.4bfdad5362a27p+0,
                                                 0x1.5ab07dd485429p+0,
                                                 0x1.6a09e667f3bcdp+0,
                                                 0x1.7a11473eb0187p+0,
                                                 0x1.8ace5422aa0dbp+0,
                                                 0x1.9c49182a3f090p+0,
                                                 0x1.ae89f995ad3adp+0,
                                                 0x1.c199bdd85529cp+0,
                                                 0x1.d5818dcfba487p+0,
                                                 0x1.ea4afa2a490dap+0};
  constexpr double a2 = 0.02166084939249829 * 0.02166084939249829;
  constexpr double c[] = {1 + 7. / 64 * a2 * a2 * a2 / 5040, 1. / 2,  1. / 6 - 7. / 8 * a2 * a2 / 5040, 1. / 24,
                          1. / 120 + 7. / 4 * a2 / 5040,     1. / 720};
  const Pack shifted = x * (16 * log2_e) + round_magic;
  const Pack n = shifted - round_magic;
  const Pack r = (x - n * (ln2_high / 16)) - n * (ln2_low / 16);
  const Bits bits = std::bit_cast<Bits>(shifted);
  const __m512d root = _mm512_permutex2var_pd(_mm512_load_pd(roots), std::bit_cast<__m512i>(bits),
                                              _mm512_load_pd(roots + 8)); // by the lowest four bits
  const Pack power = std::bit_cast<Pack>(std::bit_cast<Bits>(root) + ((bits >> 4) << 52));
  Pack sum = c[5];
#pragma GCC unroll 8
  for (int i = 4; i >= 0; --i)
    sum = sum * r + c[i];
  return power * (sum * r) + power;
#else
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
  const Bits exponent = (std::bit_cast<Bits>(shifted) << 52) + (std::uint64_t{1023} << 52);
  return sum * std::bit_cast<Pack>(exponent);
#endif
}

/// The scalar counterpart, so that kernels are written once for both.
inline double exponential(double x) { return std::exp(x); }

} // namespace meshless::linear_algebra
