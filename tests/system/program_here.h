#pragma once

#include "comparisons/program/program.h"
#include "system/program_process.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace system_tests {

/// The program within this process, in a folder, with its texts: the same code but for main(), and half a second less
/// a call.
inline Ended run_here(const std::vector<std::string> &arguments, const fs::path &folder,
                      const comparisons::study::Catalogue &catalogue = comparisons::study::shipped_catalogue()) {
  std::vector<const char *> argv{"petrov"};
  for (const auto &argument : arguments)
    argv.push_back(argument.c_str());
  const int argc = static_cast<int>(argv.size());
  argv.push_back(nullptr);
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Ended ended;
  ended.exit_code = comparisons::program::run_program(argc, argv.data(), catalogue);
  ended.out = testing::internal::GetCapturedStdout();
  ended.err = testing::internal::GetCapturedStderr();
  fs::current_path(before);
  return ended;
}

} // namespace system_tests
