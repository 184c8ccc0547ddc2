// The audit of sleep finds nothing in the kernels. It finds a stepper that lets a tile sleep too long, one
// whose books differ, and one that lets a tile sleep beside a cell that was changed.
#include "kernel/run/sleep_audit.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::run {
namespace {

using worlds::Grid;
using worlds::Parameters;
using worlds::Volume;

constexpr Grid kWide{190, 6, 12};

Parameters plain(rule::Law law) {
  Parameters p;
  p.flow.law = law;
  p.flow.viscous.mobility = 819200000;
  return p;
}

// Heaps stand at the borders of tiles, on the side towards high x, so that they flow west over them.
Volume heaps_at_borders(rule::Law law) {
  Volume v(kWide);
  const int energy = law == rule::Law::paper ? 4096 : 0;
  for (const int x : {64, 128})
    worlds::for_each({x, 0, 1, x + 3, 4, 4},
                     [&](int cx, int cy, int cz) { worlds::put(v, cx, cy, cz, 4096, energy); });
  return v;
}

// Does what the widest kernels do. If it may sleep, it does something wrong on top.
class Wrong : public step::HostStepper {
 public:
  Wrong(const Parameters& parameters, Grid grid, const step::Tuning& tuning)
      : inner_(implementations().widest().create(parameters, grid, tuning)), sleeps_(tuning.sleep) {}
  void change_sources(const Parameters& parameters) override { inner_->change_sources(parameters); }
  void run(step::Phase phase, step::Moment moment, const step::Irradiance* irradiance, Volume& volume,
           state::Ledger& ledger) override {
    const Volume before = volume;
    inner().run(phase, moment, irradiance, volume, ledger);
    if (sleeps_) spoil(phase, moment, before, volume, ledger);
  }
  step::AwakeTiles awake() const override {
    step::AwakeTiles tiles = inner().awake();
    if (sleeps_) forget(tiles);
    return tiles;
  }

 protected:
  virtual void spoil(step::Phase, step::Moment, const Volume&, Volume&, state::Ledger&) {}
  virtual void forget(step::AwakeTiles&) const {}

 private:
  step::HostStepper& inner() const { return dynamic_cast<step::HostStepper&>(*inner_); }
  std::unique_ptr<step::Stepper> inner_;
  bool sleeps_;
};

template <class Stepper>
step::Implementation as_implementation() {
  return {"wrong", "for this test",
          [](const Parameters& parameters, Grid grid,
             const step::Tuning& tuning) -> std::unique_ptr<step::Stepper> {
            return std::make_unique<Stepper>(parameters, grid, tuning);
          },
          true};
}

// Steps until there is a fault, or for so many steps.
std::optional<SleepFault> audit(const Parameters& parameters, const Volume& start,
                                const step::Implementation& implementation, int steps,
                                std::int64_t* asleep = nullptr) {
  SleepAudit audit(parameters, start, 100, implementation, {.tile_shift = 1});
  std::optional<SleepFault> fault;
  for (int i = 0; i < steps && !fault; ++i) fault = audit.step();
  if (asleep != nullptr) *asleep = audit.asleep();
  return fault;
}

TEST(SleepAudit, FindsNothingInTheKernels) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    std::int64_t asleep = 0;
    const auto fault = audit(plain(law), heaps_at_borders(law), implementations().widest(), 60, &asleep);
    EXPECT_FALSE(fault) << fault->text();
    EXPECT_GT(asleep, 500);
  }
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    worlds::Random random(seed + 17);
    const rule::Law law = seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous;
    const Grid grid{random.any({70, 130}), random.between(3, 9), random.between(3, 9)};
    const Parameters p = worlds::hostile_parameters(random, law, grid);
    const auto fault = audit(p, worlds::hostile_volume(random, p, grid), implementations().widest(), 8);
    EXPECT_FALSE(fault) << "seed " << seed << ": " << fault->text();
  }
}

