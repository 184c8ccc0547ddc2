#include "hwmodel/fabric/ring.h"

#include <gtest/gtest.h>

namespace voxmelt::hwmodel {
namespace {

TEST(Ring, GivesTokensInOrderWhileItGrowsAndTurns) {
  Ring<int> ring(3);
  int in = 0, out = 0;
  const auto push = [&] {
    const int lanes[3] = {in, in + 1000, in + 2000};
    ring.push(lanes);
    ++in;
  };
  for (int round = 1; round < 40; ++round) {
    for (int i = 0; i < round; ++i) push();
    for (int i = 0; i < round - (round % 3 == 0 ? 1 : 0); ++i) {
      ASSERT_FALSE(ring.empty());
      const int* lanes = ring.pop();
      ASSERT_EQ(lanes[0], out);
      ASSERT_EQ(lanes[2], out + 2000);
      ++out;
    }
  }
  EXPECT_FALSE(ring.empty());
  ring.clear();
  EXPECT_TRUE(ring.empty());
  push();
  EXPECT_EQ(ring.pop()[1], in + 999);
}

}  // namespace
}  // namespace voxmelt::hwmodel
