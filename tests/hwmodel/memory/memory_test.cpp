// The DRAM is tested by commands and replies worked by hand from the sheet, random traffic, and its
// bandwidth.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/memory/address_map.h"
#include "hwmodel/memory/bus_account.h"
#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/timing_checker.h"
#include "hwmodel/memory/trace.h"
#include "tests/hwmodel/memory/memory_traffic.h"

namespace voxmelt::hwmodel::memory {
namespace {

struct Recorder final : CommandListener {
  void issued(const Command& command) override { all.push_back(command); }
  std::vector<Command> all;
};

std::string words(const std::vector<Command>& commands) {
  std::string text;
  for (const Command& c : commands) {
    constexpr const char* kNames[] = {"ACT", "PRE", "PREA", "RD", "WR", "REF", "REFB"};
    text += std::string(kNames[static_cast<std::size_t>(c.kind)]) + " " + std::to_string(c.cycle) + "; ";
  }
  return text;
}

struct Served final : RequestListener {
  void taken(std::int64_t, const Request& request) override { ++by_id[request.id]; }
  std::array<std::int64_t, 3> by_id{};
};

constexpr std::int64_t kNextGroup = 64, kNextColumn = 4 * 64, kNextRow = 64LL * 4 * 128 * 4;

// The first data end at 4. The write's data come at 20, eight cycles after their command, for which a row was
// opened. The request has waited since 2: of the 16 cycles without data 6 are idle, and the turn is to blame
// for the rest.
TEST(Memory, ATurnIsToBlameBeforeARow) {
  BusAccount account;
  Counts counts;
  account.column(0, 4, 0, false, 0, false, counts);
  account.first_waits(2);
  account.column(20, 4, 8, true, 0, true, counts);
  EXPECT_EQ(counts.busy, 8);
  EXPECT_EQ(counts.idle, 6);
  EXPECT_EQ(counts.turnaround, 10);
  EXPECT_EQ(counts.row, 0);
  EXPECT_EQ(counts.read_to_write, 1);
}

TEST(Memory, WhereABurstLies) {
  const Parameters p = sheet("ddr4-2400");
  // The address counts groups first, then 128 bursts of a row, then banks, then rows. A row's number is added
  // to bank and group.
  const Location a = locate(3 * 64 + 5 * kNextColumn, p);
  EXPECT_EQ(a.group, 3);
  EXPECT_EQ(a.column, 5 * 8);
  EXPECT_EQ(a.bank, 0);
  const Location b = locate(2 * 64LL * 4 * 128 + kNextRow * 9, p);
  EXPECT_EQ(b.row, 9);
  EXPECT_EQ(b.bank, 2 ^ 1);
  EXPECT_EQ(b.group, 2);
  std::vector<Parameters> all = all_sheets();
  all.push_back(two_ranks());
  for (const Parameters& parameters : all) {
    Parameters small = parameters;
    small.rows = 32;
    std::map<std::vector<int>, std::int64_t> seen;
    for (std::int64_t address = 0; address < small.bytes(); address += kBurst) {
      const Location at = locate(address, small);
      EXPECT_LE(at.column + kBurst / (small.width_bits / 8), small.columns);
      seen[{at.channel, at.rank, at.group, at.bank, at.row, at.column}] = address;
    }
    EXPECT_EQ(static_cast<std::int64_t>(seen.size()), small.bytes() / kBurst) << parameters.name;
  }
}

TEST(Memory, ReadsWorkedByHand) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  // The requests go to the first row, another group of it, the first group again, and another row in that
  // bank.
  for (const std::int64_t address : {std::int64_t{0}, kNextGroup, kNextColumn, 4 * kNextRow ^ 0})
    dram.put(port, {address, static_cast<std::uint32_t>(address), false});
  ASSERT_EQ(locate(4 * kNextRow, dram.parameters()).bank, 0);
  ASSERT_EQ(locate(4 * kNextRow, dram.parameters()).group, 1);
  std::vector<std::int64_t> replied;
  for (int cycle = 1; cycle < 40; ++cycle) {
    dram.cycle();
    while (dram.reply(port) != nullptr) {
      replied.push_back(cycle);
      dram.take(port);
    }
  }
  // ACT comes at 0 and, tRRD_S later, at 4. RD follows at 17 after tRCD, and likewise at 21. For the third,
  // tCCD_L after 17 is 23 and tCCD_S after 21 is 25. The row in the second bank closes tRAS after 4. ACT
  // comes at 60 after tRP, and RD at 77.
  EXPECT_EQ(words(recorder.all), "ACT 0; ACT 4; RD 17; RD 21; RD 25; PRE 43; ACT 60; RD 77; ");
  // Replies come 17 + 4 + 24 later, in memory cycles 62, 66, 70, 122. Six of these make a cycle of the port.
  EXPECT_EQ(replied, (std::vector<std::int64_t>{11, 11, 12, 21}));
  const Counts counts = dram.counts();
  EXPECT_EQ(counts.hits, 1);
  EXPECT_EQ(counts.misses, 2);
  EXPECT_EQ(counts.conflicts, 1);
  EXPECT_EQ(counts.worst_read, 122);
  EXPECT_EQ(counts.read_latency, 62 + 66 + 70 + 122);
  // Data lie at 34 .. 45 and 94 .. 97. The first read could not have come before its latency of 17.
  EXPECT_EQ(counts.busy, 16);
  EXPECT_EQ(counts.row, 17 + 48);
  EXPECT_EQ(counts.idle, 17 + (39 * 6 - 98));
  EXPECT_EQ(counts.cycles(), 39 * 6);
}

// Four groups are opened, and a second bank of the first one: five ACT take tFAW.
TEST(Memory, FourRowsAreOpenedInTheirWindow) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  for (int group = 0; group < 4; ++group) dram.put(port, {group * kNextGroup, 0, false});
  dram.put(port, {128 * kNextColumn, 0, false});
  for (int cycle = 1; cycle < 20; ++cycle) dram.cycle();
  EXPECT_EQ(words(recorder.all), "ACT 0; ACT 4; ACT 8; ACT 12; RD 17; RD 21; RD 25; ACT 26; RD 29; RD 43; ");
}

