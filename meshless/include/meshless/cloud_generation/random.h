#pragma once

#include <cstdint>

namespace meshless::cloud_generation {

/// SplitMix64 (Steele, Lea & Flood 2014): the same numbers for a seed on every machine, unlike the
/// distributions of the standard library.
class Random {
public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [-1, 1).
  double symmetric() { return static_cast<double>(next() >> 11) * 0x1.0p-52 - 1; }
  /// Uniform in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

private:
  std::uint64_t next() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }

  std::uint64_t state_;
};

} // namespace meshless::cloud_generation
