// The normal of matter, from 27 levels (docs/picture.md, section 8).
#pragma once

#include <cstddef>

#include "hwmodel/caster/model/attach_stage.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/no_faults.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class NormalStage final : public AttachStage<LevelRequest, Levels> {
 public:
  explicit NormalStage(int waiting, Faults faults = {})
      : AttachStage("normal", static_cast<std::size_t>(waiting)), faults_(faults) {}

 private:
  int questions(const Surface& of) const override {
    return of.kind == Surface::Kind::matter && !of.inside ? 1 : 0;
  }
  LevelRequest question(const Surface& of, int) const override {
    return {Asker::normal, 0, of.id, 0, to_lattice(of.position)};
  }
  void take(Surface& of, int, const Levels& levels) override {
    const Slope slope = slope_of(levels.words.data(), levels.request.at);
    of.normal = slope.normal;
    faults_.inclined(slope, of);
  }
  void finish(Surface& of) override {
    if (of.inside) of.normal = of.to_eye;
  }

  [[no_unique_address]] Faults faults_;
};

}  // namespace voxmelt::hwmodel::raycast