// Requests go to rows A B A of one bank. Its open row is served first, then it closes.
TEST(Memory, AnOpenRowServesItsHitsBeforeItCloses) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  for (const std::int64_t address : {std::int64_t{0}, 16 * kNextRow, kNextColumn})
    dram.put(port, {address, 0, false});
  for (int cycle = 1; cycle < 40; ++cycle) dram.cycle();
  EXPECT_EQ(words(recorder.all), "ACT 0; RD 17; RD 23; PRE 39; ACT 56; RD 73; ");
  EXPECT_EQ(recorder.all.back().row, 16);
}

// The same holds while earlier hits of other groups keep the bus. From 39 on, tRAS would let the row close.
TEST(Memory, ARowWithAWaitingHitStaysOpen) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  std::vector<std::int64_t> addresses{0};
  for (int i = 0; i < 24; ++i) addresses.push_back(i / 3 * kNextColumn + (1 + i % 3) * kNextGroup);
  addresses.push_back(16 * kNextRow);
  addresses.push_back(kNextColumn);
  std::size_t next = 0;
  for (int cycle = 1; cycle < 60; ++cycle) {
    while (next < addresses.size() && dram.ready(port)) dram.put(port, {addresses[next++], 0, false});
    dram.cycle();
  }
  std::vector<Command> of_the_bank;
  for (const Command& c : recorder.all)
    if (c.group == 0) of_the_bank.push_back(c);
  ASSERT_EQ(of_the_bank.size(), 6u);
  using Kind = Command::Kind;
  constexpr std::array kOrder{Kind::activate,  Kind::read,     Kind::read,
                              Kind::precharge, Kind::activate, Kind::read};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(of_the_bank[i].kind, kOrder[i]) << i;
  EXPECT_GT(of_the_bank[2].cycle, 39 + 4);
}

TEST(Memory, PortsTakeTurns) {
  Dram dram(sheet("ddr4-2400"), 400);
  Served served;
  dram.trace(&served);
  for (int port = 0; port < 3; ++port) dram.open_port(nullptr);
  for (int cycle = 0; cycle < 20000; ++cycle) {
    for (int port = 0; port < 3; ++port) {
      while (dram.reply(port) != nullptr) dram.take(port);
      while (dram.ready(port))
        dram.put(port, {std::int64_t{port} << 26, static_cast<std::uint32_t>(port), false});
    }
    dram.cycle();
  }
  for (const std::int64_t value : served.by_id)
    EXPECT_NEAR(static_cast<double>(value), static_cast<double>(served.by_id[0]), 2);
  EXPECT_GT(served.by_id[0], 2000);
}

