// The closed form of a chain is worked by hand, and compared with a simulation of two devices and their
// links.
#include "hwmodel/explore/chain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/time/prediction.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel::explore {
namespace {

// A grid of 96 x 8 x 10 cells for 4 lanes, in tiles of 52 columns. A step of the paper law without heat
// reaches two cells: for its pattern one, and for what is moved another one. So the halo of two steps is one
// block.
struct Two {
  Question question;
  Configuration hw;
  Two() {
    question.grid = {96, 8, 10};
    question.parameters.flow.law = rule::Law::paper;
    question.steps = 8;
    question.device = load_device("zu7ev", {"device.chain=2", "device.link=10", "device.link_latency=0"});
    hw.lanes = 4;
    hw.cascade = 2;
    hw.tile = 52;
    hw.overlap = false;
  }
  Design design() const { return design_of(question.parameters, question.grid, hw); }
  RunTime time(int mhz) const {
    const PartList parts = part_list(design(), question.device.family);
    return time_of(parts, hw, mhz, question, question.steps);
  }
};

TEST(Chain, HalosByHand) {
  const Two two;
  const Design design = two.design();
  ASSERT_EQ(design.shape.tiles(), 2);
  ASSERT_EQ(design.shape.halo, 1) << "in blocks of four cells";
  EXPECT_EQ(halo_bits(design), 4 * 8 * 10 * design.cell_bits());
  EXPECT_TRUE(is_for_chain(design, 2));
  EXPECT_FALSE(is_for_chain(design, 3));
}

// In tiles of three blocks each device owns one, and a halo of one block is just a neighbour's. With halos of
// two blocks and tiles of five it is not.
TEST(Chain, AHaloIsANeighbours) {
  Two two;
  two.hw.tile = 12;
  EXPECT_TRUE(is_for_chain(two.design(), two.design().shape.tiles()));
  two.hw.cascade = 4;
  two.hw.tile = 20;
  ASSERT_EQ(two.design().shape.halo, 2);
  EXPECT_FALSE(is_for_chain(two.design(), two.design().shape.tiles()));
}

// A tile's halo must lie in what its neighbours own, block for block, and each device has one tile.
TEST(Chain, EachBlockOfAHaloIsOfANeighbour) {
  int fit = 0, too_far = 0;
  for (int cascade = 1; cascade <= 6; ++cascade)
    for (int width = 8; width < 96; width += 4) {
      Two two;
      two.hw.cascade = cascade;
      two.hw.tile = width;
      if (!tile_problem(two.question.parameters, two.question.grid, two.hw).empty()) continue;
      const Design design = two.design();
      const Shape& shape = design.shape;
      bool near = true;
      for (int tile = 0; tile < shape.tiles(); ++tile)
        for (int block = shape.first_block(tile); block < shape.first_block(tile) + shape.blocks(); ++block)
          near = near && std::abs(shape.owner(block) - tile) <= 1;
      EXPECT_EQ(is_for_chain(design, shape.tiles()), near) << width << " " << cascade;
      EXPECT_FALSE(is_for_chain(design, shape.tiles() - 1)) << width << " " << cascade;
      EXPECT_FALSE(is_for_chain(design, shape.tiles() + 1)) << width << " " << cascade;
      ++(near ? fit : too_far);
    }
  EXPECT_GT(fit, 10);
  EXPECT_GT(too_far, 5);
}

TEST(Chain, PassesByHand) {
  EXPECT_EQ(linked_cycles(1000, 200, 300, 50), 1050) << "halos come while the pass lasts";
  EXPECT_EQ(linked_cycles(1000, 200, 900, 50), 1150) << "the link is the slower one";
}

// Over links that cost nothing, a pass takes what one tile takes.
TEST(Chain, WithoutLinksItIsOneTile) {
  Two two;
  two.question.device.link_gbit = 100'000;
  const Pass pass{.steps = 2};
  EXPECT_EQ(two.time(200).cycles, 4 * predicted_cycles(two.design(), two.hw, pass));
  EXPECT_EQ(two.time(200).steps, 8);
  two.question.device.link_ns = 500;  // 100 cycles
  EXPECT_EQ(two.time(200).cycles, 4 * (100 + predicted_cycles(two.design(), two.hw, pass)));
}

// The memory is slow enough to decide. Each device reads three blocks and owns one, but it writes what comes
// over the links, too. So it takes what a grid of three blocks takes.
TEST(Chain, HalosAreWritten) {
  Two two, narrow;
  for (Two* one : {&two, &narrow}) {
    one->question.device.link_gbit = 100'000;
    one->question.memory = load_memory("hbm2", "test");
    one->question.memory->mhz = 100;
    one->question.grid = {96, 128, 16};  // columns are whole bursts
  }
  two.hw.tile = 12;
  narrow.hw.tile = 0;
  narrow.question.grid.x = 12;
  narrow.question.device.chain = 1;
  const RunTime wide = two.time(200), three = narrow.time(200);
  EXPECT_GT(three.on_memory, 3 * three.cycles / 2);
  EXPECT_NEAR(static_cast<double>(wide.on_memory) / static_cast<double>(three.on_memory), 1, 0.02);
}

// Two machines write a token in each cycle from their lag on. A column of a halo goes over the link when its
// last token is written and the link is free. Both begin again when all columns have come on both sides.
std::int64_t simulated(const Two& two, int mhz, int passes) {
  const Design design = two.design();
  const Shape& shape = design.shape;
  const std::int64_t all = predicted_cycles(design, two.hw, {.steps = 2}), lag = all - shape.tokens();
  const auto column_bits = static_cast<double>(shape.column() * shape.lanes * design.cell_bits());
  const double sends = column_bits * mhz / (1000. * two.question.device.link_gbit);
  const double latency = 1e-3 * mhz * two.question.device.link_ns;
  double now = 0;
  for (int pass = 0; pass < passes; ++pass) {
    double end = now + static_cast<double>(all);
    for (const int device : {0, 1}) {
      double link = 0;
      for (std::int64_t token = shape.column() - 1; token < shape.tokens(); token += shape.column()) {
        const int block =
            shape.first_block(device) + static_cast<int>(token / shape.column() % shape.blocks());
        const int other = 1 - device;
        const bool wanted = shape.owner(block) == device && block >= shape.first_block(other) &&
                            block < shape.first_block(other) + shape.blocks();
        if (!wanted) continue;
        link = std::max(link, now + static_cast<double>(lag + token + 1)) + sends;
      }
      end = std::max(end, link + latency);
    }
    now = end;
  }
  return std::llround(now);
}

TEST(Chain, TwoDevicesAndTheirLinksAreSimulated) {
  int bound = 0;
  for (const int gbit : {1, 2, 5, 10, 40, 400})
    for (const int ns : {0, 300, 2000})
      for (const int mhz : {100, 400}) {
        Two two;
        two.question.device.link_gbit = gbit;
        two.question.device.link_ns = ns;
        const std::int64_t closed = two.time(mhz).cycles, found = simulated(two, mhz, 4);
        // The closed form takes halos to be written without a break, from the lag on.
        const Design design = two.design();
        const double plane = static_cast<double>(design.shape.plane());
        const double column = 8. * 4 * design.cell_bits() * mhz / (1000. * gbit);
        const double latency = 1e-3 * mhz * ns;
        EXPECT_LE(std::abs(static_cast<double>(closed - found)), 4 * (plane + column + latency))
            << gbit << ' ' << ns << ' ' << mhz;
        EXPECT_GE(static_cast<double>(closed), static_cast<double>(found) - 4 * (plane + column));
        bound += closed > 4 * 2 * predicted_cycles(design, two.hw, {.steps = 2}) ? 1 : 0;
      }
  EXPECT_GE(bound, 4) << "the link decides";
}

TEST(Chain, TheSweepHasATileForEachDevice) {
  Two two;
  two.question.device.chain = 4;
  Axes axes = usual_axes(two.question);
  EXPECT_EQ(axes.tiles, std::vector<int>{4});
  EXPECT_EQ(axes.overlap, std::vector<int>{0});
  axes.lanes = {1, 4};
  axes.clock_mhz = {200};
  const Swept swept = sweep(two.question, axes, {});
  ASSERT_FALSE(swept.points.empty());
  for (const Point& point : swept.points)
    EXPECT_TRUE(is_for_chain(design_of(two.question.parameters, two.question.grid, point.hw), 4));
  EXPECT_THROW(load_device("zu7ev", {"device.chain=0"}), scene::InputError);
  EXPECT_THROW(load_device("zu7ev", {"device.link=0"}), scene::InputError);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
