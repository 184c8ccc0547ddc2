// The memory of a fixed latency is tested by hand. It has latency 10, and a bus of 64 bytes unless a test
// says otherwise.
#include "hwmodel/memory/fixed_latency.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace voxmelt::hwmodel::memory {
namespace {

struct Client final : PortClient {
  void performed(const Request& request) override { seen.push_back(request.id); }
  std::vector<std::uint32_t> seen;
};

// Runs cycles until a reply is there, and returns the number of the cycle, counted from `now`.
std::int64_t cycle_of_reply(FixedLatency& memory, int port, std::int64_t& now) {
  for (; memory.reply(port) == nullptr; ++now) memory.cycle();
  memory.take(port);
  return now;
}

TEST(FixedLatency, ALineTakesItsLatencyAndItsCyclesOfTheBus) {
  FixedLatency memory(10, 64);
  Client client;
  const int port = memory.open_port(&client);
  memory.put(port, {0, 1, false, 64});  // in cycle 0: one cycle of the bus after the latency
  std::int64_t now = 0;
  EXPECT_EQ(cycle_of_reply(memory, port, now), 11);
  memory.put(port, {0, 2, false, 130});  // three cycles of the bus
  EXPECT_EQ(cycle_of_reply(memory, port, now), 11 + 10 + 3);
  EXPECT_EQ(memory.bus_cycles(), 4);
  EXPECT_EQ(client.seen, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_TRUE(memory.idle());
}

TEST(FixedLatency, AWriteKeepsTheBusFromARead) {
  FixedLatency memory(10, 64);
  Client client;
  const int port = memory.open_port(&client);
  for (int i = 0; i < 20; ++i) memory.put(port, {64 * i, 0, true, 64});  // the bus is taken until cycle 21
  memory.put(port, {0, 7, false, 64});
  std::int64_t now = 0;
  EXPECT_EQ(cycle_of_reply(memory, port, now), 22);
}

TEST(FixedLatency, WhatAClientAskedForReturnsInItsOrderAndOneACycle) {
  FixedLatency memory(10, 256);
  Client client;
  const int first = memory.open_port(&client), second = memory.open_port(&client);
  memory.put(second, {0, 2, false, 64});
  memory.put(first, {0, 1, false, 64});  // within a cycle, the first port is served first
  for (int i = 0; i < 30; ++i) memory.cycle();
  EXPECT_EQ(memory.reply(second), nullptr) << "it comes behind that of the first port";
  ASSERT_NE(memory.reply(first), nullptr);
  EXPECT_EQ(memory.reply(first)->id, 1u);
  memory.take(first);
  EXPECT_EQ(memory.reply(second), nullptr) << "one a cycle";
  memory.cycle();
  ASSERT_NE(memory.reply(second), nullptr);
  memory.take(second);
  EXPECT_TRUE(memory.idle());
}

// Three bursts of 64 bytes take two cycles of 96.
TEST(FixedLatency, StreamsArePackedOnTheBus) {
  FixedLatency memory(10, 96);
  const int stream = memory.open_port(nullptr);
  for (std::uint32_t i = 0; i < 3; ++i) memory.put(stream, {64 * i, i, false, 64});
  memory.cycle();
  EXPECT_EQ(memory.bus_cycles(), 2);
  for (int i = 1; i < 12; ++i) memory.cycle();
  for (std::uint32_t i = 0; i < 3; ++i) {  // all have come, and all may be taken in one cycle
    ASSERT_NE(memory.reply(stream), nullptr) << i;
    EXPECT_EQ(memory.reply(stream)->id, i);
    memory.take(stream);
  }
}

// A stream claims 64 cycles of the bus beyond the latency, and waits. A client may claim more.
TEST(FixedLatency, AStreamWaitsForTheBus) {
  FixedLatency memory(10, 64);
  Client client;
  const int stream = memory.open_port(nullptr), lines = memory.open_port(&client);
  int claimed = 0;
  for (int cycle = 0; cycle < 3; ++cycle) {
    for (int i = 0; i < 40 && memory.ready(stream); ++i) {
      memory.put(stream, {0, 0, true, 64});
      ++claimed;
    }
    memory.cycle();
  }
  EXPECT_EQ(claimed, 80);  // after two cycles the bus is free from cycle 81 on: 69 cycles beyond the latency
  EXPECT_FALSE(memory.ready(stream));
  EXPECT_TRUE(memory.ready(lines));
  for (int cycle = 3; cycle < 8; ++cycle) memory.cycle();
  EXPECT_TRUE(memory.ready(stream));  // in cycle 8 only 63 are left
}

// 100 lines take four cycles each, until cycle 410. The stream's bursts stand behind them, one a cycle.
TEST(FixedLatency, AClientThatAsksForMuchKeepsNoStreamFromTheQueue) {
  FixedLatency memory(10, 64);
  Client client;
  const int stream = memory.open_port(nullptr), lines = memory.open_port(&client);
  for (std::uint32_t i = 0; i < 100; ++i) memory.put(lines, {256 * i, i, false, 256});
  memory.cycle();
  ASSERT_TRUE(memory.ready(stream));
  for (std::uint32_t i = 0; i < 70; ++i) memory.put(stream, {64 * i, i, true, 64});
  memory.cycle();
  std::int64_t now = 2;
  for (; !memory.ready(stream); ++now) memory.cycle();
  EXPECT_EQ(now, 407);  // the bus is promised until 480: 63 cycles beyond this one and the latency
}

}  // namespace
}  // namespace voxmelt::hwmodel::memory
