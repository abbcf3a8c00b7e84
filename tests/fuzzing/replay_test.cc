// Every file of the corpus, among them what once broke a reader, through the readers as the product is compiled.

#include "targets/targets.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

namespace fs = std::filesystem;

TEST(Fuzzing, TheCorpusHarmsNoReader) {
  for (const auto &target : fuzzing::targets()) {
    int n_files = 0;
    for (const auto &file : fs::directory_iterator(fs::path(PETROV_SOURCE_DIR) / "tests/fuzzing" / target.name)) {
      std::ifstream stream(file.path(), std::ios::binary);
      const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
      EXPECT_NO_THROW(target.run(bytes)) << file.path();
      ++n_files;
    }
    EXPECT_GT(n_files, 1) << target.name;
  }
}

} // namespace
