// What is not called for costs nothing: bytes and calls of each effect, counted, and bits of runs with and without it.

#include "meshless/dynamics/elastic_bar.h"
#include "meshless/effects/usage.h"
#include "meshless/hydrodynamics/gas_flow.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

namespace {

/// Bytes asked of operator new in this program since the start.
std::size_t bytes_allocated = 0;

} // namespace

// NOLINTBEGIN: the program's own allocation functions; not inlined, or the compiler takes malloc and delete for a pair
[[gnu::noinline]] void *operator new(std::size_t size) {
  bytes_allocated += size;
  if (void *memory = std::malloc(size))
    return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void *operator new(std::size_t size, const std::nothrow_t &) noexcept { // else a sanitizer's own
  bytes_allocated += size;
  return std::malloc(size);
}
[[gnu::noinline]] void *operator new(std::size_t size, std::align_val_t alignment) {
  bytes_allocated += size;
  const auto a = static_cast<std::size_t>(alignment);
  if (void *memory = std::aligned_alloc(a, (size + a - 1) / a * a))
    return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void *memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void *memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void *memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
// NOLINTEND

namespace {

using namespace meshless;
using namespace meshless::hydrodynamics;

constexpr std::size_t n = 400;

GasParticles particles() {
  GasParticles p;
  for (std::size_t i = 0; i < n; ++i) {
    p.position.push_back((static_cast<double>(i) + 0.5) / n);
    p.mass.push_back(1.0 / n);
    p.velocity.push_back(0);
    p.density.push_back(1);
    p.energy.push_back(i < n / 2 ? 2.5 : 1);
  }
  return p;
}

GasOptions plain() {
  GasOptions o{.kernel = kernels::make_kernel("cubic_spline", {}), .equation_of_state = IdealGas{1.4}};
  o.adaptive = false;
  o.fixed_length = 1.5 / n;
  return o;
}

const effects::Usage *find(const std::vector<effects::Usage> &usage, const std::string &effect) {
  for (const auto &entry : usage)
    if (entry.effect == effect)
      return &entry;
  return nullptr;
}

/// Bytes that a run of 20 steps takes from start to end.
template <typename Attach>
std::size_t bytes_of_run(const GasOptions &options, Attach attach) {
  const GasParticles start = particles();
  const std::size_t before = bytes_allocated;
  {
    GasFlow gas(start, options);
    [[maybe_unused]] const auto attached = attach();
    for (int s = 0; s < 20; ++s)
      gas.step(0.1 * gas.stable_step());
  }
  return bytes_allocated - before;
}

std::size_t bytes_of_run(const GasOptions &options) {
  return bytes_of_run(options, [] { return 0; });
}

TEST(Effects, AnAbsentEffectHasNoBytesAndNoCalls) {
  GasFlow gas(particles(), plain());
  gas.step(0.1 * gas.stable_step());
  const auto usage = gas.usage();
  EXPECT_NE(find(usage, "gas_pressure"), nullptr);
  EXPECT_GT(find(usage, "gas_pressure")->calls, 0);
  for (const auto *effect : {"artificial_viscosity", "heat_conduction", "programmed_burn"})
    EXPECT_EQ(find(usage, effect), nullptr) << effect;
}

// The difference between runs with and without an effect is what the effect says it takes: without it, nothing of it is
// there.
TEST(Effects, BytesOfAnEffectAreAllThatComesWithIt) {
  const std::size_t without = bytes_of_run(plain());
  EXPECT_EQ(without, bytes_of_run(plain())) << "the count repeats";
  const auto added_by = [&](const char *name, auto change) {
    GasOptions options = plain();
    change(options);
    GasFlow gas(particles(), options);
    gas.step(0.1 * gas.stable_step());
    const auto all = gas.usage();
    const auto *usage = find(all, name);
    ASSERT_NE(usage, nullptr) << name;
    EXPECT_GT(usage->bytes, n * sizeof(double)) << name;
    EXPECT_GT(usage->calls, 0) << name;
    const std::size_t with = bytes_of_run(options);
    // The options are copied with the gas: the difference is of arrays alone, but for pair arrays that grow once.
    EXPECT_GE(with - without, usage->bytes) << name;
    EXPECT_LE(with - without, 2 * usage->bytes) << name;
  };
  added_by("artificial_viscosity", [](GasOptions &o) { o.viscosity = effects::MonaghanViscosity{}; });
  added_by("heat_conduction", [](GasOptions &o) { o.conduction = effects::HeatConduction{}; });
}

// The counter is shown to fail: something that allocates beside the effects that are called for is seen.
TEST(Effects, TheCounterSeesADummyEffectThatAllocates) {
  const std::size_t without = bytes_of_run(plain());
  const std::size_t with = bytes_of_run(plain(), [] { return std::make_unique<std::vector<double>>(n); });
  EXPECT_GE(with, without + n * sizeof(double));
}

TEST(Effects, NoStepAllocates) {
  GasOptions options = plain();
  options.viscosity = effects::MonaghanViscosity{};
  options.conduction = effects::HeatConduction{};
  GasFlow gas(particles(), options);
  const std::size_t before = bytes_allocated;
  for (int s = 0; s < 20; ++s)
    gas.step(0.1 * gas.stable_step());
  EXPECT_EQ(bytes_allocated, before);
}

// An effect that does nothing in a scene leaves its bits as they are: no particle approaches in an expansion.
TEST(Effects, BitsAreThoseOfTheRunBeforeTheEffectExisted) {
  GasParticles start = particles();
  for (std::size_t i = 0; i < n; ++i) {
    start.velocity[i] = 4 * start.position[i];
    start.energy[i] = 1;
  }
  GasOptions with = plain();
  with.viscosity = effects::MonaghanViscosity{};
  with.conduction = effects::HeatConduction{};
  GasFlow a(start, plain());
  GasFlow b(start, with);
  for (int s = 0; s < 10; ++s) {
    const double dt = 0.3 * b.stable_step();
    a.step(dt);
    b.step(dt);
  }
  // At the free ends particles approach; in 11 evaluations that is felt 11 times 3 particles further in, or twice that.
  for (std::size_t i = 70; i + 70 < n; ++i) {
    ASSERT_EQ(a.position()[i], b.position()[i]) << i;
    ASSERT_EQ(a.energy()[i], b.energy()[i]) << i;
  }
}

TEST(Effects, ABarNamesWhatItDoes) {
  dynamics::BarOptions options;
  for (int i = 0; i < 50; ++i)
    options.positions.push_back(i);
  options.operators = [](std::span<const double> x) {
    const auto size = static_cast<std::int64_t>(x.size());
    dynamics::LineOperators rows{linear_algebra::SparseRows(size), linear_algebra::SparseRows(size)};
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t l = std::max<std::int64_t>(i - 1, 0);
      const std::int64_t r = std::min<std::int64_t>(i + 1, size - 1);
      const double width = static_cast<double>(r - l);
      rows.first.append_row(std::vector<std::int64_t>{l, r}, std::vector<double>{-1 / width, 1 / width});
      if (r - l == 2)
        rows.second.append_row(std::vector<std::int64_t>{l, i, r}, std::vector<double>{1, -2, 1});
      else
        rows.second.append_row(std::vector<std::int64_t>{}, std::vector<double>{});
    }
    return rows;
  };
  dynamics::ElasticBar bare(options);
  bare.step(0.1);
  EXPECT_EQ(find(bare.usage(), "artificial_viscosity"), nullptr);
  EXPECT_EQ(find(bare.usage(), "damping"), nullptr);
  options.viscosity = effects::LinearViscosity{};
  dynamics::ElasticBar viscous(options);
  viscous.step(0.1);
  EXPECT_EQ(find(viscous.usage(), "artificial_viscosity")->calls, 1);
  EXPECT_GE(viscous.bytes() - bare.bytes(), 50 * sizeof(double));
}

} // namespace
