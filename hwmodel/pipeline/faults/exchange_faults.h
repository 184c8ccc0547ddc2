// These faults use the irradiance of the wrong lane, or count one exposed axis too few.
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
    const UInt<16> wrong = stage.exchanged(in, received, ambient, axes);
    if (wrong == out.heat) return;
    out.heat = wrong;
    strike_lane(stage, stage.came(), lane);
  }
};

}  // namespace voxmelt::hwmodel
