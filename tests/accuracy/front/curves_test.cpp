// Samples are taken of volumes whose numbers are known, and errors of curves are computed by hand.
#include "accuracy/front/curves.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "tests/kernel/worlds.h"

namespace voxmelt::accuracy::front {
namespace {

using namespace worlds;

// Two cells of matter lie on a grid of half the scene's: a full solid one at (0, 1, 1), half a liquid one at
// (3, 2, 1). The floor's face is at y = 1 and the axis at (2, 1) of the scene's cells. A grid cell is two of
// those.
Volume two_cells() {
  Volume v(Grid{4, 4, 4});
  put_inert(v, 0, 0, 0);
  put_solid(v, 0, 1, 1, kOne, 16384);
  put(v, 3, 2, 1, kOne / 2, 0, 32768);
  return v;
}

TEST(Curves, ASampleByHand) {
  const Scale scale{.grid = 0.5, .floor = 1, .axis_x = 2, .axis_z = 1};
  const Sample sample = sample_of(two_cells(), scale);
  EXPECT_DOUBLE_EQ(sample.liquid, 0.5 * 8);
  EXPECT_DOUBLE_EQ(sample.heat, (1 * 0.25 + 0.5 * 0.5) * 8);
  // The centres are 0.5 and 1.5 cells of the grid above the floor, twice as much in the scene's.
  EXPECT_DOUBLE_EQ(sample.height, (1 * 1. + 0.5 * 3.) / 1.5);
  // In x they are 1 and 7 in the scene's cells, from 2: -1 and 5. In z they are 3 from 1: 2.
  EXPECT_DOUBLE_EQ(sample.radius, std::sqrt((1 * (1. + 4) + 0.5 * (25. + 4)) / 1.5));
}

TEST(Curves, TheTwinIsSampledAlike) {
  const Scale scale{.grid = 0.5, .floor = 1, .axis_x = 2, .axis_z = 1};
  const Sample volume = sample_of(two_cells(), scale);
  for (const Arithmetic arithmetic : all_arithmetics()) {
    const std::unique_ptr<Twin> twin = make_twin(arithmetic, Parameters{}, two_cells());
    const Sample sample = sample_of(*twin, scale);
    EXPECT_DOUBLE_EQ(sample.liquid, volume.liquid) << name_of(arithmetic);
    EXPECT_DOUBLE_EQ(sample.heat, volume.heat) << name_of(arithmetic);
    EXPECT_DOUBLE_EQ(sample.height, volume.height) << name_of(arithmetic);
    EXPECT_DOUBLE_EQ(sample.radius, volume.radius) << name_of(arithmetic);
  }
}

TEST(Curves, ErrorsAreMeansOverTheMeanOfTheReference) {
  const Curves found{{1, 10, 2, 4}, {3, 10, 2, 5}}, reference{{2, 10, 2, 4}, {2, 10, 2, 4}};
  const Errors e = errors(found, reference);
  EXPECT_DOUBLE_EQ(e.liquid, 0.5);  // one too little and one too much do not cancel
  EXPECT_EQ(e.heat, 0);
  EXPECT_EQ(e.height, 0);
  EXPECT_DOUBLE_EQ(e.radius, 0.125);
  EXPECT_DOUBLE_EQ(e.largest(), 0.5);
  EXPECT_DOUBLE_EQ(errors(reference, found).radius, 1. / 9);
}

TEST(Curves, NothingBesideNothingIsNoError) {
  const Curves nothing(3);
  EXPECT_EQ(errors(nothing, nothing).largest(), 0);
  EXPECT_THROW(errors(nothing, Curves(2)), std::invalid_argument);
}

}  // namespace
}  // namespace voxmelt::accuracy::front
