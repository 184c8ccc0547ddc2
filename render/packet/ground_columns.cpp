#include "render/packet/ground_columns.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::render {

std::vector<std::int32_t> GroundColumns::around(const ColumnHeights& heights) const {
  const picture::Vector cells = shape_.cells;
  std::vector<std::int32_t> all;
  all.reserve((cells.x + 3) * (cells.z + 3));
  for (std::int64_t z = -kGroundBefore; z < cells.z + kGroundBehind; ++z)
    for (std::int64_t x = -kGroundBefore; x < cells.x + kGroundBehind; ++x)
      all.push_back(heights[std::clamp<std::int64_t>(z, 0, cells.z - 1) * cells.x +
                            std::clamp<std::int64_t>(x, 0, cells.x - 1)]);
  return all;
}

void GroundColumns::update(const GroundMap& map) {
  shape_ = {};
  if (map.empty()) return;
  shape_.any = true;
  shape_.cells = map.cells();
  shape_.row = static_cast<std::int32_t>(map.cells().x + kGroundBefore + kGroundBehind);
  shape_.highest = map.highest();
  shape_.color[0] = static_cast<std::int32_t>(map.color().x);
  shape_.color[1] = static_cast<std::int32_t>(map.color().y);
  shape_.color[2] = static_cast<std::int32_t>(map.color().z);
  shape_.fineness = map.fineness();
  bare_ = around(map.bare());
  shape_.flat =
      std::all_of(bare_.begin(), bare_.end(), [&](std::int32_t height) { return height == bare_[0]; });
  texels_.clear();
  for (const picture::Texel& texel : map.texels()) {
    texels_.push_back(texel.red | std::uint32_t{texel.green} << 16);
    texels_.push_back(texel.blue | std::uint32_t{static_cast<std::uint8_t>(texel.bump_x)} << 16 |
                      std::uint32_t{static_cast<std::uint8_t>(texel.bump_z)} << 24);
  }
  bands_.assign(map.bands().begin(), map.bands().end());
  bends_ = map.bends();
  lower(map);
}

void GroundColumns::lower(const GroundMap& map) {
  if (map.empty()) return;
  shape_.slopes = map.slopes();
  drawn_ = around(map.drawn());
}

GroundData GroundColumns::data(const GroundMap& map) const {
  GroundData data = shape_;
  if (!data.any) return data;
  const std::int64_t first = kGroundBefore * data.row + kGroundBefore;
  data.map = &map;
  data.drawn = drawn_.data() + first;
  data.bare = bare_.data() + first;
  data.texels = texels_.empty() ? nullptr : texels_.data();
  data.bands = bands_.empty() ? nullptr : bands_.data();
  data.band_count = static_cast<std::int32_t>(bands_.size());
  for (std::size_t side = 0; side < bends_.size(); ++side) data.bends[side] = bends_[side].data();
  return data;
}

}  // namespace voxmelt::render
