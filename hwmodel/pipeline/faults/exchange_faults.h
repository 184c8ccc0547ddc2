// These faults use the irradiance of the wrong lane, count one exposed axis too few, or let a cell glow by
// the square of its temperature.
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
    UInt<16> wrong = stage.exchanged(in, received, ambient, axes);
    if (stage.glows_ && axes > 0)
      wrong = armed(stage, Fault::glow_square) ? squared(stage, wrong, axes) : stage.glowed(wrong, axes);
    if (wrong == out.heat) return;
    out.heat = wrong;
    strike_lane(stage, stage.came(), lane);
  }

 private:
  static UInt<16> squared(const Faulty& stage, std::int64_t h, std::int64_t axes) {
    const auto square = [](std::int64_t t) { return t * t >> 16; };
    const std::int64_t sky = stage.design().parameters.heat.air_sky;
    const std::int64_t excess = square(sky) - square(temperature_of(h, stage.material_));
    return stage.raised(h, scale(excess, looked_up(stage.glow_weight_, axes), stage.dither_));
  }
};

}  // namespace voxmelt::hwmodel
