// The met stage tells what a ray meets first: matter, the ground or the background. It also gives the depth,
// and the direction to the eye (docs/picture/definition.md, sections 8 and 9).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

inline bool ground_first(const GroundHit& ground, const Crossing& matter, int halvings) {
  if (!ground.found || !matter.found) return ground.found;
  const std::int64_t bias = ground.face == Face::top ? 0 : std::int64_t{1024} << halvings;
  return 8 * ground.part <= (matter.sample - 1) * 2048 + matter.part + bias;
}
inline std::int64_t depth_of(const CameraRegisters& camera, Vec position) {
  const std::int64_t z = dot((position - camera.eye) >> 8, camera.forward) >> 30;
  return UInt<16>(std::clamp<std::int64_t>((z - 256 * camera.near) >> 7, 0, 65534));
}

template <class Faults = NoFaults>
class MetStage final : public Stage {
 public:
  explicit MetStage(const Registers& registers, Faults faults = {})
      : Stage("met"), registers_(registers), faults_(faults) {}
  // Rays that met no matter come from the walk, and the others from the crossing.
  void connect(Fifo<MetToken>& missed, Fifo<MetToken>& crossed, Fifo<Surface>& out) {
    in_ = {&crossed, &missed};
    out_ = &out;
  }

 private:
  Did cycle() override {
    for (Fifo<MetToken>* in : in_) {
      if (!in->valid()) continue;
      if (!out_->ready()) return Did::blocked;
      *out_->put() = surface_of(*in->get());
      return Did::busy;
    }
    return Did::starved;
  }
  Surface surface_of(const MetToken& met) {
    Surface surface;
    surface.id = met.id;
    surface.step = met.ray.step;
    bool ground = ground_first(met.ground, met.matter, registers_.camera.halvings);
    faults_.compared(met, ground);
    if (!ground && !met.matter.found) return surface;
    surface.kind = ground ? Surface::Kind::ground : Surface::Kind::matter;
    surface.inside = ground ? met.ground.face == Face::none : met.matter.sample == 0;
    surface.face = met.ground.face;
    if (ground) surface.normal = met.ground.normal;
    surface.position = ground ? met.ground.position : met.matter.position;
    surface.depth = depth_of(registers_.camera, surface.position);
    surface.to_eye = unit_of(Vec{} - met.ray.step);
    faults_.met(surface);
    return surface;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  std::array<Fifo<MetToken>*, 2> in_{};
  Fifo<Surface>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
