#pragma once

#include <nlohmann/json.hpp>

namespace comparisons::reports {

/// How deep arrays and objects of a file may lie within each other; what Petrov writes has six levels at most.
inline constexpr int largest_json_depth = 100;

/// Looks through a text or CBOR bytes before they become values. The library's CBOR reader and its writer call
/// themselves for every level: a file of a megabyte of opening brackets would overflow the stack.
class JsonDepth final : public nlohmann::json_sax<nlohmann::json> {
public:
  /// False if the bytes are nested too deep; whether they are complete, the parser says.
  template <typename Bytes>
  static bool is_bounded(const Bytes &bytes, nlohmann::json::input_format_t format) {
    JsonDepth depth;
    nlohmann::json::sax_parse(bytes.begin(), bytes.end(), &depth, format);
    return !depth.too_deep_;
  }

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t &) override { return true; }
  bool string(string_t &) override { return true; }
  bool binary(binary_t &) override { return true; }
  bool key(string_t &) override { return true; }
  bool start_object(std::size_t) override { return down(); }
  bool end_object() override { return up(); }
  bool start_array(std::size_t) override { return down(); }
  bool end_array() override { return up(); }
  bool parse_error(std::size_t, const std::string &, const nlohmann::detail::exception &) override { return false; }

private:
  bool down() {
    too_deep_ = ++depth_ > largest_json_depth;
    return !too_deep_;
  }
  bool up() {
    --depth_;
    return true;
  }

  int depth_ = 0;
  bool too_deep_ = false;
};

} // namespace comparisons::reports
