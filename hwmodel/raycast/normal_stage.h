// The normal of matter, from 27 levels (docs/picture.md, section 8).
#pragma once

#include <cstddef>

#include "hwmodel/raycast/attach_stage.h"
#include "hwmodel/raycast/field.h"

namespace voxmelt::hwmodel::raycast {

class NormalStage final : public AttachStage<LevelRequest, Levels> {
 public:
  explicit NormalStage(int waiting) : AttachStage("normal", static_cast<std::size_t>(waiting)) {}

 private:
  int questions(const Surface& of) const override {
    return of.kind == Surface::Kind::matter && !of.inside ? 1 : 0;
  }
  LevelRequest question(const Surface& of, int) const override {
    return {Asker::normal, 0, of.id, 0, to_lattice(of.position)};
  }
  void take(Surface& of, int, const Levels& levels) override {
    of.normal = slope_of(levels.words.data(), levels.request.at).normal;
  }
  void finish(Surface& of) override {
    if (of.inside) of.normal = of.to_eye;
  }
};

}  // namespace voxmelt::hwmodel::raycast
