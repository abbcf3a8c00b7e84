#include "comparisons/scene/document.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

namespace comparisons::scene {

namespace {

constexpr std::size_t largest_file = std::size_t{16} << 20U;

/// A file name beside the missing one that is spelt nearly the same.
std::string suggest_file(const std::filesystem::path &file) {
  std::error_code status;
  const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::vector<std::string> names;
  constexpr std::size_t most = 1000;
  std::filesystem::directory_iterator entry(folder, status);
  while (!status && entry != std::filesystem::directory_iterator{} && names.size() < most) {
    names.push_back(entry->path().filename().string());
    entry.increment(status);
  }
  return did_you_mean(file.filename().string(), names);
}

/// Length of the UTF-8 sequence at the start of the text; 0 if it is none (overlong forms,
/// surrogates and values above U+10FFFF included).
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i])) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const unsigned first = byte(0);
  if (first < 0x80U)
    return 1;
  if (first >= 0xC2U && first <= 0xDFU)
    return follows(1) ? 2 : 0;
  if (first >= 0xE0U && first <= 0xEFU) {
    const bool overlong = first == 0xE0U && byte(1) < 0xA0U;
    const bool surrogate = first == 0xEDU && byte(1) > 0x9FU;
    return follows(1) && follows(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0U && first <= 0xF4U) {
    const bool overlong = first == 0xF0U && byte(1) < 0x90U;
    const bool beyond = first == 0xF4U && byte(1) > 0x8FU;
    return follows(1) && follows(2) && follows(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

} // namespace

std::optional<std::string> read_file(const std::filesystem::path &file, Diagnostics &diagnostics) {
  const Location location{.file = file.string()};
  std::error_code status;
  const auto kind = std::filesystem::status(file, status).type();
  if (kind == std::filesystem::file_type::not_found) {
    diagnostics.error(location, {}, "no such file", suggest_file(file));
    return std::nullopt;
  }
  if (kind == std::filesystem::file_type::directory) {
    diagnostics.error(location, {}, "is a directory, not a scene file",
                      "name the file, for example " + (file / "scene.toml").string());
    return std::nullopt;
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  constexpr std::size_t block = 65536;
  std::string buffer(block, '\0');
  while (stream && text.size() <= largest_file) {
    stream.read(buffer.data(), static_cast<std::streamsize>(block));
    text.append(buffer, 0, static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > largest_file) {
    diagnostics.error(location, {}, "is larger than 16 MiB; this is no scene");
    return std::nullopt;
  }
  if (!stream.eof()) {
    diagnostics.error(location, {}, "cannot be read", "check the file's permissions");
    return std::nullopt;
  }
  return text;
}

bool is_plain_utf8(std::string_view text, std::size_t &position) {
  for (position = 0; position < text.size();) {
    const std::size_t length = sequence_length(text.substr(position));
    if (length == 0 || text[position] == '\0')
      return false;
    position += length;
  }
  return true;
}

} // namespace comparisons::scene
