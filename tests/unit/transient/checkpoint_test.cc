// Checkpoints: every bit comes back, and what does not fit is refused by name.

#include "comparisons/study/checkpoint.h"
#include "comparisons/study/transient.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <unistd.h>

namespace {

using namespace comparisons::study;
namespace fs = std::filesystem;

class Checkpoint : public ::testing::Test {
protected:
  Checkpoint() {
    fs::create_directories(file_.parent_path());
    std::mt19937_64 random(1);
    for (double &x : a_) // any finite bits
      do
        x = std::bit_cast<double>(random());
      while (!std::isfinite(x));
    a_[0] = -0.0;
    a_[1] = 5e-324;
  }
  ~Checkpoint() override { fs::remove_all(file_.parent_path()); }

  std::string refusal(const std::string &identity, const meshless::dynamics::State &state) const {
    try {
      read_checkpoint(file_, identity, state);
    } catch (const CheckpointError &error) {
      return error.what();
    }
    return "accepted";
  }
  std::string contents() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void write(const std::string &text) const { std::ofstream(file_, std::ios::binary) << text; }

  fs::path file_ = fs::temp_directory_path() / ("petrov_checkpoint_" + std::to_string(::getpid())) / "a.cbor";
  std::vector<double> a_ = std::vector<double>(500), b_ = {1, 2};
  meshless::dynamics::State state_{{"a", a_}, {"b", b_}};
};

TEST_F(Checkpoint, EveryBitComesBack) {
  write_checkpoint(file_, "id", state_, {{"peak", 0.1}});
  const auto before = a_;
  std::fill(a_.begin(), a_.end(), 7.0);
  EXPECT_EQ(read_checkpoint(file_, "id", state_), (Measured{{"peak", 0.1}}));
  for (std::size_t i = 0; i < a_.size(); ++i)
    ASSERT_EQ(std::bit_cast<std::uint64_t>(a_[i]), std::bit_cast<std::uint64_t>(before[i])) << i;
}

TEST_F(Checkpoint, TruncatedAtAnyPlaceIsRefusedAndChangesNothing) {
  write_checkpoint(file_, "id", state_, {});
  const std::string all = contents();
  const auto before = a_;
  for (std::size_t length = 0; length < all.size(); length += 97) {
    write(all.substr(0, length));
    EXPECT_NE(refusal("id", state_).find(file_.string() + ": truncated"), std::string::npos) << length;
  }
  EXPECT_EQ(a_, before);
}

TEST_F(Checkpoint, DamagedValuesAreRefused) {
  write_checkpoint(file_, "id", state_, {});
  std::string all = contents();
  std::size_t found = 0;
  for (std::size_t i = 200; i < all.size(); i += 331) {
    std::string damaged = all;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    write(damaged);
    const auto before = a_;
    const std::string text = refusal("id", state_);
    EXPECT_NE(text, "accepted") << i;
    EXPECT_EQ(a_, before);
    ++found;
  }
  EXPECT_GT(found, 5U);
}

TEST_F(Checkpoint, ForeignFilesAreRefusedByName) {
  write_checkpoint(file_, "id", state_, {});
  EXPECT_NE(refusal("other", state_).find("belongs to another scene"), std::string::npos);
  std::vector<double> shorter(499);
  EXPECT_NE(refusal("id", {{"a", shorter}, {"b", b_}}).find("the field 'a' has 500 values, the run needs 499"),
            std::string::npos);
  EXPECT_NE(refusal("id", {{"c", shorter}}).find("a field is missing"), std::string::npos);
  write("schema = 1\n");
  EXPECT_NE(refusal("id", state_).find("no checkpoint of this program"), std::string::npos);
  const auto json = nlohmann::json::to_cbor({{"format", "petrov checkpoint"}, {"schema", 2}});
  write({reinterpret_cast<const char *>(json.data()), json.size()});
  EXPECT_NE(refusal("id", state_).find("schema 2; this version reads schema 1"), std::string::npos);
  const auto no_text = nlohmann::json::to_cbor({{"format", "petrov checkpoint"}, {"schema", "\xff"}});
  write({reinterpret_cast<const char *>(no_text.data()), no_text.size()});
  EXPECT_NE(refusal("id", state_).find("this version reads schema 1"), std::string::npos) << "bytes that are not UTF-8";
  fs::remove(file_);
  EXPECT_NE(refusal("id", state_).find("cannot be read"), std::string::npos);
}

// Found by fuzzing: the library threw, or would have called itself for every one of a million brackets.
TEST_F(Checkpoint, WhatTheLibraryCannotDigestIsRefusedByName) {
  write(std::string(1'000'000, '\x81')); // arrays of one array
  EXPECT_NE(refusal("id", state_).find("nested too deep"), std::string::npos);
  write(std::string("\x9b\x7f") + std::string(7, '\x7f')); // an array of 9e18 values
  EXPECT_NE(refusal("id", state_).find("truncated or no checkpoint"), std::string::npos);
  write_checkpoint(file_, "id", state_, {});
  auto json = nlohmann::json::from_cbor(contents());
  json["measured"] = {1, 2};
  const auto bytes = nlohmann::json::to_cbor(json);
  write({reinterpret_cast<const char *>(bytes.data()), bytes.size()});
  a_[0] = 1; // not what the file holds
  EXPECT_NE(refusal("id", state_).find("what was measured is no list of numbers"), std::string::npos);
  EXPECT_EQ(a_[0], 1);
}

/// x'' = -x by central differences, with a step that the state decides.
class Oscillator final : public Evolution {
public:
  double time() const override { return values_[0]; }
  std::int64_t steps() const override { return static_cast<std::int64_t>(values_[3]); }
  double stable_step() const override { return 1 / (1 + values_[1] * values_[1]); }
  void step(double dt) override {
    values_[2] -= dt * values_[1];
    values_[1] += dt * values_[2];
    values_[0] += dt;
    values_[3] += 1;
  }
  double energy_error() const override { return 0; }
  meshless::dynamics::State state() override { return {{"all", values_}}; }
  void adopt_state() override {}
  std::vector<double> values_{0, 1, 0, 0};
};

TimeSettings settings(bool resume) {
  comparisons::scene::Parameters time;
  const auto add = [&](const char *name, comparisons::scene::Value value) {
    time.add({.declaration = {.name = name, .meaning = ""}, .value = std::move(value), .location = {}});
  };
  add("end", 10.0);
  add("cfl", 0.1);
  add("snapshots", std::int64_t{5});
  add("checkpoint_every", std::int64_t{7});
  add("resume", resume);
  return TimeSettings(time);
}

struct Killed {};

TEST_F(Checkpoint, ARunThatIsCutAnywhereEndsWithTheSameBits) {
  Oscillator whole;
  std::vector<std::int64_t> seen;
  const auto outcome = run_in_time(whole, settings(false),
                                   {.snapshot = [&](std::int64_t index, Measured &) { seen.push_back(index); },
                                    .progress = {},
                                    .checkpoint = {},
                                    .identity = {}});
  EXPECT_EQ(seen, (std::vector<std::int64_t>{1, 2, 3, 4, 5}));
  EXPECT_NEAR(whole.time(), 10, 1e-10);
  EXPECT_LE(outcome.largest_ratio, 0.2);
  for (std::int64_t cut = 1; cut <= 5; ++cut) {
    fs::remove(file_);
    const auto services = [&](bool killed) {
      return TimeServices{.snapshot =
                              [=](std::int64_t index, Measured &measured) {
                                measured["x" + std::to_string(index)] = static_cast<double>(index);
                                if (killed && index == cut)
                                  throw Killed();
                              },
                          .progress = {},
                          .checkpoint = file_,
                          .identity = "id"};
    };
    Oscillator first;
    EXPECT_THROW(run_in_time(first, settings(false), services(true)), Killed);
    Oscillator second;
    const auto resumed = run_in_time(second, settings(true), services(false));
    EXPECT_TRUE(resumed.resumed);
    EXPECT_EQ(second.values_, whole.values_) << cut;
    EXPECT_EQ(resumed.measured.size(), 5U) << "quantities of earlier snapshots are kept";
  }
}

} // namespace
