// The tiles of a pass must be dealt once, drawn whole, and written once. This checks the dealer, the tile
// buffers and the write-back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hwmodel/caster/check/difference.h"
#include "hwmodel/caster/model/pipe.h"
#include "hwmodel/caster/model/registers.h"

namespace voxmelt::hwmodel::raycast {

class TileCheck final : public FifoWatcher<TileJob> {
 public:
  using Tell = std::function<void(Difference)>;
  TileCheck(int width, int height, Tell tell);

  void begin_pass(const Window& window);
  // A job is checked only when it leaves, because a pipe gets what the dealer gave.
  void entered(int, std::int64_t, const TileJob*) override {}
  void left(int channel, std::int64_t ordinal, const TileJob* job) override;
  void ordered(const TileOrder& order);
  void pixel_complete(std::int32_t x, std::int32_t y);
  void written(std::int64_t tile, int burst);
  // Looks for what never came, after the last cycle.
  void end_pass(bool hangs);

 private:
  struct Tile {
    int dealt = 0, pixels_left = 0;
    std::vector<std::uint8_t> bursts;  // how often each was written
  };
  std::size_t index_of(std::int32_t x, std::int32_t y) const;
  RayId first_pixel(std::size_t tile) const;
  void tell(std::size_t tile, const char* stage, const char* name, std::int64_t expected,
            std::int64_t actual);

  int tiles_x_, tiles_y_;
  Tell tell_;
  Window window_;
  std::vector<Tile> tiles_;
};

}  // namespace voxmelt::hwmodel::raycast
