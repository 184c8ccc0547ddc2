#include "hwmodel/pipeline/faults/irradiance_fault.h"

#include <bit>
#include <string>

namespace voxmelt::hwmodel {

IrradianceFault::IrradianceFault(FaultPlan& plan, Pipeline& pipeline) : plan_(plan), pipeline_(pipeline) {
  if (is_of_feeds(plan.fault())) pipeline.plant(this);
}

void IrradianceFault::counted(int t, std::int64_t pass, const Place& place, std::uint32_t mask,
                              std::int64_t& dark) {
  const std::uint32_t step = step_of(t, pass);
  if (!plan_.armed(Fault::feed_early, step) || dark == 0 || mask == 0) return;
  --dark;
  const Shape& shape = pipeline_.design().shape;
  strike(step, place_of(shape, place.ordinal + dark, passes_[pass].tile), std::countr_zero(mask));
}

void IrradianceFault::masked(int t, std::int64_t pass, const Place& place, std::uint32_t& mask,
                             bool& last_lost) {
  const std::uint32_t step = step_of(t, pass);
  const int lanes = pipeline_.design().shape.lanes;
  if (plan_.armed(Fault::feed_mask, step)) {
    const std::uint32_t right = mask, top = right >> (lanes - 1) & 1;
    const std::uint32_t wrong = lanes == 1 ? right : (right << 1 | top) & (0xFFFFFFFFu >> (32 - lanes));
    if (wrong == right) return;
    mask = wrong;
    strike(step, place, std::countr_zero(wrong ^ right));
  } else if (plan_.armed(Fault::feed_word_lost, step) && mask != 0) {
    last_lost = true;
    strike(step, place, std::bit_width(mask) - 1);
  }
}

void IrradianceFault::told(std::int64_t pass, const Place& place, std::uint32_t before, std::uint32_t& mask) {
  const std::uint32_t step = step_of(0, pass);
  if (!plan_.armed(Fault::feed_falls_stale, step) || before == mask) return;
  const int lane = std::countr_zero(before ^ mask);
  mask = before;
  strike(step, place, lane, StageKind::fall_feed);
}

void IrradianceFault::strike(std::uint32_t step, const Place& place, int lane, StageKind feed) {
  plan_.strike({std::string(name_of(feed)), step, place.x + lane, place.y, place.z});
}

}  // namespace voxmelt::hwmodel
