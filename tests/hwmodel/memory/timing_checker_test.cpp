// The checker of command timing meets two streams by hand for each rule: one just keeps it, and one is a
// cycle too early. It also watches controllers with one number shortened.
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

struct At {
  int rank, group, bank, row;
};
Command command(std::int64_t cycle, Kind kind, const At& at) {
  return {cycle, kind, 0, at.rank, at.group, at.bank, at.row, 0};
}
std::string verdict(const Parameters& p, const std::vector<Command>& stream) {
  TimingChecker checker(p);
  for (const Command& command : stream) checker.issued(command);
  if (checker.violations() == 0) return "";
  std::string rules;
  for (const auto& [rule, count] : checker.by_rule()) rules += (rules.empty() ? "" : ", ") + rule;
  return rules;
}

constexpr At kA{0, 0, 0, 5}, kOtherRow{0, 0, 0, 6}, kSameGroup{0, 0, 1, 5}, kOtherGroup{0, 1, 0, 5},
    kThird{0, 2, 0, 5}, kFourth{0, 3, 0, 5}, kFifth{0, 0, 2, 5}, kOtherRank{1, 0, 0, 5};

// The last command may come in cycle `from`, and not a cycle before. All cycles are worked by hand from the
// sheet of DDR4-2400 (17-17-17).
struct Case {
  const char* rule;
  std::vector<Command> before;
  Kind kind;
  At at;
  std::int64_t from;
};

TEST(TimingChecker, EveryRuleOfTheSheetToTheCycle) {
  const auto act = [](std::int64_t cycle, const At& at) { return command(cycle, Kind::activate, at); };
  const auto read = [](std::int64_t cycle, const At& at) { return command(cycle, Kind::read, at); };
  const auto write = [](std::int64_t cycle, const At& at) { return command(cycle, Kind::write, at); };
  const auto pre = [](std::int64_t cycle, const At& at) { return command(cycle, Kind::precharge, at); };
  const auto ref = [](std::int64_t cycle, const At& at) { return command(cycle, Kind::refresh, at); };
  const std::vector<Case> cases{
      {"tRCD", {act(100, kA)}, Kind::read, kA, 117},
      {"tRCD", {act(100, kA)}, Kind::write, kA, 117},
      {"tRAS", {act(100, kA)}, Kind::precharge, kA, 139},
      {"tRP", {act(100, kA), pre(150, kA)}, Kind::activate, kOtherRow, 167},
      {"tRTP", {act(100, kA), read(140, kA)}, Kind::precharge, kA, 149},
      {"tWR", {act(100, kA), write(140, kA)}, Kind::precharge, kA, 140 + 12 + 4 + 18},
      {"tRRD_S", {act(100, kA)}, Kind::activate, kOtherGroup, 104},
      {"tRRD_L", {act(100, kA)}, Kind::activate, kSameGroup, 106},
      {"tFAW",
       {act(100, kA), act(104, kOtherGroup), act(108, kThird), act(112, kFourth)},
       Kind::activate,
       kFifth,
       126},
      {"tCCD_L", {act(100, kA), act(106, kSameGroup), read(140, kA)}, Kind::read, kSameGroup, 146},
      {"tCCD_L_WR", {act(100, kA), act(106, kSameGroup), write(140, kA)}, Kind::write, kSameGroup, 146},
      {"data bus, tCCD_S",
       {act(100, kA), act(106, kOtherGroup), read(140, kA)},
       Kind::read,
       kOtherGroup,
       144},
      {"tWTR_L", {act(100, kA), write(140, kA)}, Kind::read, kA, 140 + 12 + 4 + 9},
      {"tWTR_S",
       {act(100, kA), act(106, kOtherGroup), write(140, kA)},
       Kind::read,
       kOtherGroup,
       140 + 12 + 4 + 3},
      // Read data lie at 157 .. 160. Written data may follow from 163 on, 12 cycles after their command.
      {"read to write", {act(100, kA), read(140, kA)}, Kind::write, kA, 151},
      {"rank switch", {act(100, kA), act(101, kOtherRank), read(140, kA)}, Kind::read, kOtherRank, 146},
      // Written data lie at 152 .. 155. Read data of the other rank may follow from 158 on.
      {"command bus, rank switch",
       {act(100, kA), act(101, kOtherRank), write(140, kA)},
       Kind::read,
       kOtherRank,
       141},
      {"tRFC", {ref(100, kA)}, Kind::activate, kA, 520},
      {"tRP before REF", {act(100, kA), pre(160, kA)}, Kind::refresh, kA, 177},
      {"tRP before REF", {act(100, kA), command(160, Kind::precharge_all, kA)}, Kind::refresh, kA, 177},
      {"command bus", {act(100, kA)}, Kind::activate, kOtherRank, 101},
      {"tREFI: the gap", {}, Kind::refresh, kA, -9 * 9360},
  };
  for (const Case& one : cases) {
    std::vector<Command> stream = one.before;
    const bool late = one.from < 0;  // the rule holds until then, not from then on
    stream.push_back(command(late ? -one.from : one.from, one.kind, one.at));
    EXPECT_EQ(verdict(two_ranks(), stream), "") << one.rule;
    stream.back().cycle += late ? 1 : -1;
    EXPECT_EQ(verdict(two_ranks(), stream), one.rule);
  }
  // This sheet's tRC is tRAS + tRP. A longer one shows by itself.
  Parameters longer = two_ranks();
  longer.rc = 60;
  EXPECT_EQ(verdict(longer, {act(100, kA), pre(139, kA), act(160, kOtherRow)}), "");
  EXPECT_EQ(verdict(longer, {act(100, kA), pre(139, kA), act(159, kOtherRow)}), "tRC");
}

