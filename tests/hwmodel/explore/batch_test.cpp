// One design for several scenes is sought among designs that were made by hand.
#include "hwmodel/explore/batch.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::hwmodel::explore {
namespace {

struct Made {
  Question question;
  Swept swept;
  Made(int side, std::int64_t steps) {
    question.grid = {side, side, side};
    question.steps = steps;
  }
  void add(int lanes, int substeps, std::int64_t speed, double fullest = 0.5, int tile = 0) {
    Point point;
    point.hw.lanes = lanes;
    point.hw.substeps = substeps;
    point.hw.tile = tile;
    point.clock_mhz = 100;
    point.speed = speed;
    point.taken.fullest = fullest;
    swept.points.push_back(point);
  }
};

// A scene of 1000 cells and 10 steps of the paper law, and one of 8000 cells with sub-steps. Speeds are
// thousand cell-steps a second.
struct Two {
  Made paper{10, 10}, viscous{20, 10};
  std::vector<BatchScene> scenes{{"paper", paper.question, paper.swept},
                                 {"viscous", viscous.question, viscous.swept}};
  Two() {
    paper.add(2, 1, 10);
    paper.add(4, 1, 20);
    paper.add(4, 1, 40, 0.5, 8);  // the same design in tiles
    paper.add(8, 1, 100, 1.5);    // does not fit
    viscous.add(2, 1, 400);
    viscous.add(2, 2, 80);
    viscous.add(4, 2, 160);
    viscous.add(8, 1, 900);
  }
};

// The paper's scene has no second sub-step, so it leaves that copy out. The other scene has no design of 4
// lanes with one copy.
TEST(Batch, DesignsAreSharedByHand) {
  const Two two;
  const Batch sum = batch_of(two.scenes, Aim::sum);
  EXPECT_EQ(sum.own[0], 2U);
  EXPECT_EQ(sum.own[1], 3U);
  EXPECT_DOUBLE_EQ(sum.own_seconds, 0.25 + 80000 / 9e5);
  ASSERT_EQ(sum.designs.size(), 3U);
  const BatchDesign& best = sum.designs[0];  // 0.25 + 0.5 s; the others take 1 + 0.2 and 1 + 1
  EXPECT_EQ(best.hw.lanes, 4);
  EXPECT_EQ(best.hw.substeps, 2);
  EXPECT_EQ(best.points, (std::vector<std::size_t>{2, 2}));
  EXPECT_DOUBLE_EQ(best.seconds, 0.75);
  EXPECT_DOUBLE_EQ(best.worst_share, 160. / 900);
  EXPECT_EQ(best.worst, 1U);
  EXPECT_DOUBLE_EQ(sum.designs[1].seconds, 1.2);
  EXPECT_EQ(sum.designs[1].points, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(sum.designs[2].points, (std::vector<std::size_t>{0, 1}));
}

// The least share of 2 lanes is 10 / 40, and that of 4 lanes 160 / 900.
TEST(Batch, TheWorstShareMayChooseAnother) {
  const Two two;
  const Batch worst = batch_of(two.scenes, Aim::worst);
  EXPECT_EQ(worst.designs[0].hw.lanes, 2);
  EXPECT_EQ(worst.designs[0].hw.substeps, 1);
  EXPECT_DOUBLE_EQ(worst.designs[0].worst_share, 0.25);
  EXPECT_EQ(worst.designs[0].worst, 0U);
}

TEST(Batch, ASceneForWhichNothingFitsEndsIt) {
  Two two;
  for (Point& point : two.paper.swept.points) point.taken.fullest = 2;
  const Batch none = batch_of(two.scenes, Aim::sum);
  EXPECT_FALSE(none.own[0]);
  EXPECT_TRUE(none.designs.empty());
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
