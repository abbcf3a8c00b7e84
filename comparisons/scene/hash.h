#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string>

namespace comparisons::scene {

/// FNV-1a, 64 bit: tells files and requests apart, and is no protection against intent.
class Hash {
public:
  void add(const void *data, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i)
      hash_ = (hash_ ^ static_cast<const unsigned char *>(data)[i]) * 0x100000001B3U;
  }
  /// The text and a zero byte.
  void add(const std::string &text) { add(text.c_str(), text.size() + 1); }
  /// Hexadecimal.
  std::string text() const { return fmt::format("{:016x}", hash_); }

private:
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

} // namespace comparisons::scene
