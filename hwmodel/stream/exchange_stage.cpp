// What a cell takes from outside the volume: radiation, from the feed of irradiance that runs beside the
// stream, and the air at its exposed axes.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

class Exchange final : public FedStage {
 public:
  explicit Exchange(const Design& design)
      : FedStage("exchange", "heat", design, 0),
        material_(design.parameters.material),
        radiation_(design.parameters.heat.radiation),
        air_(design.parameters.heat.air) {
    const rule::Heat& heat = design.parameters.heat;
    for (std::size_t axes = 0; axes < air_weight_.size(); ++axes)
      air_weight_[axes] = (heat.air_exchange * kAxisWeight[axes]) >> 12;
    if (air_) air_temperature_.assign(heat.air_temperature.begin(), heat.air_temperature.end());
  }

  int output_bits() const override { return design().cell_bits() + (design().walls_in_conduction() ? 1 : 0); }
  std::vector<BufferCost> buffers() const override {
    if (!air_) return {};
    return {{"air temperatures", shape().grid.y, 1, 16}};
  }
  Units units() const override { return {.multipliers = air_ ? 1 : 0}; }

 private:
  void begin_step() override { dither_ = dither_of(step()); }
  bool side_input_ready() override { return !radiation_ || feed_->valid(); }

  void advance(const Cell* in, Cell* out) override {
    const UInt<16>* irradiance = radiation_ ? feed_->get() : nullptr;
    const UInt<16> ambient = air_ ? air_temperature_[static_cast<std::size_t>(came().y)] : UInt<16>{};
    for (int lane = 0; lane < lanes(); ++lane) {
      out[lane] = in[lane];
      Cell& cell = out[lane];
      cell.exposed_axes = 0;
      if (!cell.matter()) continue;
      const std::int64_t received = radiation_ ? std::int64_t{irradiance[lane]} : 0;
      const std::int64_t axes = in[lane].exposed_axes;
      cell.heat = exchanged(in[lane], received, ambient, axes);
      if (armed(Fault::irradiance_lane) && radiation_) [[unlikely]]
        use_wrong(cell, lane, exchanged(in[lane], irradiance[(lane + 1) % lanes()], ambient, axes));
      if (armed(Fault::air_axis_missed) && axes > 0) [[unlikely]]
        use_wrong(cell, lane, exchanged(in[lane], received, ambient, axes - 1));
    }
  }

  UInt<16> exchanged(const Cell& cell, std::int64_t received, std::int64_t ambient, std::int64_t axes) const {
    std::int64_t h = cell.heat;
    if (cell.state == State::solid) h = warmed(h, UInt<13>((4096 * received + dither_) >> 16));
    if (axes == 0) return h;
    const SInt<17> excess = ambient - temperature_of(h, material_);
    return warmed(h, scale(excess, air_weight_[static_cast<std::size_t>(axes)], dither_));
  }
  static UInt<16> warmed(std::int64_t h, std::int64_t gain) { return h + std::min(gain, kHeatMax - h); }

  void use_wrong(Cell& cell, int lane, UInt<16> wrong) {
    if (wrong == cell.heat) return;
    cell.heat = wrong;
    strike(came().x + lane, came().y, came().z);
  }

  const rule::Material material_;
  const bool radiation_, air_;
  std::array<UInt<16>, 4> air_weight_;  // by exposed axes
  std::vector<UInt<16>> air_temperature_;
  UInt<16> dither_;
};

}  // namespace

std::unique_ptr<FedStage> make_exchange(const Design& design) { return std::make_unique<Exchange>(design); }

}  // namespace voxmelt::hwmodel