// LPDDR4 keeps 4 cycles between commands that close banks of a rank (JESD209-4, tPPD). All its banks are in
// one group. Rows that were opened long ago may be closed at once, but for this.
TEST(TimingChecker, BanksCloseWithADistance) {
  constexpr At kFirst{0, 0, 0, 5}, kSecond{0, 0, 1, 5};
  const std::vector<Command> opened{command(100, Kind::activate, kFirst),
                                    command(116, Kind::activate, kSecond),
                                    command(300, Kind::precharge, kFirst)};
  for (const Kind kind : {Kind::precharge, Kind::precharge_all}) {
    std::vector<Command> stream = opened;
    stream.push_back(command(304, kind, kSecond));
    EXPECT_EQ(verdict(sheet("lpddr4-3200"), stream), "");
    stream.back().cycle = 303;
    EXPECT_EQ(verdict(sheet("lpddr4-3200"), stream), "tPPD");
  }
  Parameters ranks = sheet("lpddr4-3200");
  ranks.ranks = 2;
  EXPECT_EQ(
      verdict(ranks, {command(100, Kind::activate, kFirst), command(104, Kind::activate, kOtherRank),
                      command(300, Kind::precharge, kFirst), command(302, Kind::precharge, kOtherRank)}),
      "")
      << "other ranks do not matter";
}

// DDR5 wants 20 ns from write to write in one group (48 cycles at 2400 MHz), but 5 ns from read to read.
TEST(TimingChecker, WritesOfAGroupMayNeedMoreTimeThanReads) {
  const std::vector<Command> opened{command(100, Kind::activate, kA),
                                    command(112, Kind::activate, kSameGroup)};
  const auto after = [&](Kind kind, std::int64_t cycle) {
    std::vector<Command> stream = opened;
    stream.push_back(command(300, kind, kA));
    stream.push_back(command(cycle, kind, kSameGroup));
    return verdict(sheet("ddr5-4800"), stream);
  };
  EXPECT_EQ(after(Kind::write, 348), "");
  EXPECT_EQ(after(Kind::write, 347), "tCCD_L_WR");
  EXPECT_EQ(after(Kind::read, 312), "");
  EXPECT_EQ(after(Kind::read, 311), "tCCD_L");
}

// 16 transfers take two cycles of the clock of LPDDR5's commands, at eight in a cycle.
TEST(TimingChecker, DataMoveAtTheirOwnRate) {
  constexpr At kOther{0, 1, 0, 5};
  const std::vector<Command> opened{command(100, Kind::activate, kA), command(104, Kind::activate, kOther),
                                    command(200, Kind::read, kA)};
  std::vector<Command> stream = opened;
  stream.push_back(command(202, Kind::read, kOther));
  EXPECT_EQ(verdict(sheet("lpddr5-6400"), stream), "");
  stream.back().cycle = 201;
  EXPECT_EQ(verdict(sheet("lpddr5-6400"), stream), "data bus, tCCD_S");
}

