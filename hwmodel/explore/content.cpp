#include "hwmodel/explore/content.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace voxmelt::hwmodel::explore {
namespace {

void sum_up(std::vector<std::int64_t>& of_blocks) {
  std::int64_t sum = 0;
  for (std::int64_t& one : of_blocks) one = std::exchange(sum, sum + one);
  of_blocks.push_back(sum);
}

// Counts for each column the bits of its lit tokens.
std::vector<std::int32_t> lit_bits(const Irradiance& field, const Shape& shape) {
  const std::size_t blocks = shape.grid_blocks();
  std::vector<std::int32_t> bits(blocks * shape.grid.z);
  for (int z = 0; z < shape.grid.z; ++z)
    for (int y = 0; y < shape.grid.y; ++y) {
      const std::uint16_t* row = field.row(y, z);
      for (int x = 0; x < shape.grid.x; x += shape.lanes) {
        const auto dark = std::count(row + x, row + std::min(x + shape.lanes, shape.grid.x), 0);
        const std::int64_t lit = std::min(shape.lanes, shape.grid.x - x) - dark;
        if (lit > 0)
          bits[z * blocks + (x / shape.lanes)] +=
              static_cast<std::int32_t>(IrradianceStream::kWordBits * (1 + mask_words(shape.lanes) + lit));
      }
    }
  return bits;
}

}  // namespace

Content content_of(const Design& design, const Irradiance* irradiance, const state::Volume* volume) {
  Content content;
  if (irradiance != nullptr) {
    content.irradiance_bits = IrradianceStream(*irradiance, design.shape).bits();
    content.lit_columns = lit_bits(*irradiance, design.shape);
    const std::size_t blocks = design.shape.grid_blocks();
    content.irradiance_before.resize(blocks);
    for (std::size_t column = 0; column < content.lit_columns.size(); ++column)
      content.irradiance_before[column % blocks] += content.lit_columns[column];
    sum_up(content.irradiance_before);
  }
  if (volume != nullptr) {
    CodedState coded{CodeLayout(design)};
    coded.store(*volume);
    content.coded_bits = coded.moved_bits();
    const int blocks = coded.layout().blocks();
    content.coded_before.resize(blocks);
    for (std::int64_t column = 0; column < coded.layout().columns(); ++column) {
      content.coded_columns.push_back(
          static_cast<std::int32_t>(CodeLayout::up(coded.bits_of(column)) / CodeLayout::kBurstBits));
      content.coded_before[column % blocks] += CodeLayout::up(coded.bits_of(column));
    }
    sum_up(content.coded_before);
  }
  return content;
}

}  // namespace voxmelt::hwmodel::explore
