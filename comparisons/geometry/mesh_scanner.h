#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace comparisons::geometry {

/// What is wrong with the structure of a file, and where.
struct StructureError {
  unsigned line = 0; ///< 0 if there are no lines
  std::string message;
  std::string suggestion;
};

/// Walks over the bytes of a mesh file, line by line or number by number.
class MeshScanner {
public:
  explicit MeshScanner(std::string_view bytes) : bytes_(bytes) {}

  bool at_end() const { return at_ >= bytes_.size(); }
  std::size_t remaining() const { return bytes_.size() - at_; }
  /// Number of the line that begins here, from 1; lines are counted as they are read.
  unsigned line() const { return line_; }
  std::size_t position() const { return at_; }

  /// The rest of the line without its end.
  std::string_view read_line() {
    const auto end = bytes_.find('\n', at_);
    std::string_view text = bytes_.substr(at_, end == std::string_view::npos ? end : end - at_);
    at_ = end == std::string_view::npos ? bytes_.size() : end + 1;
    ++line_;
    if (!text.empty() && text.back() == '\r')
      text.remove_suffix(1);
    return text;
  }

  /// The next bytes as a number; nothing if the file ends before.
  template <typename T>
  std::optional<T> read_binary() {
    if (remaining() < sizeof(T))
      return {};
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }

  /// Passes over n items of `size` bytes; false if the file is shorter.
  bool skip(std::uint64_t n, std::uint64_t size) {
    if (size != 0 && n > remaining() / size)
      return false;
    at_ += static_cast<std::size_t>(n * size);
    return true;
  }

  /// Passes over everything up to the text, which is not taken; false if it does not come.
  bool skip_to(std::string_view text) {
    const auto found = bytes_.find(text, at_);
    if (found == std::string_view::npos)
      return false;
    for (; at_ < found; ++at_)
      line_ += bytes_[at_] == '\n' ? 1 : 0;
    return true;
  }

private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  unsigned line_ = 1;
};

} // namespace comparisons::geometry
