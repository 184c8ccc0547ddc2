// The order in which tiles are dealt is that by hand, and each tile is dealt once.
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "hwmodel/caster/model/tile_order.h"

namespace voxmelt::hwmodel::raycast {
namespace {

std::string order_of(int tiles_x, int tiles_y, int bands) {
  const TileTurns turns(tiles_x, tiles_y, bands);
  std::string text;
  for (int i = 0; i < turns.count(); ++i) {
    const TileTurns::Tile tile = turns.at(i);
    if (tile.any) text += std::to_string(tile.x) + std::to_string(tile.y) + " ";
  }
  return text;
}

TEST(RaycastTiles, OneBandGoesRowByRow) { EXPECT_EQ(order_of(3, 2, 1), "00 10 20 01 11 21 "); }

// Two bands each have four tiles. The second band begins in the middle of its row. The two take turns in
// being the first one.
TEST(RaycastTiles, TwoBandsByHand) { EXPECT_EQ(order_of(4, 2, 2), "00 21 31 10 20 01 11 30 "); }

// Three rows are cut into two bands, and the second band has one row.
TEST(RaycastTiles, TheLastBandMayBeLower) { EXPECT_EQ(order_of(2, 3, 2), "00 12 02 10 01 11 "); }

TEST(RaycastTiles, EachTileIsDealtOnce) {
  for (const int x : {1, 2, 5, 32})
    for (const int y : {1, 3, 7, 16})
      for (const int bands : {1, 2, 3, 4, 9, 64}) {
        const TileTurns turns(x, y, bands);
        std::vector<int> dealt(static_cast<std::size_t>(x * y), 0);
        for (int i = 0; i < turns.count(); ++i) {
          const TileTurns::Tile tile = turns.at(i);
          if (tile.any) ++dealt.at(static_cast<std::size_t>(tile.y * x + tile.x));
        }
        for (const int count : dealt) ASSERT_EQ(count, 1) << x << " " << y << " " << bands;
      }
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
