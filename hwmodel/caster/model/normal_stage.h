// The normal of matter is computed from 27 levels (docs/picture/definition.md, section 8).
#pragma once

#include "hwmodel/caster/model/attach_stage.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/no_faults.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class NormalStage final : public AttachStage<LevelRequest, Levels> {
 public:
  explicit NormalStage(int waiting, Faults faults = {}) : AttachStage("normal", waiting), faults_(faults) {}

 private:
  int questions(const Surface& surface) const override {
    return surface.kind == Surface::Kind::matter && !surface.inside ? 1 : 0;
  }
  LevelRequest question(const Surface& surface, int) const override {
    return {Asker::normal, 0, surface.id, 0, to_lattice(surface.position)};
  }
  void take(Surface& surface, int, const Levels& levels) override {
    const Slope slope = slope_of(levels.words.data(), levels.request.at);
    surface.normal = slope.normal;
    faults_.inclined(slope, surface);
  }
  void finish(Surface& surface) override {
    if (surface.inside) surface.normal = surface.to_eye;
  }

  [[no_unique_address]] Faults faults_;
};

}  // namespace voxmelt::hwmodel::raycast
