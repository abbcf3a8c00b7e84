// Runs in time as a user meets them: killed and resumed, refused, and what they say of effects.

#include "sanitized.h"
#include "system/program_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <thread>

namespace {

using namespace system_tests;
namespace fs = std::filesystem;

std::string bytes_of(const fs::path &file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The only file of a folder whose name ends so; empty if there is none.
fs::path file_in(const fs::path &folder, const std::string &end) {
  if (fs::exists(folder))
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().string().ends_with(end))
        return entry.path();
  return {};
}

const std::string slab = "schema = 1\nbenchmark = \"detonation\"\n[[method]]\nname = \"sph\"\n[time]\nend = \"10 us\"\n"
                         "snapshots = 2\ncheckpoint_every = 50\n[study]\nlevels = [1000]\n";

/// Kills ten runs, fewer under sanitizers, of a scene at random moments after their first checkpoint, resumes them, and
/// compares the bytes of the file whose name ends so with those of a run that nobody has killed.
void expect_the_same_bits(const std::string &scene, const std::string &result, unsigned seed) {
  const int times = sanitized::repetitions(10);
  const Folder folder;
  folder.write("scene.toml", scene);
  ASSERT_EQ(run_program({"run", "scene.toml", "--output", "whole", "--quiet"}, folder.path()).exit_code, 0);
  const auto file = file_in(folder / "whole/series", result);
  ASSERT_FALSE(file.empty());
  const std::string whole = bytes_of(file);
  std::mt19937 random(seed);
  int n_resumed = 0;
  for (int i = 0; i < times; ++i) {
    SCOPED_TRACE(i);
    const std::string out = "out" + std::to_string(i);
    Process process({"run", "scene.toml", "--output", out}, folder.path());
    for (int wait = 0; wait < 8000 && file_in(folder / out / "checkpoints", ".cbor").empty(); ++wait)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
    process.send(SIGKILL);
    process.wait();
    const bool finished = fs::exists(folder / out / "results.json");
    ASSERT_FALSE(file_in(folder / out / "checkpoints", ".cbor").empty());
    n_resumed += !finished;
    const auto again =
        run_program({"run", "scene.toml", "--output", out, "--quiet", "--set", "time.resume=true"}, folder.path());
    ASSERT_EQ(again.exit_code, 0) << again.err << again.out;
    EXPECT_TRUE(bytes_of(file_in(folder / out / "series", result)) == whole);
  }
  EXPECT_GT(n_resumed, times / 2) << "too few runs were cut short";
}

TEST(Transient, KilledAnywhereAndResumedItEndsWithTheSameBits) { expect_the_same_bits(slab, "profile-2.csv", 5); }

std::string plate(const std::string &method, const std::string &time) {
  return "schema = 1\nbenchmark = \"plate_vibration\"\n[problem]\nsupports = \"left\"\nlength = \"1 m\"\nwidth = \"0.2 "
         "m\"\n"
         "[[method]]\n" +
         method + "[time]\n" + time +
         "checkpoint_every = 20\n[study]\nanalysis = \"transient\"\nlevels = [\"21x5\"]\nrepeats = 1\n";
}

// Curve of deflection and energies of every step, and so of what was computed before the run was killed.
TEST(Transient, AKilledPlateOfElementsEndsWithTheSameBits) {
  expect_the_same_bits(plate("name = \"fem\"\nelement = \"Q2\"\n", "end = \"8 ms\"\ncfl = 0.5\n"), "tip.csv", 6);
}

TEST(Transient, AKilledPlateOfParticlesEndsWithTheSameBits) {
  expect_the_same_bits(plate("name = \"weak2\"\n", "end = \"8 ms\"\ncfl = 1.0\n"), "tip.csv", 7);
}

const std::string bar_scene =
    "schema = 1\nbenchmark = \"bar_wave\"\n[effects]\nelasticity = true\ninertia = true\n"
    "artificial_viscosity = true\n[[method]]\nname = \"ssph\"\nkernel_parameter = 1.6\n[time]\n"
    "end = \"500 us\"\ncheckpoint_every = 100\n[study]\nlevels = [1600]\nrepeats = 1\n";

TEST(Transient, AKilledBarEndsWithTheSameBits) { expect_the_same_bits(bar_scene, "stress-1.csv", 8); }

TEST(Transient, ACheckpointThatDoesNotFitIsRefusedByName) {
  const Folder folder;
  folder.write("slab.toml", slab);
  const std::vector<std::string> run{"run",           "slab.toml", "--quiet",         "--set",
                                     "time.end=1e-6", "--set",     "time.snapshots=1"};
  auto resume = run;
  resume.insert(resume.end(), {"--set", "time.resume=true"});
  ASSERT_EQ(run_program(run, folder.path()).exit_code, 0);
  const fs::path file = file_in(folder / "out/checkpoints", ".cbor");
  ASSERT_FALSE(file.empty());
  const std::string all = bytes_of(file);
  EXPECT_EQ(run_program(resume, folder.path()).exit_code, 0);
  auto other = resume;
  other.insert(other.end(), {"--set", "effects.programmed_burn.speed=7000"});
  const auto foreign = run_program(other, folder.path());
  EXPECT_EQ(foreign.exit_code, 4);
  EXPECT_NE(foreign.out.find("belongs to another scene"), std::string::npos) << foreign.out;
  std::ofstream(file, std::ios::binary) << all.substr(0, all.size() / 2);
  const auto truncated = run_program(resume, folder.path());
  EXPECT_EQ(truncated.exit_code, 4);
  EXPECT_NE(truncated.out.find("truncated"), std::string::npos) << truncated.out;
}

TEST(Transient, ADetonationBelowTheChapmanJouguetSpeedIsRefusedWithTheSpeed) {
  const Folder folder;
  folder.write("slab.toml", slab);
  const auto ended = run_program({"check", "slab.toml", "--set", "effects.programmed_burn.speed=6000"}, folder.path());
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("6000 m/s is below the Chapman-Jouguet speed 6929.35 m/s"), std::string::npos) << ended.err;
}

TEST(Transient, TheReportNamesActiveAndAbsentEffects) {
  const Folder folder;
  folder.write("bar.toml", "schema = 1\nbenchmark = \"bar_wave\"\n[[method]]\nname = \"ssph\"\nkernel_parameter = 1.6\n"
                           "[study]\nlevels = [100]\n");
  const auto ended = run_program({"run", "bar.toml", "--quiet"}, folder.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err, "");
  const auto place = ended.out.find("effects: ");
  ASSERT_NE(place, std::string::npos);
  const std::string line = ended.out.substr(place, ended.out.find("\n\n", place) - place);
  const auto absent = line.find("neither computed nor allocated");
  ASSERT_NE(absent, std::string::npos) << line;
  EXPECT_LT(line.find("elasticity"), absent);
  EXPECT_LT(line.find("inertia"), absent);
  EXPECT_GT(line.find("artificial_viscosity"), absent);
  EXPECT_GT(line.find("programmed_burn"), absent);
}

TEST(Transient, AnEffectThatNoMethodHasIsRefusedByName) {
  const Folder folder;
  folder.write("bar.toml", "schema = 1\nbenchmark = \"bar_wave\"\n[effects]\nelasticity = true\ninertia = true\n"
                           "gas_pressure = true\n[[method]]\nname = \"ssph\"\n[study]\nlevels = [100]\n");
  const auto ended = run_program({"check", "bar.toml"}, folder.path());
  EXPECT_EQ(ended.exit_code, 3);
  EXPECT_NE(ended.err.find("no listed method can do the effect 'gas_pressure'"), std::string::npos) << ended.err;
}

} // namespace
