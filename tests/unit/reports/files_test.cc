#include "comparisons/reports/files.h"

#include "comparisons/reports/reports.h"
#include "unit/reports/sample.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <unistd.h>

using namespace comparisons::reports;
namespace fs = std::filesystem;

namespace {

class Files : public testing::Test {
protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "petrov_files_XXXXXX").string();
    ASSERT_NE(::mkdtemp(name.data()), nullptr);
    directory_ = name;
  }
  void TearDown() override {
    std::error_code ignored;
    fs::permissions(directory_, fs::perms::owner_all, ignored);
    fs::remove_all(directory_, ignored);
  }

  static std::string read(const fs::path &path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::size_t count_files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(directory_), fs::directory_iterator()));
  }

  fs::path directory_;
};

/// No file may grow beyond `bytes`: the write fails as on a full disk.
class SmallDisk {
public:
  explicit SmallDisk(rlim_t bytes) {
    old_handler_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &old_limit_);
    rlimit limit = old_limit_;
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    ::setrlimit(RLIMIT_FSIZE, &old_limit_);
    std::signal(SIGXFSZ, old_handler_);
  }
  SmallDisk(const SmallDisk &) = delete;
  SmallDisk &operator=(const SmallDisk &) = delete;

private:
  rlimit old_limit_{};
  void (*old_handler_)(int) = SIG_DFL;
};

/// Root may write everywhere, so for a moment this process is nobody.
class OrdinaryUser {
public:
  OrdinaryUser() : old_(::geteuid()) {
    if (old_ == 0) {
      EXPECT_EQ(::seteuid(65534), 0);
    }
  }
  ~OrdinaryUser() { EXPECT_EQ(::seteuid(old_), 0); }
  OrdinaryUser(const OrdinaryUser &) = delete;
  OrdinaryUser &operator=(const OrdinaryUser &) = delete;

private:
  uid_t old_;
};

template <typename Action>
std::string output_complaint(Action action) {
  try {
    action();
  } catch (const OutputError &error) {
    return error.what();
  }
  return "no complaint";
}

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

} // namespace

TEST_F(Files, WriteAndReplace) {
  write_file_atomically(directory_ / "a.txt", "first");
  write_file_atomically(directory_ / "a.txt", "second");
  EXPECT_EQ(read(directory_ / "a.txt"), "second");
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(Files, FullDiskLeavesTheOldFileAndNothingElse) {
  write_file_atomically(directory_ / "a.txt", "old");
  const std::string large(100000, 'x');
  std::string complaint;
  {
    const SmallDisk disk(4096);
    complaint = output_complaint([&] { write_file_atomically(directory_ / "a.txt", large); });
  }
  EXPECT_TRUE(contains(complaint, "a.txt: cannot write: File too large")) << complaint;
  EXPECT_EQ(read(directory_ / "a.txt"), "old");
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(Files, FullDiskDuringReportsLeavesNoHalfFile) {
  const Results results = reports_sample::results();
  const std::size_t csv_size = csv_report(results).size();
  std::string complaint;
  {
    // Too little for JSON and CSV, enough for the ledger.
    const SmallDisk disk(csv_size / 2);
    complaint = output_complaint([&] { write_reports(results, directory_, {"json", "csv"}, "results"); });
  }
  EXPECT_TRUE(contains(complaint, "results.json: cannot write")) << complaint;
  EXPECT_EQ(count_files(), 0u);
}

TEST_F(Files, ParentThatIsAFile) {
  write_file_atomically(directory_ / "file", "x");
  const std::string complaint = output_complaint([&] { write_file_atomically(directory_ / "file" / "a.txt", "y"); });
  EXPECT_TRUE(contains(complaint, "a.txt: cannot create a file in this directory: Not a directory")) << complaint;
  EXPECT_TRUE(contains(output_complaint([&] { prepare_output_directory(directory_ / "file" / "out"); }),
                       "cannot create the output directory"));
  EXPECT_TRUE(contains(output_complaint([&] { prepare_output_directory(directory_ / "file"); }), "file"));
  EXPECT_EQ(read(directory_ / "file"), "x");
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(Files, TargetThatIsADirectory) {
  fs::create_directory(directory_ / "a.txt");
  const std::string complaint = output_complaint([&] { write_file_atomically(directory_ / "a.txt", "y"); });
  EXPECT_TRUE(contains(complaint, "cannot rename")) << complaint;
  EXPECT_EQ(count_files(), 1u);
}

TEST_F(Files, DirectoryWithoutTheRightToWrite) {
  fs::permissions(directory_, fs::perms::owner_read | fs::perms::owner_exec);
  const OrdinaryUser user;
  EXPECT_TRUE(contains(output_complaint([&] { prepare_output_directory(directory_); }), "Permission denied"));
  EXPECT_TRUE(contains(output_complaint([&] { write_file_atomically(directory_ / "a", "y"); }), "Permission denied"));
}

TEST_F(Files, PreparingMakesTheDirectoryAndLeavesItEmpty) {
  prepare_output_directory(directory_ / "a" / "b");
  EXPECT_TRUE(fs::is_directory(directory_ / "a" / "b"));
  EXPECT_TRUE(fs::is_empty(directory_ / "a" / "b"));
  prepare_output_directory(directory_ / "a" / "b");
  EXPECT_THROW(prepare_output_directory(""), OutputError);
}

TEST_F(Files, ReportsAreWrittenByFormat) {
  const auto files = write_reports(reports_sample::results(), directory_ / "out", report_formats(), "results");
  const std::vector<fs::path> expected{
      directory_ / "out" / "results.txt",  directory_ / "out" / "results.md",
      directory_ / "out" / "results.csv",  directory_ / "out" / "results_published.csv",
      directory_ / "out" / "results.json", directory_ / "out" / "results_tables.tex",
      directory_ / "out" / "results.tex",  directory_ / "out" / "report.html",
      directory_ / "out" / "figures"};
  EXPECT_EQ(files, expected);
  for (const fs::path &file : files)
    EXPECT_TRUE(fs::is_directory(file) || fs::file_size(file) > 100u) << file;
  EXPECT_THROW(write_reports(Results(), directory_ / "other", {"text", "word"}, "results"), std::invalid_argument);
  EXPECT_FALSE(fs::exists(directory_ / "other"));
}