TEST(Memory, WritesAndTurnaroundWorkedByHand) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  dram.put(port, {0, 1, true});
  for (int i = 0; i < 9; ++i) dram.cycle();
  dram.put(port, {kNextColumn, 2, false});  // memory cycle 54
  for (int i = 0; i < 20; ++i) dram.cycle();
  // A lone write waits 32 cycles for reads. WR is the command at 32, its data end at 48, and RD of its group
  // follows tWTR_L later.
  EXPECT_EQ(words(recorder.all), "ACT 0; WR 32; RD 57; ");
  EXPECT_EQ(dram.counts().write_to_read, 1);
  EXPECT_EQ(dram.counts().worst_write, 32);
  // Written data lie at 44 .. 47. The read came in 54, and its data lie at 74 .. 77, 3 later than they might
  // at once.
  EXPECT_EQ(dram.counts().turnaround, 3);
  ASSERT_NE(dram.reply(port), nullptr);
  EXPECT_EQ(dram.reply(port)->id, 2u);
  EXPECT_FALSE(dram.idle());
  dram.take(port);
  EXPECT_TRUE(dram.idle());
}

// A read waits for an older write to its burst, and the write does not linger then.
TEST(Memory, AReadHurriesTheWriteBeforeIt) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  dram.put(port, {0, 1, true});
  dram.put(port, {0, 2, false});
  for (int i = 0; i < 20; ++i) dram.cycle();
  EXPECT_EQ(words(recorder.all), "ACT 0; WR 17; RD 42; ");
  EXPECT_EQ(dram.counts().held, 1);
}

TEST(Memory, RefreshWorkedByHand) {
  Dram dram(sheet("ddr4-2400"), 200);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  dram.put(port, {0, 1, false});
  for (int i = 0; i < 1560; ++i) dram.cycle();  // 9360 cycles of the memory
  dram.put(port, {0, 2, false});
  for (int i = 0; i < 140; ++i) dram.cycle();
  dram.put(port, {16 * kNextRow, 3, false});  // memory cycle 10200: another row
  for (int i = 0; i < 1500; ++i) dram.cycle();
  // The row is closed at once. REF follows after tRP, and ACT after tRFC. The next refresh counts from when
  // this one was due.
  EXPECT_EQ(words(recorder.all),
            "ACT 0; RD 17; PREA 9360; REF 9377; ACT 9797; RD 9814; PRE 10200; ACT 10217; RD 10234; "
            "PREA 18720; REF 18737; ");
  EXPECT_EQ(dram.counts().refreshes, 2);
  EXPECT_EQ(dram.counts().refresh, 9814 - 9360);  // until RD; its latency counts as idle
  EXPECT_EQ(dram.counts().row, 17 + 34);          // the first ACT, then PRE and ACT of the third read
}

TEST(Memory, AnIdleMemoryIsRefreshedOnTime) {
  Dram dram(two_ranks(), 200);
  Recorder recorder;
  dram.listen(&recorder);
  for (int i = 0; i < 1560 * 3; ++i) dram.cycle();
  // The ranks take turns: half an interval lies between them.
  EXPECT_EQ(words(recorder.all), "REF 4680; REF 9360; REF 14040; REF 18720; REF 23400; ");
}

// The first bank is closed when it is due, and refreshed tRP later. The second one opens meanwhile, as soon
// as tRRD lets it, and the first one tRFCpb after its refresh.
TEST(Memory, OneBankIsRefreshedWhileOthersWork) {
  Parameters p = by_bank("lpddr4-3200");
  p.channels = 1;
  Dram dram(p, p.mhz);
  Recorder recorder;
  dram.listen(&recorder);
  const int port = dram.open_port(nullptr);
  dram.put(port, {0, 0, false});
  for (int i = 0; i < 815; ++i) dram.cycle();
  dram.put(port, {64, 0, false});
  dram.put(port, {32 * 64, 0, false});
  ASSERT_EQ(locate(32 * 64, p).bank, 1);
  for (int i = 0; i < 600; ++i) dram.cycle();
  EXPECT_EQ(words(recorder.all),
            "ACT 0; RD 29; RD 37; PRE 780; REFB 809; ACT 825; RD 854; RD 862; ACT 953; RD 982; RD 990; ");
  EXPECT_EQ(dram.counts().bank_refreshes, 1);
  EXPECT_EQ(recorder.all[4].bank, 0);
}

