#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <initializer_list>
#include <span>
#include <type_traits>
#include <utility>

namespace meshless::linear_algebra {

/// Bytes for an array that grows. Many of them are pages of their own, which growing moves instead of copying; they are
/// large ones where the system grants them on request: their first use and their look-up cost less.
class GrowingBytes {
public:
  GrowingBytes() = default;
  GrowingBytes(GrowingBytes &&other) noexcept
      : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  GrowingBytes &operator=(GrowingBytes &&other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~GrowingBytes();

  void *data() const { return data_; }
  std::size_t size() const { return size_; }
  /// At least as many; what is there stays.
  /// @throws std::bad_alloc
  void grow(std::size_t size);

private:
  void *data_ = nullptr;
  std::size_t size_ = 0;
};

/// A vector of plain numbers for matrices. New entries are left as they are: to set them costs as much as to use them.
template <typename T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T>);

public:
  LargeArray() = default;
  LargeArray(std::initializer_list<T> values) { append({values.begin(), values.size()}); }
  LargeArray(LargeArray &&other) noexcept : bytes_(std::move(other.bytes_)), size_(std::exchange(other.size_, 0)) {}
  LargeArray(const LargeArray &other) { append(other); }
  LargeArray &operator=(LargeArray other) noexcept {
    std::swap(bytes_, other.bytes_);
    std::swap(size_, other.size_);
    return *this;
  }

  std::size_t size() const { return size_; }
  std::size_t capacity() const { return bytes_.size() / sizeof(T); }
  bool empty() const { return size_ == 0; }
  T *data() { return static_cast<T *>(bytes_.data()); }
  const T *data() const { return static_cast<const T *>(bytes_.data()); }
  T *begin() { return data(); }
  T *end() { return data() + size_; }
  const T *begin() const { return data(); }
  const T *end() const { return data() + size_; }
  T &operator[](std::size_t i) { return data()[i]; }
  const T &operator[](std::size_t i) const { return data()[i]; }
  operator std::span<const T>() const { return {data(), size_}; }

  /// Room for n in all.
  void reserve(std::size_t n) {
    if (n > capacity())
      bytes_.grow(n * sizeof(T));
  }
  /// New entries have no value yet.
  void resize(std::size_t n) {
    if (n > capacity())
      reserve(std::max(n, capacity() + capacity() / 4));
    size_ = n;
  }
  void clear() { size_ = 0; }
  void push_back(const T &value) {
    const T copy = value; // it may be one of those that move
    resize(size_ + 1);
    data()[size_ - 1] = copy;
  }
  /// @param values not of this array
  void append(std::span<const T> values) {
    const std::size_t first = size_;
    resize(first + values.size());
    if (!values.empty())
      std::memcpy(data() + first, values.data(), values.size_bytes());
  }

private:
  GrowingBytes bytes_;
  std::size_t size_ = 0;
};

} // namespace meshless::linear_algebra
