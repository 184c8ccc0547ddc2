// The ground that a ray meets and its paint are told to a watcher (render/rule/watch.h).
#pragma once

#include <cstdint>
#include <type_traits>

#include "render/ground/ground_map.h"
#include "render/rule/watch.h"

namespace voxmelt::render {

// Returns a table of columns in the form that the rule reads.
inline auto columns_of(const GroundMap& map, const ColumnHeights& heights) {
  return [&heights, row = map.cells().x](std::int64_t x, std::int64_t z) { return heights[z * row + x]; };
}

// Returns the result of GroundMap::find. A watcher sees every part that the page looks at, and no sample is
// left out.
template <class Watch>
picture::GroundCrossing find_ground(const GroundMap& map, const picture::Ray& ray, Watch watch) {
  if constexpr (std::is_same_v<Watch, picture::Silent>) {
    return map.find(ray);
  } else {
    if (map.empty()) return {};
    const auto columns = columns_of(map, map.drawn());
    const picture::Watched heights{columns, watch, picture::Stage::ground};
    const auto none_left_out = [](std::int64_t) { return std::int64_t{0}; };
    return picture::first_ground(heights, map.cells(), map.highest(), ray, none_left_out, watch);
  }
}

// Returns the colour of sides and underside, and around a camera in the ground.
template <class Watch>
picture::Vector cut_color(const GroundMap& map, const picture::GroundCrossing& crossing, Watch watch) {
  using picture::Face;
  std::int32_t band = 0;
  if (!map.bands().empty() && crossing.face != Face::under && crossing.face != Face::none) {
    const std::int64_t along = crossing.face == Face::low_x || crossing.face == Face::high_x
                                   ? crossing.position.z
                                   : crossing.position.x;
    const auto& bends = map.bends()[side_of(crossing.face)];
    const auto entry = [&](const auto& table, std::int64_t position) {
      const auto at = [&](std::int64_t i, std::int64_t) { return std::int32_t{table[i]}; };
      return picture::bilinear(at, table.size(), 1, picture::place_of(position), {});
    };
    const std::int32_t bend = entry(bends, along);
    band = entry(map.bands(), (crossing.position.y + bend) << picture::kBandFineness);
    watch(picture::Stage::texture, "bend", bend);
    watch(picture::Stage::texture, "band", band);
  }
  return picture::cut_color(map.color(), band);
}

// Returns the colour of the top, and its normal with the relief of rock.
template <class Watch>
GroundMap::Paint top_paint(const GroundMap& map, picture::Vector position, picture::Vector normal,
                           Watch watch) {
  if (map.texels().empty()) return {map.color(), normal};
  const int fineness = map.fineness();
  const std::int64_t columns = map.cells().x << fineness, rows = map.cells().z << fineness;
  const picture::Place x = picture::place_of(position.x << fineness),
                       z = picture::place_of(position.z << fineness);
  const auto texel = [&](std::int64_t i, std::int64_t j) { return map.texels()[j * columns + i]; };
  const auto channel = [&](const auto& texels, const auto& one) -> std::int64_t {
    return picture::bilinear(
        [&](std::int64_t i, std::int64_t j) -> std::int32_t { return one(texels(i, j)); }, columns, rows, x,
        z);
  };
  // The five channels come with the same four texels, so a watcher sees these once.
  const picture::Watched told{texel, watch, picture::Stage::texture};
  constexpr std::int32_t kToNormal = 1 << (picture::kNormalBits - picture::kBumpBits);
  const std::int64_t red = channel(told, [](const picture::Texel& t) { return t.red; });
  const std::int64_t green = channel(texel, [](const picture::Texel& t) { return t.green; });
  const std::int64_t blue = channel(texel, [](const picture::Texel& t) { return t.blue; });
  const std::int64_t bump_x = channel(texel, [](const picture::Texel& t) { return t.bump_x * kToNormal; });
  const std::int64_t bump_z = channel(texel, [](const picture::Texel& t) { return t.bump_z * kToNormal; });
  return {{red, green, blue}, picture::roughened(normal, bump_x, bump_z, watch)};
}

// Returns the paint, and tells it to a watcher. GroundMap::paint is this with a silent one.
template <class Watch>
GroundMap::Paint told_paint(const GroundMap& map, const picture::GroundCrossing& crossing, Watch watch) {
  const auto columns = columns_of(map, map.bare());
  const picture::Watched heights{columns, watch, picture::Stage::paint};
  const picture::Vector normal =
      picture::ground_normal(heights, map.cells(), crossing.position, crossing.face, watch);
  const GroundMap::Paint paint = crossing.face == picture::Face::top
                                     ? top_paint(map, crossing.position, normal, watch)
                                     : GroundMap::Paint{cut_color(map, crossing, watch), normal};
  watch(picture::Stage::paint, "color", paint.color);
  watch(picture::Stage::paint, "normal", paint.normal);
  return paint;
}

template <class Watch>
GroundMap::Paint paint_ground(const GroundMap& map, const picture::GroundCrossing& crossing, Watch watch) {
  if constexpr (std::is_same_v<Watch, picture::Silent>)
    return map.paint(crossing);
  else
    return told_paint(map, crossing, watch);
}

}  // namespace voxmelt::render
