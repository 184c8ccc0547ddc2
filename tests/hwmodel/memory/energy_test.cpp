// The energy of a DRAM is worked by hand from commands that were worked by hand from the sheet
// (memory_test.cpp).
#include "hwmodel/memory/energy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/memory/dram.h"
#include "tests/hwmodel/memory/memory_traffic.h"

namespace voxmelt::hwmodel::memory {
namespace {

constexpr std::int64_t kNextGroup = 64, kNextColumn = 4 * 64, kNextRow = 64LL * 4 * 128 * 4;

struct Asked {
  std::int64_t address;
  bool write;
  int then;  // cycles of the machine, of which each is six of the memory
};
Counts counts_of(const Parameters& p, std::initializer_list<Asked> all) {
  Dram dram(p, p.mhz / 6);
  const int port = dram.open_port(nullptr);
  for (const Asked& one : all) {
    dram.put(port, {one.address, 0, one.write});
    for (int i = 0; i < one.then; ++i) dram.cycle();
  }
  return dram.counts();
}

// 1.2 V on eight parts for 1 / 1200 us: each mA makes 8 pJ a cycle. Commands are ACT 0; ACT 4; RD 17; RD 21;
// RD 25; PRE 43; ACT 60; RD 77. A row is open in all of the 234 cycles.
TEST(DramEnergy, ReadsWorkedByHand) {
  const Parameters p = sheet("ddr4-2400");
  const Counts counts = counts_of(
      p, {{0, false, 0}, {kNextGroup, false, 0}, {kNextColumn, false, 0}, {4 * kNextRow, false, 39}});
  const Energy energy = energy_of(counts, p);
  EXPECT_EQ(counts.active, 234);
  EXPECT_NEAR(energy.activate, 3 * 8e-3 * (48 * 56 - 43 * 39 - 34 * 17), 1e-9);  // 10.392 nJ
  EXPECT_NEAR(energy.read, 4 * 8e-3 * 4 * (135 - 43), 1e-9);                     // 11.776 nJ
  EXPECT_NEAR(energy.background, 8e-3 * 234 * 43, 1e-9);                         // 80.496 nJ
  EXPECT_EQ(energy.write, 0);
  EXPECT_EQ(energy.refresh, 0);
  EXPECT_NEAR(energy.all(), 102.664, 1e-9);
  EXPECT_NEAR(nanoseconds_of(counts, p), 195, 1e-9);
}

// ACT 0; WR 32, and a read in cycle 57.
TEST(DramEnergy, AWriteTakesItsOwnCurrent) {
  const Parameters p = sheet("ddr4-2400");
  const Energy energy = energy_of(counts_of(p, {{0, true, 9}, {kNextColumn, false, 20}}), p);
  EXPECT_NEAR(energy.write, 8e-3 * 4 * (123 - 43), 1e-9);
  EXPECT_NEAR(energy.read, 8e-3 * 4 * (135 - 43), 1e-9);
}

// ACT 0; PREA 9360; REF 9377 until 9797; ACT 9797; PRE 10200; ACT 10217; PREA 18720; REF 18737 until 19157.
// Three times the banks are closed for 17 cycles, and then for the last 43 of 19200.
TEST(DramEnergy, ARefreshIsActive) {
  const Parameters p = sheet("ddr4-2400");
  const Counts counts = counts_of(p, {{0, false, 1560}, {0, false, 140}, {16 * kNextRow, false, 1500}});
  EXPECT_EQ(counts.refreshes, 2);
  EXPECT_EQ(counts.active, 19200 - 3 * 17 - 43);
  const Energy energy = energy_of(counts, p);
  EXPECT_NEAR(energy.refresh, 2 * 8e-3 * 420 * (250 - 43), 1e-9);
  EXPECT_NEAR(energy.background, 8e-3 * (19106 * 43 + 94 * 34), 1e-9);
}

// A refresh that still runs counts as far as it is. The two ranks of an idle memory stand by at the same
// time.
TEST(DramEnergy, EachRankStandsBy) {
  const Parameters p = two_ranks();
  Dram dram(p, 200);
  for (int i = 0; i < 800; ++i) dram.cycle();  // a rank began its refresh in cycle 4680, of 4800
  EXPECT_EQ(dram.counts().active, 120);
  EXPECT_NEAR(energy_of(dram.counts(), p).background, 8e-3 * (120 * 43 + (2 * 4800 - 120) * 34), 1e-9);
}

// A read of LPDDR4 is two bursts of eight cycles, on two supplies: 1.125 and 0.6875 pJ for each mA in a
// cycle.
TEST(DramEnergy, SuppliesAddUp) {
  const Parameters p = sheet("lpddr4-3200");
  const Energy energy = energy_of(counts_of(p, {{0, false, 60}}), p);
  EXPECT_NEAR(energy.activate, 1e-3 * (1.125 * 128.5 + 0.6875 * 1542), 1e-9);
  EXPECT_NEAR(energy.read, 1e-3 * 0.6875 * 2 * 8 * 245, 1e-9);
}

// A column more at the peak takes IDD4R in place of standby: the public sets have 1.5 to 7.6 pJ a bit.
TEST(DramEnergy, EverySheetIsOfItsKind) {
  for (const Parameters& p : all_sheets()) {
    Counts counts;
    counts.reads = 1;
    const double per_bit = 1000 * energy_of(counts, p).read / (8 * kBurst);
    if (p.rails.empty())
      EXPECT_TRUE(p.name == "hbm3" || p.name == "lpddr5-6400") << p.name;
    else
      EXPECT_TRUE(per_bit > 1 && per_bit < 10) << p.name << ": " << per_bit;
  }
}

TEST(DramEnergy, TheReportSaysItOrSaysThatItIsUnknown) {
  const Parameters p = sheet("ddr4-2400");
  const Counts counts = counts_of(
      p, {{0, false, 0}, {kNextGroup, false, 0}, {kNextColumn, false, 0}, {4 * kNextRow, false, 39}});
  EXPECT_NE(
      memory_text(counts, p).find("energy: 0.10 uJ, 0.526 W; of it, in %: activate 10.1, read 11.5, write "
                                  "0.0, refresh 0.0, background 78.4"),
      std::string::npos)
      << memory_text(counts, p);
  EXPECT_NEAR(memory_json(counts, p)["nanojoules"]["all"].get<double>(), 102.664, 1e-9);
  EXPECT_NEAR(memory_json(counts, p)["watts"].get<double>(), 102.664 / 195, 1e-9);
  Parameters bare = p;
  bare.rails.clear();
  EXPECT_NE(memory_text(counts, bare).find("energy: unknown"), std::string::npos);
  EXPECT_TRUE(memory_json(counts, bare)["nanojoules"].is_null());
  EXPECT_TRUE(memory_json(counts, bare)["watts"].is_null());
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
