// The axes of a sweep: which values are tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "hwmodel/explore/sweep.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::explore {
namespace {

using Lanes = std::vector<int>;

// 128 cells are 64 blocks of 2, 43 of 3, .., and 4 of 32. 31 lanes need 5 blocks, as 26 do.
TEST(Axes, LanesThatLeaveNoneIdle) {
  EXPECT_EQ(lanes_worth_trying(128),
            (Lanes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 15, 16, 19, 22, 26, 32}));
  EXPECT_EQ(lanes_worth_trying(12), (Lanes{1, 2, 3, 4, 6, 12}));
  EXPECT_EQ(lanes_worth_trying(1), (Lanes{1}));
}

TEST(Axes, AnyNumberOfLanesMayBeKept) {
  Question question;
  question.grid = {12, 4, 4};
  question.device = load_device("zu7ev", {});
  for (const int lanes : {1, 5, 32}) {
    Axes axes = usual_axes(question);
    keep_only(axes, {"hw.lanes=" + std::to_string(lanes)});
    EXPECT_EQ(axes.lanes, Lanes{lanes});
  }
  Axes axes = usual_axes(question);
  EXPECT_THROW(keep_only(axes, {"hw.lanes=33"}), scene::InputError);
  EXPECT_THROW(keep_only(axes, {"hw.lanes=0"}), scene::InputError);
  EXPECT_THROW(keep_only(axes, {"hw.clock_mhz=301"}), scene::InputError);
}

// Every token of a stream is looked at.
TEST(Axes, ATokenDrawsFromSoManyBlocks) {
  for (int lanes = 1; lanes <= 32; ++lanes) {
    std::size_t most = 0;
    for (int x = 0; x < 8 * lanes; x += lanes) {
      std::set<int> blocks;
      for (int lane = 0; lane < lanes; ++lane) blocks.insert((x + lane) / 8);
      most = std::max(most, blocks.size());
    }
    EXPECT_EQ(blocks_of_token(lanes), static_cast<int>(most)) << lanes;
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
