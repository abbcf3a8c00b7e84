#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace comparisons::scene {

/// A finding of the scan before the parse.
struct SyntaxFinding {
  std::size_t position = 0;
  std::string message;
  std::string suggestion;
};

/// Looks for what the TOML parser must not meet:
/// - keys of more than 8 parts: the parser's tables are as deep as the key and are freed by recursion;
/// - characters beyond ASCII outside texts and comments, which are wrong TOML, and behind a line's
///   ending backslash: the parser's test for white space (toml++ 3.3) is undefined for them.
std::optional<SyntaxFinding> scan_syntax(std::string_view text);

} // namespace comparisons::scene
