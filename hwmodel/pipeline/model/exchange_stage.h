// The exchange gives a cell heat from outside the volume. Radiation comes from the feed of irradiance that
// runs beside the stream. Air acts at the exposed axes. Where a scene glows, the cell glows there after it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/materials.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Exchange final : public Stage {
 public:
  explicit Exchange(const Design& design, Faults faults = {})
      : Stage(StageKind::exchange, design, 0),
        faults_(faults),
        curves_(design.parameters),
        radiation_(design.parameters.heat.radiation),
        air_(design.parameters.heat.air),
        glows_(air_ && design.parameters.heat.air_glow > 0) {
    const rule::Heat& heat = design.parameters.heat;
    glow_weight_ = weights_of(heat.air_glow);
    if (!design.of_materials()) air_weights_.push_back(weights_of(heat.air_exchange));
    for (const rule::SolidMaterial& material : design.parameters.materials)
      air_weights_.push_back(weights_of(material.air_exchange));
    if (glows_) sky_ = fourth_power(heat.air_sky);
    if (air_) air_temperature_.assign(heat.air_temperature.begin(), heat.air_temperature.end());
  }

  void feed(HeatFifo& feed) override { feed_ = &feed; }

  Wires side_bands() const override {
    return Wires()
        .add(Wire::beside_wall, design().walls_in_conduction())
        .add(Wire::touches, design().freezes());
  }
  std::vector<BufferCost> buffers() const override {
    if (!air_) return {};
    std::vector<BufferCost> buffers{{"air temperatures", shape().grid.y, 1, 16}};
    add_table(buffers, "rates of air", design(), 3 * 16);
    add_table(buffers, "curves", design(), Curves::kBits, glows_ ? 2 : 1);
    return buffers;
  }
  // Two multipliers serve the fourth power of the temperature, and one each the rates of glow and of air.
  // Where there are several materials, each of these two needs one for its temperature.
  Units units() const override {
    const int temperatures = design().of_materials() ? 1 : 0;
    return {.multipliers = (air_ ? 1 + temperatures : 0) + (glows_ ? 3 + temperatures : 0)};
  }

 private:
  friend Faults;

  void begin_step() override { dither_ = dither_of(step()); }
  bool side_input_ready() override { return !radiation_ || feed_->valid(); }

  void advance(const Cell* in, Cell* out) override {
    compute_at(0, 0);
    if (radiation_ && feed_->count() == 0)
      throw ModelError("the channel \"" + feed_->name() + "\" holds no token to take");
    const UInt<16>* irradiance = radiation_ ? feed_->get() : nullptr;
    const UInt<16> ambient = air_ ? looked_up(air_temperature_, came().y) : UInt<16>{};
    for (const int lane : each_lane()) {
      out[lane] = in[lane];
      Cell& cell = out[lane];
      cell.exposed_axes = 0;
      if (!cell.matter()) continue;
      const std::int64_t received = radiation_ ? std::int64_t{irradiance[lane]} : 0;
      const std::int64_t axes = in[lane].exposed_axes;
      cell.heat = exchanged(in[lane], received, ambient, axes);
      if (glows_ && axes > 0) cell.heat = glowed(cell, axes);
      faults_.exchanged(*this, in[lane], irradiance, ambient, lane, cell);
    }
  }

  UInt<16> exchanged(const Cell& cell, std::int64_t received, std::int64_t ambient, std::int64_t axes) const {
    std::int64_t h = cell.heat;
    if (cell.state == State::solid) h = raised(h, UInt<13>((4096 * received + dither_) >> 16));
    if (axes == 0) return h;
    const SInt<17> excess = ambient - curves_.temperature(h, cell.material);
    return raised(h, scale(excess, air_weight(cell, axes), dither_));
  }
  // Returns the heat of a cell that was exchanged with air, after it has glowed.
  UInt<16> glowed(const Cell& cell, std::int64_t axes) const {
    const SInt<17> excess = sky_ - fourth_power(curves_.temperature(cell.heat, cell.material));
    return raised(cell.heat, scale(excess, looked_up(glow_weight_, axes), dither_));
  }
  static UInt<16> fourth_power(UInt<16> temperature) {
    const UInt<16> square = temperature * temperature >> 16;
    return square * square >> 16;
  }
  std::int64_t air_weight(const Cell& cell, std::int64_t axes) const {
    return looked_up(looked_up(air_weights_, cell.material), axes);
  }
  static UInt<16> raised(std::int64_t h, std::int64_t gain) { return h + std::min(gain, kHeatMax - h); }

  static std::array<UInt<16>, 4> weights_of(std::int64_t rate) {
    std::array<UInt<16>, 4> weights;
    for (std::size_t axes = 1; axes < weights.size(); ++axes) weights[axes] = (rate * (3 + axes)) >> 2;
    return weights;
  }

  [[no_unique_address]] Faults faults_;
  HeatFifo* feed_ = nullptr;
  const Curves curves_;
  const bool radiation_, air_, glows_;
  using Weights = std::array<UInt<16>, 4>;  // index: exposed axes
  std::vector<Weights> air_weights_;        // index: material
  Weights glow_weight_;
  UInt<16> sky_;  // the fourth power of its temperature
  std::vector<UInt<16>> air_temperature_;
  UInt<16> dither_;
};

}  // namespace voxmelt::hwmodel
