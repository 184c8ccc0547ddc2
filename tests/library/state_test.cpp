// The views of a state are tested in strides, rows and words, on memory made by hand.
#include <gtest/gtest.h>
#include <voxmelt/state.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt {
namespace {

TEST(FieldView, StepsOverThePadding) {
  // There are 3 x 2 x 2 cells, rows 5 apart, slices 12 apart; 900 is padding.
  const std::vector<std::uint16_t> data{0,   1,   2,   900, 900, 10,  11,  12,  900, 900, 900, 900,
                                        100, 101, 102, 900, 900, 110, 111, 112, 900, 900, 900, 900};
  const FieldView field(data.data(), {3, 2, 2}, 5, 12);
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y) {
      ASSERT_EQ(field.row(y, z).size(), 3u);
      for (int x = 0; x < 3; ++x) {
        EXPECT_EQ(field.at(x, y, z), 100 * z + 10 * y + x);
        EXPECT_EQ(field.row(y, z)[static_cast<std::size_t>(x)], 100 * z + 10 * y + x);
      }
    }
}

TEST(NamedField, GivesTheNumberOfAnyWidth) {
  const std::vector<std::uint64_t> bits{4};
  const std::vector<std::uint8_t> bytes{0, 1, 255};
  const std::vector<std::uint16_t> words{0, 1, 65535};
  const Grid grid{3, 1, 1};
  EXPECT_EQ((NamedField{"a", "", MaskView(bits.data(), grid)}.at(2, 0, 0)), 1u);
  EXPECT_EQ((NamedField{"a", "", MaskView(bits.data(), grid)}.at(1, 0, 0)), 0u);
  EXPECT_EQ((NamedField{"b", "", ByteView(bytes.data(), grid, 3, 3)}.at(2, 0, 0)), 255u);
  EXPECT_EQ((NamedField{"c", "", FieldView(words.data(), grid, 3, 3)}.at(2, 0, 0)), 65535u);
}

TEST(MaskView, HasSixtyFourCellsAWord) {
  // There are 70 x 2 x 2 cells, two words a row. The cells (0, 0, 0), (69, 1, 0), (64, 0, 1) and (3, 1, 1)
  // are set.
  const std::vector<std::uint64_t> data{1, 0, 0, 32, 0, 1, 8, 0};
  const MaskView mask(data.data(), {70, 2, 2});
  EXPECT_EQ(mask.count(), 4u);
  std::vector<int> set;
  for (int z = 0; z < 2; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 70; ++x)
        if (mask.test(x, y, z)) set.push_back(1000 * z + 100 * y + x);
  EXPECT_EQ(set, (std::vector<int>{0, 169, 1064, 1103}));
  EXPECT_EQ(mask.row(1, 0)[1], 32u);
}

}  // namespace
}  // namespace voxmelt
