#pragma once

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

/// The built program as a user runs it: a process with arguments, a folder, exit code and texts.
namespace system_tests {

namespace fs = std::filesystem;

/// A new folder, removed at the end.
class Folder {
public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "petrov_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("cannot make a folder for the test");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder &) = delete;
  Folder &operator=(const Folder &) = delete;

  const fs::path &path() const { return path_; }
  fs::path operator/(const std::string &name) const { return path_ / name; }

  /// Writes a file and returns its path.
  fs::path write(const std::string &name, const std::string &text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

private:
  fs::path path_;
};

inline std::string contents(const fs::path &file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

struct Ended {
  int exit_code = -1; ///< -1 if a signal ended it
  int signal = 0;
  std::string out;
  std::string err;
};

/// A running program, leader of its own process group as a shell would have it.
class Process {
public:
  Process(const std::vector<std::string> &arguments, const fs::path &folder,
          const std::string &program = PETROV_PROGRAM)
      : out_(folder / ".stdout"), err_(folder / ".stderr") {
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> argv;
    for (auto &word : words)
      argv.push_back(word.data());
    argv.push_back(nullptr);
    prctl(PR_SET_CHILD_SUBREAPER, 1); // what outlives the program is buried here, not whenever init gets to it
    child_ = fork();
    if (child_ < 0)
      throw std::runtime_error("cannot start a process");
    if (child_ > 0) {
      setpgid(child_, child_); // here and in the child: whoever comes first
      return;
    }
    setpgid(0, 0);
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(out_, O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(err_, O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    if (chdir(folder.c_str()) != 0)
      _exit(126);
    execv(program.c_str(), argv.data());
    _exit(127);
  }
  Process(const Process &) = delete;
  Process &operator=(const Process &) = delete;
  ~Process() {
    if (child_ > 0) {
      kill(-child_, SIGKILL);
      waitpid(child_, nullptr, 0);
    }
  }

  /// To the whole group, as Ctrl-C does.
  void send(int signal) const { kill(-child_, signal); }
  /// To the program alone.
  void send_to_program(int signal) const { kill(child_, signal); }

  Ended wait() {
    int status = 0;
    while (waitpid(child_, &status, 0) < 0) {
    }
    group_ = child_;
    child_ = -1;
    Ended ended;
    if (WIFEXITED(status))
      ended.exit_code = WEXITSTATUS(status);
    else
      ended.signal = WTERMSIG(status);
    ended.out = contents(out_);
    ended.err = contents(err_);
    return ended;
  }

  /// After wait(): true once no process of the group is left, at the latest after `seconds`.
  bool left_nobody(double seconds) const {
    for (int i = 0; i < static_cast<int>(seconds / 0.02); ++i) {
      while (waitpid(-group_, nullptr, WNOHANG) > 0) {
      }
      if (kill(-group_, 0) != 0)
        return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
  }

private:
  static void redirect(const fs::path &file, int flags, int descriptor) {
    const int opened = open(file.c_str(), flags, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0)
      _exit(125);
    close(opened);
  }

  fs::path out_;
  fs::path err_;
  pid_t child_ = -1;
  pid_t group_ = -1;
};

inline Ended run_program(const std::vector<std::string> &arguments, const fs::path &folder) {
  return Process(arguments, folder).wait();
}

} // namespace system_tests
