// Ray set-up turns tiles into the rays of their pixels, one a cycle.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// Tiles take turns, so that rays that need many samples mix with those that need none.
template <class Faults = NoFaults>
class SetupStage final : public Stage {
 public:
  SetupStage(const Registers& registers, int tiles, Faults faults = {})
      : Stage("set-up"), registers_(registers), faults_(faults), open_(tiles) {}
  void connect(Fifo<TileOrder>& in, Fifo<RayToken>& out) {
    in_ = &in;
    out_ = &out;
  }

 private:
  struct Open {
    TileOrder tile;
    std::uint64_t left = 0;  // pixels, a bit each; 0 if there is no tile
    int sample = 0;
  };

  Did cycle() override {
    open_next();
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const std::size_t at = (turn_ + i) % open_.size();
      if (open_[at].left == 0) continue;
      if (!out_->ready()) return Did::blocked;
      make_ray(open_[at]);
      turn_ = (at + 1) % open_.size();
      return Did::busy;
    }
    return Did::starved;
  }

  void open_next() {
    if (!in_->valid()) return;
    const auto place =
        std::find_if(open_.begin(), open_.end(), [](const Open& open_parts) { return open_parts.left == 0; });
    if (place == open_.end()) return;
    const TileOrder& tile = *in_->get();
    *place = {tile, tile.pixels, 0};
  }
  void make_ray(Open& open_parts) {
    const TileOrder& tile = open_parts.tile;
    const int at = std::countr_zero(open_parts.left);
    const std::int32_t x = tile.x + at % kTileSide, y = tile.y + at / kTileSide;
    const Sub sub = sub_of(tile.samples, open_parts.sample);
    RayToken& token = *out_->put();
    token.id = {x, y, open_parts.sample, tile.buffer};
    token.ray = ray_of(registers_.camera, 64 * std::int64_t{x} + sub.across, 64 * std::int64_t{y} + sub.down);
    faults_.set_up(registers_.camera, tile.samples, token);
    if (++open_parts.sample < tile.samples) return;
    open_parts.sample = 0;
    open_parts.left &= open_parts.left - 1;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  std::vector<Open> open_;
  std::size_t turn_ = 0;
  Fifo<TileOrder>* in_ = nullptr;
  Fifo<RayToken>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