TEST(TimingChecker, StatesOfBanks) {
  const Parameters p = two_ranks();
  const Command opens = command(100, Kind::activate, kA);
  EXPECT_EQ(verdict(p, {opens, command(900, Kind::activate, kOtherRow)}), "ACT of an open bank");
  EXPECT_EQ(verdict(p, {opens, command(900, Kind::read, kOtherRow)}), "column of another row");
  EXPECT_EQ(verdict(p, {opens, command(900, Kind::read, kSameGroup)}), "column of a closed bank");
  EXPECT_EQ(verdict(p, {opens, command(900, Kind::refresh, kA)}), "REF with an open bank");
  EXPECT_EQ(verdict(p, {opens, command(900, Kind::precharge_all, kA), command(950, Kind::read, kA)}),
            "column of a closed bank");
  EXPECT_EQ(verdict(p, {command(100, Kind::activate, {0, 0, 0, 65536})}), "row");
  Command beyond = command(900, Kind::read, kA);
  beyond.column = 1020;
  EXPECT_EQ(verdict(p, {opens, beyond}), "column");
}

TEST(TimingChecker, RefreshesThatNeverComeAreMissed) {
  TimingChecker checker(sheet("ddr4-2400"));
  checker.finish(8 * 9360 + 9359);
  EXPECT_EQ(checker.violations(), 0);
  checker.finish(9 * 9360);
  EXPECT_EQ(checker.violations(), 1);
}

// Describes a controller that believes in a number which is shorter than the sheet's.
struct Planted {
  const char* rule;
  std::function<void(Parameters&)> plant;
};

TEST(TimingChecker, FindsEveryPlantedTimingError) {
  Parameters ddr4 = two_ranks(), lpddr4 = sheet("lpddr4-3200"), hbm = sheet("hbm2");
  ddr4.rc = 60;      // otherwise tRC follows from tRAS and tRP
  ddr4.rp_all = 19;  // otherwise it follows from tRP
  const std::vector<Planted> planted{
      {"tRCD", [](Parameters& p) { --p.rcd; }},
      {"tRP", [](Parameters& p) { --p.rp; }},
      {"tRP before REF", [](Parameters& p) { --p.rp_all; }},
      {"tRAS", [](Parameters& p) { --p.ras; }},
      {"tRC", [](Parameters& p) { --p.rc; }},
      {"tCCD_S", [](Parameters& p) { --p.ccd_s; }},
      {"tCCD_L", [](Parameters& p) { --p.ccd_l; }},
      {"tRRD_S", [](Parameters& p) { --p.rrd_s; }},
      {"tRRD_L", [](Parameters& p) { --p.rrd_l; }},
      {"tFAW", [](Parameters& p) { --p.faw; }},
      {"tWR", [](Parameters& p) { --p.wr; }},
      {"tWTR_S", [](Parameters& p) { --p.wtr_s; }},
      {"tWTR_L", [](Parameters& p) { --p.wtr_l; }},
      {"tRTP", [](Parameters& p) { --p.rtp; }},
      {"read to write", [](Parameters& p) { --p.read_to_write; }},
      {"rank switch", [](Parameters& p) { --p.rank_switch; }},
      {"tRFC", [](Parameters& p) { --p.rfc; }},
      {"tREFI: how many", [](Parameters& p) { p.refi += p.refi / 4; }},
  };
  const auto found = [](const Parameters& right, const Parameters& believed) {
    Dram dram(believed, 400);
    TimingChecker checker(right);
    dram.listen(&checker);
    Traffic(dram, 4, 11).run(200000);
    return checker.by_rule();
  };
  EXPECT_TRUE(found(ddr4, ddr4).empty());
  for (const Planted& the_planted : planted) {
    Parameters believed = ddr4;
    the_planted.plant(believed);
    EXPECT_TRUE(found(ddr4, believed).contains(the_planted.rule)) << the_planted.rule;
  }
  for (const Parameters& parameters : {lpddr4, hbm}) {
    EXPECT_TRUE(found(parameters, parameters).empty());
    Parameters believed = parameters;
    --believed.act_slots;
    EXPECT_TRUE(found(parameters, believed).contains("command bus")) << parameters.name;
  }
  Parameters believed = lpddr4;
  --believed.ppd;
  EXPECT_TRUE(found(lpddr4, believed).contains("tPPD"));
  const Parameters ddr5 = sheet("ddr5-4800");
  believed = ddr5;
  --believed.ccd_l_write;
  EXPECT_TRUE(found(ddr5, ddr5).empty());
  EXPECT_TRUE(found(ddr5, believed).contains("tCCD_L_WR"));
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
