#pragma once

#include "comparisons/reports/json.h"
#include "system/program_process.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <thread>
#include <vector>

/// What a run that was ended at any moment may leave: whole files, and hidden ones.
namespace system_tests {

/// Number of fields of every row (RFC 4180); a last row without its line end counts as 0.
inline std::vector<std::size_t> fields_of_rows(const std::string &csv) {
  std::vector<std::size_t> rows;
  std::size_t fields = 1;
  bool quoted = false;
  for (const char c : csv) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      ++fields;
    else if (c == '\n' && !quoted) {
      rows.push_back(fields);
      fields = 1;
    }
  }
  if (quoted || !csv.ends_with('\n'))
    rows.push_back(0);
  return rows;
}

inline void expect_whole(const fs::path &file) {
  const auto name = file.filename().string();
  const std::string text = contents(file);
  if (name.starts_with(".")) // a name of its own, as a killed process leaves it
    return;
  const auto ending = file.extension();
  if (ending == ".json") {
    EXPECT_NO_THROW(comparisons::reports::parse_results(text)) << file;
  } else if (ending == ".csv") {
    const auto rows = fields_of_rows(text);
    ASSERT_GT(rows.size(), 1u) << file;
    for (const auto n : rows)
      ASSERT_EQ(n, rows.front()) << file;
  } else {
    const std::set<std::string> known{".txt", ".md", ".tex", ".html", ".dat", ".gp", ".svg", ".pdf", ".vtu", ".pvd"};
    EXPECT_TRUE(known.contains(ending.string())) << "an unknown file " << file;
    if (ending == ".html")
      EXPECT_TRUE(text.find("</html>") != std::string::npos) << file;
    else if (ending == ".pdf")
      EXPECT_TRUE(text.find("%%EOF") != std::string::npos) << file;
    else
      EXPECT_TRUE(text.ends_with('\n')) << file;
  }
}

inline void expect_whole_folder(const fs::path &folder) {
  if (!fs::exists(folder))
    return;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      expect_whole(entry.path());
}

inline std::size_t n_temporary_files(const fs::path &folder) {
  std::size_t n = 0;
  for (const auto &entry : fs::recursive_directory_iterator(folder))
    n += entry.path().extension() == ".tmp" ? 1 : 0;
  return n;
}

/// When the folder of curves last got a file; the earliest time if there is none.
inline fs::file_time_type last_curve(const fs::path &folder) {
  std::error_code none;
  const auto time = fs::last_write_time(folder / "series", none);
  return none ? fs::file_time_type::min() : time;
}

/// Waits until the run has begun: it has made, or written in, its folder of curves.
inline void wait_for_run(const fs::path &folder, fs::file_time_type before = fs::file_time_type::min()) {
  for (int i = 0; i < 4000 && last_curve(folder) == before; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ASSERT_NE(last_curve(folder), before);
}

} // namespace system_tests