// DDR5 refreshes a bank of each group with one command, LPDDR5 one of two groups, and others one alone.
TEST(Memory, BanksAreRefreshedInTurn) {
  for (Parameters p : all_by_bank()) {
    p.channels = 1;
    Dram dram(p, p.mhz);
    Recorder recorder;
    dram.listen(&recorder);
    const int round = p.groups * p.banks / p.groups_at_once;
    for (int i = 0; i < (round + 1) * p.refi_bank + 1; ++i) dram.cycle();
    ASSERT_EQ(std::ssize(recorder.all), round + 1) << p.name;
    std::map<std::pair<int, int>, int> seen;
    for (int i = 0; i <= round; ++i) {
      const Command& c = recorder.all[i];
      EXPECT_EQ(c.kind, Command::Kind::refresh_bank);
      EXPECT_EQ(c.cycle, (i + 1) * std::int64_t{p.refi_bank}) << p.name;
      ++seen[{c.group, c.bank}];
    }
    EXPECT_EQ(std::ssize(seen), round) << p.name;
  }
  EXPECT_EQ(by_bank("ddr5-4800").refreshes_of_rank(), 4);
  EXPECT_EQ(by_bank("lpddr4-3200").refreshes_of_rank(), 8);
  EXPECT_EQ(by_bank("lpddr5-6400").refreshes_of_rank(), 8);
  EXPECT_EQ(by_bank("hbm3").refreshes_of_rank(), 16);
}

TEST(Memory, ClocksDoNotDrift) {
  for (const int mhz : {7, 200, 333, 1200, 2000}) {
    Dram dram(sheet("ddr4-2400"), mhz);
    for (std::int64_t cycle = 1; cycle <= 100000; ++cycle) {
      dram.cycle();
      ASSERT_EQ(dram.memory_cycles(), cycle * 1200 / mhz);
    }
  }
}

// Requests go to the same few bursts. Each read finds the last value written before it was taken.
struct Bytes final : PortClient, RequestListener {
  void taken(std::int64_t, const Request& request) override {
    if (request.write)
      last[request.address] = request.id;
    else
      expected[request.id] = last[request.address];
  }
  void performed(const Request& request) override {
    if (request.write)
      stored[request.address] = request.id;
    else {
      wrong += stored[request.address] == expected[request.id] ? 0 : 1;
      ++compared;
    }
  }
  std::map<std::int64_t, std::uint32_t> last, stored;
  std::map<std::uint32_t, std::uint32_t> expected;
  int wrong = 0, compared = 0;
};

TEST(Memory, KeepsTheRulesTheOrderAndItsAccounts) {
  Parameters slow_bus = sheet("lpddr4-3200");  // two ranks share a bus on which commands take cycles
  slow_bus.ranks = 2;
  slow_bus.channels = 1;
  std::vector<Parameters> all = all_sheets();
  all.push_back(two_ranks());
  all.push_back(slow_bus);
  for (const char* name : {"ddr5-4800", "lpddr4-3200", "lpddr5-6400", "hbm2"}) all.push_back(by_bank(name));
  all.push_back(slow_bus);
  all.back().by_bank = true;
  for (const Parameters& p : all) {
    for (const int mhz : {150, 400}) {
      Dram dram(p, mhz);
      TimingChecker checker(p);
      Bytes bytes;
      dram.listen(&checker);
      dram.trace(&bytes);
      Traffic traffic(dram, 3, 5 + static_cast<std::uint64_t>(mhz), &bytes);
      traffic.run(120000);
      ASSERT_TRUE(traffic.drain()) << p.name;
      for (int i = 0; i < 100; ++i) dram.cycle();  // until the last data have passed
      checker.finish(dram.memory_cycles());
      EXPECT_EQ(checker.violations(), 0) << p.name << ": " << checker.first();
      EXPECT_EQ(bytes.wrong, 0) << p.name;
      EXPECT_GT(bytes.compared, 6000);
      const Counts counts = dram.counts();
      EXPECT_EQ(traffic.replies(), traffic.asked());
      EXPECT_EQ(counts.reads, traffic.asked());
      EXPECT_EQ(counts.writes, traffic.written());
      EXPECT_EQ(counts.hits + counts.misses + counts.conflicts, counts.reads + counts.writes);
      EXPECT_EQ(counts.cycles(), dram.memory_cycles() * p.channels);
      EXPECT_EQ(counts.busy, (counts.reads + counts.writes) * p.columns_of_request() * p.beats());
      EXPECT_GT(counts.held, 100);
      EXPECT_EQ(checker.commands(), counts.activates + counts.precharges + counts.refreshes +
                                        counts.bank_refreshes + counts.columns);
      EXPECT_EQ(counts.refreshes == 0, p.by_bank);
    }
  }
}

