// Ray set-up: a tile to the rays of its pixels, one a cycle.
#pragma once

#include <bit>
#include <cstdint>

#include "hwmodel/channel/fifo.h"
#include "hwmodel/raycast/no_faults.h"
#include "hwmodel/raycast/pass_counts.h"
#include "hwmodel/raycast/registers.h"
#include "hwmodel/raycast/stage.h"
#include "hwmodel/raycast/tokens.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class SetupStage final : public Stage {
 public:
  explicit SetupStage(const Registers& registers, Faults faults = {})
      : Stage("set-up"), registers_(registers), faults_(faults) {}
  void connect(Fifo<TileOrder>& in, Fifo<RayToken>& out) { in_ = &in, out_ = &out; }
  void count(PipeCounts* counts) { counts_ = counts; }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    const TileOrder& tile = *in_->oldest();
    if (!open_) {
      open_ = true;
      left_ = tile.pixels;
      sample_ = 0;
    }
    const int at = std::countr_zero(left_);
    const std::int32_t x = tile.x + at % kTileSide, y = tile.y + at / kTileSide;
    const Sub sub = sub_of(tile.samples, sample_);
    RayToken& token = *out_->put();
    token.id = {x, y, static_cast<std::int16_t>(sample_), static_cast<std::int16_t>(tile.buffer)};
    if (counts_ != nullptr) token.id.number = counts_->begin_ray();
    token.ray = ray_of(registers_.camera, 64 * std::int64_t{x} + sub.across, 64 * std::int64_t{y} + sub.down);
    faults_.set_up(registers_.camera, tile.samples, token);
    if (++sample_ == tile.samples) {
      sample_ = 0;
      left_ &= left_ - 1;
      if (left_ == 0) {
        in_->get();
        open_ = false;
      }
    }
    return Did::busy;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  PipeCounts* counts_ = nullptr;
  Fifo<TileOrder>* in_ = nullptr;
  Fifo<RayToken>* out_ = nullptr;
  bool open_ = false;
  std::uint64_t left_ = 0;
  int sample_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
