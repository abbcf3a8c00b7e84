#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>
#include <string_view>

/// What a refused call says: the words a user needs must be in it.
namespace refusal {

/// The message of the error that the call throws, or nothing if it throws none.
template <typename Error, typename Call>
std::string message_of(const Call &call) {
  try {
    call();
  } catch (const Error &error) {
    return error.what();
  }
  return "";
}

inline testing::AssertionResult mentions(std::string_view message, std::initializer_list<std::string_view> words) {
  for (const auto word : words)
    if (message.find(word) == std::string_view::npos)
      return testing::AssertionFailure() << "'" << word << "' is missing in '" << message << "'";
  return testing::AssertionSuccess();
}

} // namespace refusal
