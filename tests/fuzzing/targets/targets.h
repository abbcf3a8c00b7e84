#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// What reads files of others, each as a function of bytes. libFuzzer (tests/fuzzing/entry.cc) and the replay of the
/// corpus (tests/fuzzing/replay_test.cc) call them. A target returns whatever the bytes are, or throws `Broken`, or
/// what a reader has no right to throw.
namespace fuzzing {

/// A property that a reader promises does not hold.
class Broken : public std::logic_error {
public:
  using std::logic_error::logic_error;
};

inline void require(bool holds, const char *promise) {
  if (!holds)
    throw Broken(promise);
}

void scene(std::string_view bytes);
void cloud_csv(std::string_view bytes);
void cloud_vtk(std::string_view bytes);
void results(std::string_view bytes);
void checkpoint(std::string_view bytes);
void mesh_structure(std::string_view bytes);
void mesh_data(std::string_view bytes);

struct Target {
  /// Also the folder of its corpus.
  const char *name;
  void (*run)(std::string_view bytes);
};

std::span<const Target> targets();

} // namespace fuzzing
