// The bus of a DRAM in the closed form, worked by hand: a burst takes one cycle, a turn ten, and nothing is
// refreshed.
#include "hwmodel/explore/bus_time.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "hwmodel/explore/stream_time.h"
#include "hwmodel/memory/sheet.h"

namespace voxmelt::hwmodel::explore {
namespace {

BusTimes plain() {
  BusTimes times;
  times.burst = 1;
  times.turn = 10;
  times.refresh_every = 1e9;
  return times;
}

// A stream of `columns` columns, each of `reads` and `writes` bursts, and of `cycles` without waits.
ColumnWork stream(int columns, ColumnBursts bursts, double cycles) {
  ColumnWork work;
  work.columns.assign(columns, bursts);
  work.column_cycles = cycles;
  return work;
}

std::int64_t cycles_of(const ColumnWork& work, const BusTimes& times) {
  bool waits = true;
  return cycles_by_columns(work, times, memory::Policy{}, waits);
}

// 48 reads, 48 writes, 48 reads, 48 writes, and four reads more.
TEST(BusTime, TurnsAfterABatchOfReadsHoweverTheyCome) {
  for (const int piece : {1, 20, 50, 100}) {
    BusTime bus(plain(), memory::Policy{});
    bus.write(110);
    double end = 0;
    for (int i = 0; i < 100; i += piece) end = bus.read(piece, 0);
    EXPECT_EQ(end, 100 + 2 * 48 + 2 * 10) << "in pieces of " << piece;
  }
}

// Queues and the writer's buffer hold 64 + 128 bursts.
TEST(BusTime, WritesThatFindNoRoomGoFirst) {
  BusTime bus(plain(), memory::Policy{});
  bus.write(192);
  EXPECT_EQ(bus.hold(7), 7) << "there is room for just so many";
  bus.write(100);
  EXPECT_EQ(bus.hold(7), 100) << "nothing was read, so nothing turns";
  EXPECT_EQ(bus.read(24, 0), 124);
  bus.write(1);
  EXPECT_EQ(bus.hold(0), 124 + 48 + 5) << "a batch at least, and half a turn for half a batch of reads";
  EXPECT_EQ(bus.hold(500), 500) << "there is room again";
}

// A channel writes in 48 of 108 cycles. A reply is late then, and so is the one behind it.
TEST(BusTime, RepliesOfSeveralChannelsAreLate) {
  BusTimes times = plain();
  times.turn = 0;
  times.late = 25;
  BusTime bus(times, memory::Policy{});
  bus.read(60, 0);
  EXPECT_EQ(bus.late(), 0);
  bus.write(232);
  EXPECT_EQ(bus.hold(0), 60 + 48) << "at least a batch";
  EXPECT_NEAR(bus.late(), 25 * (1 - (60. / 108) * (60. / 108)), 1e-9);
  const memory::Parameters one = load_memory("ddr4-2400", "test");
  EXPECT_EQ(bus_times(one, 300, 20).late, 0) << "one channel turns with itself";
  memory::Parameters four = one;
  four.channels = 4;
  EXPECT_NEAR(bus_times(four, 300, 20).late, 0.75 * (20 + 17 + 17) / 4, 1e-9);
}

// Columns that are written at two bursts a cycle and read at next to nothing take the bus's time, but for the
// 192 bursts that still wait at the end.
TEST(StreamTime, AWriterWithoutRoomHoldsThePipeline) {
  const ColumnWork work = stream(100, {0.01, 200}, 100);
  const std::int64_t cycles = cycles_of(work, plain());
  EXPECT_GE(cycles, 100 * 200 - 192);
  EXPECT_LE(cycles, 100 * 200);
  // The pipeline must not run ahead of what it could not hand over. So columns that write nothing come after
  // those that write much, but for one that they overlap.
  ColumnWork then_idle = stream(66, {0.01, 200}, 100);
  for (int i = 0; i < 34; ++i) then_idle.columns.push_back({0.01, 0});
  EXPECT_GE(cycles_of(then_idle, plain()), 66 * 200 - 192 + 33 * 100);
}

// The first burst of a column comes after a latency, and then its tokens take their time.
TEST(StreamTime, TokensFollowTheirBurst) {
  BusTimes times = plain();
  times.latency = 1000;
  EXPECT_EQ(cycles_of(stream(1, {1, 0}, 84), times), 1 + 1000 + 84);
  EXPECT_EQ(cycles_of(stream(1, {16, 0}, 84), times), 16 + 1000 + 5) << "the last burst takes 84 / 16 cycles";
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