// A stream of row hits meets one request that wants another row of the same bank.
TEST(Memory, NoRequestStarves) {
  const auto worst = [](int starve) {
    Policy policy;
    policy.starve = starve;
    Dram dram(sheet("ddr4-2400"), 400, policy);
    const int hits = dram.open_port(nullptr), lone = dram.open_port(nullptr);
    std::int64_t column = 0;
    for (int cycle = 0; cycle < 20000; ++cycle) {
      while (dram.reply(hits) != nullptr) dram.take(hits);
      while (dram.reply(lone) != nullptr) dram.take(lone);
      if (cycle == 100) dram.put(lone, {4 * kNextRow * 4, 0, false});
      while (dram.ready(hits)) dram.put(hits, {column++ % 128 * kNextColumn, 1, false});
      dram.cycle();
    }
    return dram.counts().worst_read;
  };
  ASSERT_EQ(locate(16 * kNextRow, sheet("ddr4-2400")).bank, 0);
  ASSERT_EQ(locate(16 * kNextRow, sheet("ddr4-2400")).group, 0);
  EXPECT_LT(worst(2000), 2000 + 600);
  EXPECT_GT(worst(1 << 30), 5000);  // until the next refresh closes the row
}

double share(const Counts& counts) {
  return static_cast<double>(counts.busy) / static_cast<double>(counts.cycles());
}
struct Stream {
  std::int64_t base;
  bool write;
};
Counts saturated(const Parameters& p, const std::vector<Stream>& streams) {
  Dram dram(p, 400);
  std::vector<std::int64_t> at;
  for (const Stream& stream : streams) {
    dram.open_port(nullptr);
    at.push_back(stream.base);
  }
  for (int cycle = 0; cycle < 200000; ++cycle) {
    for (std::size_t i = 0; i < streams.size(); ++i) {
      const int port = static_cast<int>(i);
      while (dram.reply(port) != nullptr) dram.take(port);
      while (dram.ready(port)) {
        dram.put(port, {at[i], 0, streams[i].write});
        at[i] += kBurst;
      }
    }
    dram.cycle();
  }
  return dram.counts();
}

// One channel of each memory is asked, because three streams cannot fill the 32 of a stack.
TEST(Memory, StreamsComeNearThePeak) {
  constexpr std::int64_t kFar = std::int64_t{1} << 26;
  for (Parameters p : all_sheets()) {
    p.channels = 1;
    const std::string& name = p.name;
    const Counts one = saturated(p, {{0, false}});
    const Counts three = saturated(p, {{0, false}, {kFar, true}, {2 * kFar, false}});
    for (const Counts& c : {one, three}) {
      const auto percent = [&](std::int64_t cycles) {
        return std::to_string(100.0 * static_cast<double>(cycles) / static_cast<double>(c.cycles()));
      };
      std::cout << name << ", in %: busy " << percent(c.busy) << ", refresh " << percent(c.refresh)
                << ", turnaround " << percent(c.turnaround) << ", row " << percent(c.row) << ", spacing "
                << percent(c.spacing) << ", idle " << percent(c.idle) << '\n';
    }
    // Both kinds wait all the time, and get the same number of requests.
    EXPECT_NEAR(static_cast<double>(three.reads), static_cast<double>(three.writes), 500.0) << name;
    EXPECT_GE(share(one), 0.89) << name;
    EXPECT_GE(share(three), 0.74) << name;
    EXPECT_LE(share(one), 1 - static_cast<double>(p.rfc) / p.refi) << name;  // no more than refresh leaves
    if (p.groups_at_once == 0) continue;
    p.by_bank = true;
    const Counts alone = saturated(p, {{0, false}}),
                 all = saturated(p, {{0, false}, {kFar, true}, {2 * kFar, false}});
    std::cout << name << ", refreshed by banks: busy " << 100 * share(alone) << " %, three streams "
              << 100 * share(all) << " %\n";
    EXPECT_GT(share(alone), share(one)) << name;
  }
}

TEST(Memory, TracesOfRequests) {
  std::ostringstream ramulator, dramsys, dramsim3;
  const std::vector<std::pair<std::ostringstream*, TraceFormat>> all{{&ramulator, TraceFormat::ramulator},
                                                                     {&dramsys, TraceFormat::dramsys},
                                                                     {&dramsim3, TraceFormat::dramsim3}};
  for (const auto& [to, format] : all) {
    Dram dram(sheet("ddr4-2400"), 200);
    TraceWriter writer(*to, format);
    dram.trace(&writer);
    const int port = dram.open_port(nullptr);
    dram.put(port, {0x1240, 0, false});
    dram.cycle();
    dram.put(port, {0xabc0, 0, true});
    dram.put(port, {0x40, 0, false});
    dram.cycle();
  }
  EXPECT_EQ(ramulator.str(), "0x1240 R\n0xabc0 W\n0x40 R\n");
  EXPECT_EQ(dramsim3.str(), "0x1240 READ 0\n0xabc0 WRITE 6\n0x40 READ 7\n");
  EXPECT_EQ(dramsys.str(), "0: read 0x1240\n6: write 0xabc0\n7: read 0x40\n");
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
