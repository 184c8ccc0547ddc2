// The checker of command timing meets refreshes of banks: streams by hand that just keep a rule and that are
// a cycle too early, and controllers with one number shortened.
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/timing_checker.h"
#include "tests/hwmodel/memory/memory_traffic.h"

namespace voxmelt::hwmodel::memory {
namespace {

using Kind = Command::Kind;

Command command(std::int64_t cycle, Kind kind, int group, int bank) {
  return {cycle, kind, 0, 0, group, bank, 5, 0};
}
std::string verdict(const Parameters& p, const std::vector<Command>& stream) {
  TimingChecker checker(p);
  for (const Command& command : stream) checker.issued(command);
  std::string rules;
  for (const auto& [rule, count] : checker.by_rule()) rules += (rules.empty() ? "" : ", ") + rule;
  return rules;
}

// The last command may come in its cycle, and not a cycle before.
void expect_edge(const char* rule, const Parameters& p, std::vector<Command> stream) {
  EXPECT_EQ(verdict(p, stream), "") << rule;
  --stream.back().cycle;
  EXPECT_EQ(verdict(p, stream), rule);
}

// All cycles are worked by hand from the sheet of LPDDR4-3200, whose eight banks are in one group. A longer
// tRC and a longer tFAW show by themselves.
TEST(BankRefresh, EveryRuleToTheCycle) {
  const auto act = [](std::int64_t cycle, int bank) { return command(cycle, Kind::activate, 0, bank); };
  const auto pre = [](std::int64_t cycle, int bank) { return command(cycle, Kind::precharge, 0, bank); };
  const auto ref = [](std::int64_t cycle, int bank) { return command(cycle, Kind::refresh_bank, 0, bank); };
  const Parameters p = by_bank("lpddr4-3200");
  Parameters longer = p;
  longer.rc = 120;
  longer.faw = 80;
  expect_edge("tRFC of a bank", p, {ref(100, 0), act(100 + 144, 0)});
  expect_edge("REFB to ACT", p, {ref(100, 0), act(100 + 16, 1)});
  expect_edge("REFB to REFB", p, {ref(100, 0), ref(100 + 144, 1)});
  expect_edge("tRP before REFB", p, {act(100, 0), pre(200, 0), ref(200 + 29, 0)});
  expect_edge("tRP before REFB", p, {act(100, 0), command(200, Kind::precharge_all, 0, 0), ref(200 + 34, 0)});
  expect_edge("tRC before REFB", longer, {act(100, 0), pre(168, 0), ref(100 + 120, 0)});
  expect_edge("tRRD before REFB", p, {act(100, 1), ref(100 + 16, 0)});
  expect_edge("tFAW", longer, {act(100, 1), act(116, 2), act(132, 3), act(148, 4), ref(100 + 80, 0)});
  expect_edge("tFAW", longer, {ref(100, 0), act(116, 1), act(132, 2), act(148, 3), act(100 + 80, 4)});
  EXPECT_EQ(verdict(p, {act(100, 0), ref(900, 0)}), "REFB of an open bank");
  EXPECT_EQ(verdict(p, {ref(100, 0), ref(900, 1), ref(1700, 0)}), "REFB: its turn");
  EXPECT_EQ(verdict(sheet("lpddr4-3200"), {ref(100, 0)}), "REFB of a sheet without it");
}

TEST(BankRefresh, ItIsOfOneBankInSeveralGroups) {
  const auto act = [](std::int64_t cycle, int group, int bank) {
    return command(cycle, Kind::activate, group, bank);
  };
  // DDR5: bank 1 of all groups.
  const Command all = command(100, Kind::refresh_bank, 0, 1);
  expect_edge("tRFC of a bank", by_bank("ddr5-4800"), {all, act(100 + 312, 5, 1)});
  expect_edge("REFB to ACT", by_bank("ddr5-4800"), {all, act(100 + 72, 5, 2)});
  // LPDDR5: bank 2 of groups 1 and 3.
  const Command two = command(100, Kind::refresh_bank, 1, 2);
  expect_edge("tRFC of a bank", by_bank("lpddr5-6400"), {two, act(100 + 96, 3, 2)});
  expect_edge("REFB to ACT", by_bank("lpddr5-6400"), {two, act(100 + 6, 2, 2)});
}

// Eight rounds may be late.
TEST(BankRefresh, RefreshesThatNeverComeAreMissed) {
  Parameters p = by_bank("lpddr4-3200");
  p.channels = 1;
  TimingChecker checker(p);
  checker.finish(8 * 8 * 780 + 779);
  EXPECT_EQ(checker.violations(), 0);
  checker.finish(65 * 780);
  EXPECT_EQ(checker.by_rule().count("tREFI: how many"), 1u);
}

TEST(BankRefresh, PlantedErrorsOfAControllerAreFound) {
  struct Planted {
    const char* rule;
    std::function<void(Parameters&)> plant;
  };
  const std::vector<Planted> planted{{"tRFC of a bank", [](Parameters& p) { --p.rfc_bank; }},
                                     {"REFB to ACT", [](Parameters& p) { --p.ref_to_act; }},
                                     {"tRP before REFB", [](Parameters& p) { --p.rp; }},
                                     {"REFB: its turn", [](Parameters& p) { p.groups_at_once *= 2; }},
                                     {"tREFI: how many", [](Parameters& p) { p.refi_bank *= 2; }}};
  const auto found = [](const Parameters& right, const Parameters& believed) {
    Dram dram(believed, 400);
    TimingChecker checker(right);
    dram.listen(&checker);
    Traffic(dram, 4, 11).run(60000);
    return checker.by_rule();
  };
  Parameters right = by_bank("hbm2");
  right.refi_bank /= 2;  // more of them in less time
  EXPECT_TRUE(found(right, right).empty());
  for (const Planted& one : planted) {
    Parameters believed = right;
    one.plant(believed);
    EXPECT_TRUE(found(right, believed).contains(one.rule)) << one.rule;
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
