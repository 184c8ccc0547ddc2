#include "hwmodel/caster/check/tile_check.h"

#include <algorithm>
#include <bit>
#include <string>
#include <utility>

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr std::size_t kBursts = kTileBytes / kBurst;

int tiles_along(int pixels) { return (pixels + kTileSide - 1) / kTileSide; }

}  // namespace

TileCheck::TileCheck(int width, int height, Tell tell)
    : tiles_x_(tiles_along(width)), tiles_y_(tiles_along(height)), tell_(std::move(tell)) {}

void TileCheck::begin_pass(const Window& window) {
  window_ = window;
  tiles_.assign(static_cast<std::size_t>(tiles_x_) * tiles_y_, {0, 0, std::vector<std::uint8_t>(kBursts)});
}

std::size_t TileCheck::index_of(std::int32_t x, std::int32_t y) const {
  const std::size_t row = y / kTileSide;
  return row * tiles_x_ + x / kTileSide;
}

void TileCheck::left(int, std::int64_t, const TileJob* job) {
  const std::size_t tile = index_of(job->x, job->y);
  if (++tiles_[tile].dealt > 1) tell(tile, "dealer", "times the tile is dealt", 1, tiles_[tile].dealt);
}

void TileCheck::ordered(const TileOrder& order) {
  tiles_[index_of(order.x, order.y)].pixels_left = std::popcount(order.pixels);
}

void TileCheck::pixel_complete(std::int32_t x, std::int32_t y) { --tiles_[index_of(x, y)].pixels_left; }

void TileCheck::written(std::int64_t tile, int burst) {
  const std::size_t i = tile;
  Tile& the_tile = tiles_[i];
  if (the_tile.pixels_left != 0) tell(i, "write", "pixels that are still to come", 0, the_tile.pixels_left);
  std::uint8_t& times = the_tile.bursts[burst];
  if (++times > 1) tell(i, "write", "times a burst is written", 1, times);
}

void TileCheck::end_pass(bool hangs) {
  const auto times = [](const Tile& tile) {
    return *std::min_element(tile.bursts.begin(), tile.bursts.end());
  };
  // While a tile is under way, those behind it may not be dealt yet.
  if (hangs && std::any_of(tiles_.begin(), tiles_.end(),
                           [&](const Tile& tile) { return tile.dealt > 0 && times(tile) == 0; }))
    return;
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    const RayId first = first_pixel(i);
    const int due = window_.meets(first.x, first.y, kTileSide) ? 1 : 0;
    if (tiles_[i].dealt != due) return tell(i, "dealer", "times the tile is dealt", due, tiles_[i].dealt);
    if (times(tiles_[i]) != due) return tell(i, "write", "times a burst is written", due, times(tiles_[i]));
  }
}

RayId TileCheck::first_pixel(std::size_t tile) const {
  const std::size_t tiles_x = tiles_x_;
  return {static_cast<std::int32_t>(tile % tiles_x) * kTileSide,
          static_cast<std::int32_t>(tile / tiles_x) * kTileSide, 0, 0};
}

void TileCheck::tell(std::size_t tile, const char* stage, const char* name, std::int64_t expected,
                     std::int64_t actual) {
  Difference difference;
  difference.stage = stage;
  difference.name = name;
  difference.x = first_pixel(tile).x;
  difference.y = first_pixel(tile).y;
  difference.expected = std::to_string(expected);
  difference.actual = std::to_string(actual);
  tell_(std::move(difference));
}

}  // namespace voxmelt::hwmodel::raycast