// Step 103 is the fourth. West of 64 nothing is wrong.
class ForgetsToFlow final : public Wrong {
  using Wrong::Wrong;
  void spoil(step::Phase phase, step::Moment moment, const Volume& before, Volume& volume,
             state::Ledger&) override {
    if (phase != step::Phase::spread || moment.step != 103) return;
    worlds::for_each({64, 0, 0, kWide.x, kWide.y, kWide.z}, [&](int x, int y, int z) {
      const state::Slot slot = volume.at(x, y, z);
      volume.amount[slot] = before.amount[slot];
      volume.energy[slot] = before.energy[slot];
      volume.liquid.set(x, y, z, before.liquid.test(x, y, z));
    });
  }
};
TEST(SleepAudit, NamesStepPhaseAndCell) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    const auto fault = audit(plain(law), heaps_at_borders(law), as_implementation<ForgetsToFlow>(), 10);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->kind, SleepFault::Kind::cell);
    EXPECT_EQ(fault->step, 103u);
    EXPECT_EQ(fault->phase, step::Phase::spread);
    EXPECT_GE(fault->x, 64);
    EXPECT_NE(fault->expected, fault->actual);
  }
}

class BooksTooMuch final : public Wrong {
  using Wrong::Wrong;
  void spoil(step::Phase phase, step::Moment moment, const Volume&, Volume&, state::Ledger& ledger) override {
    if (phase == step::Phase::gravity && moment.step == 102) ledger.energy.accelerated += 7;
  }
};
TEST(SleepAudit, NamesTheTermOfTheBooks) {
  const auto fault = audit(plain(rule::Law::paper), heaps_at_borders(rule::Law::paper),
                           as_implementation<BooksTooMuch>(), 10);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->kind, SleepFault::Kind::books);
  EXPECT_EQ(fault->step, 102u);
  EXPECT_EQ(fault->phase, step::Phase::gravity);
  EXPECT_EQ(fault->field, "energy: accelerated");
  EXPECT_EQ(fault->actual - fault->expected, 7);
}

// The tiles of x = 0 to 63 are not told to be awake. The heap at 64 flows there, and beside them before.
class ForgetsTheWest final : public Wrong {
  using Wrong::Wrong;
  void forget(step::AwakeTiles& tiles) const override {
    for (std::uint64_t& row : tiles.tiles) row &= ~std::uint64_t{1};
  }
};
TEST(SleepAudit, NamesACellThatSleepsBesideAChange) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    const auto fault = audit(plain(law), heaps_at_borders(law), as_implementation<ForgetsTheWest>(), 10);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->kind, SleepFault::Kind::beside);
    EXPECT_LT(fault->x, 64) << fault->text();
    EXPECT_LE(fault->step, 102u) << "as soon as the heap moves";
  }
}

// By hand: a cell changed at the corner of a tile wants all tiles around it.
TEST(SleepAudit, ACornerWantsAllTilesAroundIt) {
  const Grid grid{128, 4, 4};
  Volume before(grid), after(grid);
  worlds::put(after, 64, 2, 1, 100);
  const step::AwakeTiles all{2, 1, std::vector<std::uint64_t>(2 * 4, 3)};
  EXPECT_FALSE(sleeps_beside_change(before, after, all));
  for (const int z : {0, 1, 2})
    for (const int row : {0, 1})
      for (const int word : {0, 1}) {
        step::AwakeTiles one = all;
        one.tiles[static_cast<std::size_t>(2 * z + row)] &= ~(std::uint64_t{1} << word);
        const auto found = sleeps_beside_change(before, after, one);
        ASSERT_TRUE(found);
        EXPECT_EQ(found->x / 64, word);
        EXPECT_EQ(found->y / 2, row);
        EXPECT_EQ(found->z, z);
        EXPECT_EQ(found->changed_x, 64);
      }
  step::AwakeTiles far = all;
  far.tiles[6] = far.tiles[7] = 0;
  EXPECT_FALSE(sleeps_beside_change(before, after, far)) << "z = 3 is no neighbour of z = 1";
}

}  // namespace
}  // namespace voxmelt::run
