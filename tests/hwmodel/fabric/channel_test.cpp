// The parts of the pipeline are tested alone: channels, their stalls, line buffers, column memories, wires.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hwmodel/fabric/column_reverser.h"
#include "hwmodel/fabric/fifo.h"
#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel {
namespace {

Fifo<int> channel(int depth) { return {"channel", 3, 1, depth, 0}; }

TEST(Channel, HoldsAsManyTokensAsItIsDeep) {
  for (const int depth : {1, 2, 5}) {
    Fifo<int> fifo = channel(depth);
    int tokens = 0;
    for (; fifo.ready() && tokens < 10; ++tokens) {
      *fifo.put() = tokens;
      fifo.commit();
    }
    EXPECT_EQ(tokens, depth);
    for (int token = 0; token < tokens; ++token) {
      ASSERT_TRUE(fifo.valid());
      EXPECT_EQ(*fifo.get(), token);
      fifo.commit();
    }
    EXPECT_FALSE(fifo.valid());
  }
}

// If it did, the order in which blocks are evaluated would matter.
TEST(Channel, NothingShowsBeforeTheCycleEnds) {
  Fifo<int> fifo = channel(1);
  *fifo.put() = 7;
  EXPECT_FALSE(fifo.valid()) << "seen in the cycle in which it was put";
  fifo.commit();
  EXPECT_TRUE(fifo.valid());
  EXPECT_EQ(*fifo.get(), 7);
  EXPECT_FALSE(fifo.ready()) << "room in the cycle in which it is made";
  fifo.commit();
  EXPECT_TRUE(fifo.ready());
}

TEST(Channel, CountsItsCyclesByOccupancy) {
  Fifo<int> fifo = channel(3);
  fifo.commit();  // occupancy 0
  for (int i = 0; i < 2; ++i) {
    fifo.put();
    fifo.commit();
  }  // occupancies 1, 2
  for (int i = 0; i < 2; ++i) {
    fifo.get();
    fifo.commit();
  }  // occupancies 1, 0
  fifo.put();
  fifo.commit();  // occupancy 1
  EXPECT_EQ(fifo.occupancy(), (std::vector<std::int64_t>{2, 3, 1, 0}));
  EXPECT_EQ(fifo.highest(), 2);
  EXPECT_EQ(fifo.count(), 1);
}

struct Seen final : FifoWatcher<int> {
  using Tokens = std::vector<std::pair<std::int64_t, int>>;
  Tokens in, out;
  void entered(int channel, std::int64_t ordinal, const int* lanes) override {
    EXPECT_EQ(channel, 3);
    in.emplace_back(ordinal, *lanes);
  }
  void left(int channel, std::int64_t ordinal, const int* lanes) override {
    EXPECT_EQ(channel, 3);
    out.emplace_back(ordinal, *lanes);
  }
};

TEST(Channel, TokensAreNumberedFromTheBeginOfAPass) {
  Fifo<int> fifo = channel(2);
  Seen seen;
  fifo.watch(&seen);
  for (int pass = 0; pass < 2; ++pass) {
    fifo.begin_pass(static_cast<std::uint64_t>(pass));
    for (int i = 0; i < 3; ++i) {
      *fifo.put() = 10 * pass + i;
      fifo.commit();
      fifo.get();
      fifo.commit();
    }
    EXPECT_EQ(fifo.entered(), 3);
    EXPECT_EQ(fifo.left(), 3);
  }
  EXPECT_EQ(seen.in, (Seen::Tokens{{0, 0}, {1, 1}, {2, 2}, {0, 10}, {1, 11}, {2, 12}}));
  EXPECT_EQ(seen.out, seen.in);
}

// Holds the fractions of 100 000 cycles that refuse to put, to get, and both.
struct Refusals {
  double put = 0, get = 0, both = 0;
  std::vector<bool> puts;
};
Refusals refusals(std::uint64_t seed, std::uint64_t channel, std::uint64_t pass = 0) {
  constexpr int kCycles = 100'000;
  StallInjector injector(seed, channel, pass);
  Refusals seen;
  for (int i = 0; i < kCycles; ++i) {
    const StallInjector::Stall stall = injector.next();
    seen.put += stall.put;
    seen.get += stall.get;
    seen.both += stall.put && stall.get;
    seen.puts.push_back(stall.put);
  }
  seen.put /= kCycles;
  seen.get /= kCycles;
  seen.both /= kCycles;
  return seen;
}

TEST(Stalls, EachSideRefusesOneCycleInFourApartFromTheOther) {
  for (const std::uint64_t seed : {1u, 2u, 77u}) {
    const Refusals seen = refusals(seed, 5);
    EXPECT_NEAR(seen.put, 0.25, 0.01);
    EXPECT_NEAR(seen.get, 0.25, 0.01);
    EXPECT_NEAR(seen.both, 0.0625, 0.005);
  }
  EXPECT_EQ(refusals(0, 5).put + refusals(0, 5).get, 0) << "seed 0 stalls";
}

// A stalled channel refuses each side as often, however many tokens it holds.
TEST(Stalls, AChannelRefusesOneCycleInFourHoweverFullItIs) {
  for (const int tokens : {1, 2, 3}) {
    Fifo<int> fifo{"channel", 3, 1, 4, 7};
    while (fifo.count() < tokens) {
      if (fifo.ready()) fifo.put();
      fifo.commit();
    }
    int refuses_put = 0, refuses_get = 0;
    for (int cycle = 0; cycle < 4000; ++cycle) {
      refuses_put += fifo.ready() ? 0 : 1;
      refuses_get += fifo.valid() ? 0 : 1;
      fifo.commit();
    }
    EXPECT_NEAR(refuses_put, 1000, 120) << tokens;
    EXPECT_NEAR(refuses_get, 1000, 120) << tokens;
  }
}

TEST(Stalls, DifferFromChannelToChannelFromSeedToSeedFromPassToPass) {
  EXPECT_EQ(refusals(1, 5).puts, refusals(1, 5).puts);
  EXPECT_NE(refusals(1, 5).puts, refusals(1, 6).puts);
  EXPECT_NE(refusals(1, 5).puts, refusals(2, 5).puts);
  EXPECT_NE(refusals(1, 5, 1).puts, refusals(1, 5, 2).puts);
}

TEST(LineBuffer, ANewTokenIsBlankAndTapsSeeTheOldOnes) {
  TapLine<int> line(2, 3);
  for (int token = 1; token < 20; ++token) {
    line.shift();
    EXPECT_EQ(line.tap(0)[0], 0);
    EXPECT_EQ(line.tap(0)[1], 0);
    line.tap(0)[0] = token;
    line.tap(0)[1] = -token;
    for (int delay = 0; delay <= 3 && delay < token; ++delay) {
      EXPECT_EQ(line.tap(static_cast<std::size_t>(delay))[0], token - delay);
      EXPECT_EQ(line.tap(static_cast<std::size_t>(delay))[1], delay - token);
    }
  }
}

TEST(LineBuffer, NobodyLooksBehindItsEnd) {
  TapLine<int> line(2, 3);
  EXPECT_NO_THROW(line.tap(3));
  EXPECT_THROW(line.tap(4), AddressError);
  EXPECT_THROW(line.tap(5), AddressError);
}

TEST(LineBuffer, CostsWordsTimesLanesTimesBits) {
  EXPECT_EQ((BufferCost{"memory", 3, 4, 5}).total(), 60);
  const BufferCost cost = ColumnReverser<int>(4, 9).cost("column", 7);
  EXPECT_EQ(cost.words, 9);
  EXPECT_EQ(cost.lanes, 4);
  EXPECT_EQ(cost.bits, 7);
}

TEST(ColumnMemory, TurnsColumnsRoundAlsoAfterARestartHalfWay) {
  ColumnReverser<int> reverser(1, 4);
  for (const int before_restart : {0, 1, 4, 7}) {
    for (int i = 0, out = 0; i < before_restart; ++i) reverser.exchange(&i, &out);
    reverser.restart();
    for (int column = 0; column < 4; ++column)
      for (int y = 0; y < 4; ++y) {
        const int in = 10 * column + y;
        int out = -1;
        reverser.exchange(&in, &out);
        if (column > 0) {
          EXPECT_EQ(out, 10 * (column - 1) + 3 - y);
        }
      }
  }
}

TEST(Wire, AValueThatDoesNotFitIsRefused) {
  EXPECT_EQ(UInt<8>(255), 255);
  EXPECT_EQ(UInt<8>(0), 0);
  EXPECT_THROW(UInt<8>(256), WidthError);
  EXPECT_THROW(UInt<8>(-1), WidthError);
  EXPECT_EQ(UInt<8>::truncated(0x1FE), 0xFE);
  EXPECT_EQ(SInt<8>(127), 127);
  EXPECT_EQ(SInt<8>(-128), -128);
  EXPECT_THROW(SInt<8>(128), WidthError);
  EXPECT_THROW(SInt<8>(-129), WidthError);
}

TEST(Wire, BitsThatHoldANumber) {
  for (const auto& [most, bits] : {std::pair{0, 1}, {1, 1}, {2, 2}, {3, 2}, {4, 3}, {255, 8}, {256, 9}})
    EXPECT_EQ(bits_for(most), bits) << most;
}

}  // namespace
}  // namespace voxmelt::hwmodel
