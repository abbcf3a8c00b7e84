// Damaged mesh files through the whole program: the mesh library reads them in a process of its own, whose crash or
// hang must become a finding that names the file.

#include "system/program_here.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <string>

namespace {

using namespace system_tests;

using Random = std::mt19937_64;

std::size_t below(Random &random, std::size_t n) { return n == 0 ? 0 : random() % n; }

/// One random change: a byte, a bit, a digit, a number in the place of digits, a stretch removed or doubled, the rest
/// cut off.
std::string mutated(std::string bytes, Random &random) {
  constexpr std::array<std::string_view, 12> numbers{
      "0", "-1", "1", "1e308", "nan", "2147483647", "99", "1e-12", "4294967296", "-0.5", "7", "18446744073709551615"};
  const std::size_t at = below(random, bytes.size());
  const std::size_t length = below(random, std::min<std::size_t>(bytes.size() - at, 40));
  switch (below(random, 8)) {
  case 0:
    bytes[at] = static_cast<char>(random() & 0xFFU);
    break;
  case 1:
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(random, 8)));
    break;
  case 2: {
    const std::size_t begin = bytes.find_first_of("0123456789", at);
    if (begin != std::string::npos) {
      const std::size_t end = std::min(bytes.find_first_not_of("0123456789.", begin), bytes.size());
      bytes.replace(begin, end - begin, numbers[below(random, numbers.size())]);
    }
    break;
  }
  case 3:
    bytes.erase(at, length);
    break;
  case 4:
    bytes.insert(below(random, bytes.size()), bytes.substr(at, length));
    break;
  case 5:
    bytes.resize(at);
    break;
  default: { // another digit: the likeliest to give a mesh again
    const std::size_t digit = bytes.find_first_of("0123456789", at);
    if (digit != std::string::npos)
      bytes[digit] = static_cast<char>('0' + below(random, 10));
  }
  }
  return bytes;
}

struct Mesh {
  std::string name;
  std::string scene;
};

std::string scene_of(const std::string &mesh, const std::string &boundaries) {
  return "schema = 1\n[geometry]\nfile = \"" + mesh +
         "\"\n[material]\nE = \"1 GPa\"\nnu = 0.3\nmodel = \"plane stress\"\n" + boundaries +
         "[[method]]\nname = \"fem\"\nelement = \"Q2\"\n[study]\nlevels = [\"mesh\"]\n";
}

const std::string clamped = "[[boundary]]\ngroup = \"left\"\nu1 = 0\nu2 = 0\n"
                            "[[boundary]]\ngroup = \"right\"\ntraction = [\"1 MPa\", 0]\n";
const std::string symmetric = "[[boundary]]\ngroup = \"x_axis\"\nu2 = 0\n[[boundary]]\ngroup = \"y_axis\"\nu1 = 0\n"
                              "[[boundary]]\ngroup = \"inner\"\npressure = \"30 MPa\"\n";

TEST(MutatedMeshes, EndWithAnAnswerOrAFindingThatNamesTheFile) {
  const std::vector<Mesh> meshes{{"square_22.msh", scene_of("square_22.msh", clamped)},
                                 {"square_22_binary.msh", scene_of("square_22_binary.msh", clamped)},
                                 {"square_41.msh", scene_of("square_41.msh", clamped)},
                                 {"square_41_binary.msh", scene_of("square_41_binary.msh", clamped)},
                                 {"cylinder_41.msh", scene_of("cylinder_41.msh", symmetric)}};
  Random random(20080617);
  constexpr int n_mutants = 11; // of every mesh
  int n_answers = 0;
  int n_findings = 0;
  for (const auto &mesh : meshes) {
    const std::string good = contents(fs::path(PETROV_SOURCE_DIR) / "tests/fuzzing/mesh_structure" / mesh.name);
    for (int i = 0; i <= n_mutants; ++i) {
      std::string bytes = good;
      for (std::size_t n = i == 0 ? 0 : 1 + below(random, 2); n > 0 && !bytes.empty(); --n)
        bytes = mutated(std::move(bytes), random);
      const Folder folder;
      folder.write(mesh.name, bytes);
      folder.write("scene.toml", mesh.scene);
      const auto ended = run_here({"run", "scene.toml", "--output", "out"}, folder.path());
      SCOPED_TRACE(mesh.name + ", mutant " + std::to_string(i) + ": " + ended.err);
      if (i == 0) {
        ASSERT_EQ(ended.exit_code, 0);
      }
      // 4: a domain that the method refuses.
      ASSERT_TRUE((std::set<int>{0, 3, 4}.contains(ended.exit_code))) << ended.exit_code;
      if (ended.exit_code == 3) {
        ++n_findings;
        EXPECT_NE(ended.err.find("error: "), std::string::npos);
        // A group that the file has lost is missed where the scene asks for it.
        EXPECT_TRUE(ended.err.find(mesh.name) != std::string::npos ||
                    ended.err.find("scene.toml") != std::string::npos);
        EXPECT_FALSE(fs::exists(folder / "out"));
      } else {
        ++n_answers;
        EXPECT_TRUE(fs::exists(folder / "out/results.json"));
      }
    }
  }
  // Both outcomes are met often enough to mean something.
  EXPECT_GT(n_answers, 12);
  EXPECT_GT(n_findings, 20);
}

} // namespace
