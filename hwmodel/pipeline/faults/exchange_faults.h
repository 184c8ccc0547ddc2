// These faults use the irradiance of the wrong lane, count one exposed axis too few, or let a cell glow by
// the square of its temperature. Others mistake the material of a cell at air, or forget its warmth.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/exchange_stage.h"

namespace voxmelt::hwmodel {

class ExchangeFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Exchange<ExchangeFaults>;

  // `irradiance` holds the values of the whole token. It is null without radiation.
  void exchanged(const Faulty& stage, const Cell& in, const UInt<16>* irradiance, std::int64_t ambient,
                 int lane, Cell& out) {
    const auto received_by = [&](int at) {
      return irradiance != nullptr ? std::int64_t{irradiance[at % stage.lanes()]} : 0;
    };
    std::int64_t received = received_by(lane), axes = in.exposed_axes;
    if (armed(stage, Fault::irradiance_lane)) received = received_by(lane + 1);
    if (armed(stage, Fault::air_axis_missed)) axes = std::max<std::int64_t>(0, axes - 1);
    Cell cell = in;
    if (armed(stage, Fault::air_first)) cell.material = 0;
    UInt<16> wrong = stage.exchanged(cell, received, ambient, axes);
    if (axes > 0 && in.material > 0 && armed(stage, Fault::air_warmth))
      wrong = unwarmed(stage, cell, stage.exchanged(cell, received, ambient, 0), ambient);
    cell.heat = wrong;
    if (stage.glows_ && axes > 0)
      wrong = armed(stage, Fault::glow_square) ? squared(stage, cell, axes) : stage.glowed(cell, axes);
    if (wrong == out.heat) return;
    out.heat = wrong;
    strike_lane(stage, stage.came(), lane);
  }

 private:
  static UInt<16> squared(const Faulty& stage, const Cell& cell, std::int64_t axes) {
    const auto square = [](std::int64_t t) { return t * t >> 16; };
    const std::int64_t sky = stage.design().parameters.heat.air_sky;
    const std::int64_t excess = square(sky) - square(stage.curves_.temperature(cell.heat, cell.material));
    return stage.raised(cell.heat, scale(excess, looked_up(stage.glow_weight_, axes), stage.dither_));
  }
  // Returns heat h after air, from curves that were made with a warmth of 1.
  static UInt<16> unwarmed(const Faulty& stage, const Cell& cell, std::int64_t h, std::int64_t ambient) {
    rule::Parameters cold = stage.design().parameters;
    for (rule::SolidMaterial& material : cold.materials) material.warmth = 65536;
    const std::int64_t excess = ambient - Curves(cold).temperature(h, cell.material);
    return stage.raised(h, scale(excess, stage.air_weight(cell, cell.exposed_axes), stage.dither_));
  }
};

}  // namespace voxmelt::hwmodel
