// The streams of the pipeline run on a DRAM, token by token. The test sees each burst, its time and its
// place.
#include "hwmodel/pipeline/streams/memory_streams.h"

#include <gtest/gtest.h>

#include <cstdint>

#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"

namespace voxmelt::hwmodel {
namespace {

// A pass has 32 tokens of 34 bits, under the paper's law without heat. Its 1088 bits take three bursts of
// 512. Fifteen tokens are 510 bits.
constexpr int kTokens = 32;
Design small() {
  Design design;
  design.shape = {{1, 8, 4}};
  return design;
}

class Streams {
 public:
  explicit Streams(int passes, const IrradianceStream* light = nullptr)
      : streams_(small(), 1, load_memory("ddr4-2400", ""), 200) {
    const int fed = light == nullptr ? 0 : 1;
    streams_.begin_train({.tile = 0, .fed = fed, .irradiance = light});
    for (int pass = 1; pass < passes; ++pass) streams_.add_pass(0, fed);
  }
  // Reads and writes as many tokens as it may, in as many cycles. Each side moves at most one in a cycle.
  void run(int to_read, int to_write, int cycles = 400) {
    while (cycles-- > 0) {
      if (to_read > 0 && streams_.may_read(0, now_)) {
        streams_.read(0, false, now_);
        ++read_;
        --to_read;
      }
      if (to_write > 0 && streams_.may_write(now_)) {
        streams_.written(0, false, now_);
        --to_write;
      }
      streams_.cycle(now_++);
    }
  }
  int read() const { return read_; }
  memory::Counts counts() const { return streams_.counts(); }

 private:
  MemoryStreams streams_;
  std::int64_t now_ = 0;
  int read_ = 0;
};

TEST(MemoryStreams, HandOnBurstsThatAreFull) {
  Streams one(1);
  one.run(0, 15);
  EXPECT_EQ(one.counts().writes, 0);
  one.run(0, 1);
  EXPECT_EQ(one.counts().writes, 1);
  one.run(0, kTokens - 17);
  EXPECT_EQ(one.counts().writes, 2);
  one.run(0, 1);
  EXPECT_EQ(one.counts().writes, 3) << "the last one is padded";
}

TEST(MemoryStreams, NoPassReadsWhatTheOneBeforeHasNotWritten) {
  Streams two(2);
  two.run(2 * kTokens, 0);
  EXPECT_EQ(two.read(), kTokens) << "nothing has been written";
  EXPECT_EQ(two.counts().reads, 3);
  two.run(kTokens, 16);
  EXPECT_EQ(two.read(), kTokens + 15) << "one burst has";
  two.run(kTokens, kTokens - 16);
  EXPECT_EQ(two.read(), 2 * kTokens);
  EXPECT_EQ(two.counts().reads, 6);
}

// The state's bursts lie in three bank groups, and irradiance in a row of its own.
TEST(MemoryStreams, IrradianceLiesBehindTheState) {
  Irradiance field(small().shape.grid);
  field.row(3, 2)[0] = 5;
  const IrradianceStream light(field, small().shape);
  ASSERT_GT(light.bits(), 0);
  Streams one(1, &light);
  one.run(0, 0);
  EXPECT_EQ(one.counts().reads, 4);
  EXPECT_EQ(one.counts().activates, 4);
  EXPECT_EQ(one.counts().hits, 0);
}

}  // namespace
}  // namespace voxmelt::hwmodel
