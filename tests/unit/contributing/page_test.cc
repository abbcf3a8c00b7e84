// CONTRIBUTING.md shows code that compiles: every block stands in the file that it names, and what the page names
// exists.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const fs::path source(PETROV_SOURCE_DIR);
const fs::path examples = source / "tests/system/contributing";

std::string contents(const fs::path &file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// A fenced block: "```cpp FILE" and the lines up to the next fence.
struct Block {
  std::string language;
  std::string file;
  std::string text;
};

std::vector<Block> blocks_of(const std::string &page) {
  std::vector<Block> blocks;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("```")) {
      inside = !inside;
      if (inside) {
        std::istringstream words(line.substr(3));
        words >> blocks.emplace_back().language >> blocks.back().file;
      }
    } else if (inside)
      blocks.back().text += line + "\n";
  return blocks;
}

/// Whether the text stands in the file as whole lines.
bool stands_in(const std::string &text, const std::string &file) {
  return !text.empty() && ("\n" + file).find("\n" + text) != std::string::npos;
}

std::string page() { return contents(source / "CONTRIBUTING.md"); }

TEST(ContributingPage, code_stands_verbatim_in_the_files_that_it_names) {
  std::map<std::string, int> shown;
  for (const auto &block : blocks_of(page())) {
    if (block.language != "cpp" && block.language != "cmake" && block.file.empty())
      continue; // shell commands
    ASSERT_TRUE(fs::is_regular_file(source / block.file)) << "'" << block.file << "' of the block\n" << block.text;
    EXPECT_TRUE(stands_in(block.text, contents(source / block.file))) << "not in " << block.file << ":\n" << block.text;
    ++shown[block.file];
  }
  for (const auto &entry : fs::directory_iterator(examples))
    if (entry.path().extension() == ".cc") {
      EXPECT_GE(shown[fs::relative(entry.path(), source).string()], 1) << entry.path();
    }
}

TEST(ContributingPage, a_changed_line_would_be_noticed) {
  const std::string file = "a\n  b = 1;\n  c\n";
  EXPECT_TRUE(stands_in("a\n  b = 1;\n", file));
  EXPECT_TRUE(stands_in("  b = 1;\n  c\n", file));
  EXPECT_FALSE(stands_in("  b = 2;\n", file));
  EXPECT_FALSE(stands_in("b = 1;\n", file)) << "half a line";
  EXPECT_FALSE(stands_in("  b = 1\n", file)) << "half a line";
  EXPECT_FALSE(stands_in("a\n  c\n", file)) << "a line left out";
  const auto blocks = blocks_of("x\n```cpp f.cc\na\n\nb\n```\n```\nls\n```\n");
  ASSERT_EQ(blocks.size(), 2u);
  EXPECT_EQ(blocks[0].file, "f.cc");
  EXPECT_EQ(blocks[0].text, "a\n\nb\n");
  EXPECT_EQ(blocks[1].file, "");
}

TEST(ContributingPage, every_path_exists) {
  const std::string text = page();
  // `meshless/source/...` and [..](...): words with a slash, without placeholders.
  const std::regex path(R"((`|\]\()([A-Za-z_.][A-Za-z0-9_.\-]*/[A-Za-z0-9_./\-]*)(`|\)))");
  int n_paths = 0;
  for (std::sregex_iterator match(text.begin(), text.end(), path), end; match != end; ++match) {
    const std::string name = (*match)[2];
    if (name.starts_with("build/"))
      continue;
    ++n_paths;
    EXPECT_TRUE(fs::exists(source / name)) << name;
  }
  EXPECT_GE(n_paths, 10);
}

TEST(ContributingPage, presets_and_options_are_those_of_cmake) {
  const std::string text = page();
  const std::string presets = contents(source / "CMakePresets.json");
  const std::string cmake = contents(source / "CMakeLists.txt");
  const auto first_words = [&](const std::string &header) {
    std::vector<std::string> words;
    std::istringstream lines(text.substr(text.find(header)));
    std::string line;
    std::getline(lines, line);
    for (std::getline(lines, line); std::getline(lines, line) && line.starts_with("| ");)
      words.push_back(line.substr(2, line.find(' ', 2) - 2));
    return words;
  };
  ASSERT_NE(text.find("| preset |"), std::string::npos);
  ASSERT_NE(text.find("| option |"), std::string::npos);
  for (const auto &preset : first_words("| preset |"))
    EXPECT_NE(presets.find("\"configurePreset\": \"" + preset + "\""), std::string::npos) << preset;
  const auto options = first_words("| option |");
  for (const auto &option : options)
    EXPECT_TRUE(cmake.find("option(" + option + " ") != std::string::npos ||
                cmake.find("set(" + option + " ") != std::string::npos)
        << option;
  const std::regex declaration(R"((option|set)\((PETROV_[A-Z_]+) )");
  for (std::sregex_iterator match(cmake.begin(), cmake.end(), declaration), end; match != end; ++match)
    EXPECT_NE(std::find(options.begin(), options.end(), (*match)[2]), options.end()) << (*match)[2] << " is left out";
}

TEST(ContributingPage, the_library_alone_takes_forty_lines_and_no_other_library_of_ours) {
  const std::string text = contents(examples / "meshless_only.cc");
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 40);
  const std::regex include(R"(#include ["<]([^">]*)[">])");
  for (std::sregex_iterator match(text.begin(), text.end(), include), end; match != end; ++match) {
    const std::string name = (*match)[1];
    EXPECT_TRUE(name.starts_with("meshless/") || name.starts_with("fmt/") || name.find('/') == std::string::npos)
        << name;
  }
  const std::string linked = contents(source / "tests/CMakeLists.txt");
  EXPECT_NE(linked.find("(meshless_only PRIVATE Petrov::meshless)"), std::string::npos);
}

} // namespace
