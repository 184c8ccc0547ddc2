// These stages fetch what matter is made of at the crossing, and the light in front of a surface
// (docs/picture/light.md, sections 3 and 5).
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/caster/model/attach_stage.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/shade.h"

namespace voxmelt::hwmodel::raycast {

// Matter is read twice if the scene has obstacles: they are looked for half a cell outside. On a way in clear
// matter all is read at its place. A way has no normal, so the light is read there, too.
template <class Faults = NoFaults>
class MatterStage final : public AttachStage<MatterRequest, MatterGather::Out> {
 public:
  MatterStage(const Registers& registers, int waiting, Faults faults = {})
      : AttachStage("matter", waiting), registers_(registers), faults_(faults) {}

 private:
  int questions(const Surface& surface) const override {
    if (surface.kind == Surface::Kind::way) return 1;
    if (surface.kind != Surface::Kind::matter) return 0;
    return registers_.look.obstacles ? 2 : 1;
  }
  MatterRequest question(const Surface& surface, int which) const override {
    const Vec p = which == 0 ? surface.position : surface.position + surface.normal * 32;
    const auto among = [](std::int64_t at, std::int64_t cells) {
      return std::clamp(at, kCell / 2, cells * kCell - kCell / 2);
    };
    const Vec& cells = registers_.cells;
    return {spots_of({among(p.x, cells.x), among(p.y, cells.y), among(p.z, cells.z)}), surface.id};
  }
  void take(Surface& surface, int which, const MatterGather::Out& answer) override {
    MatterBytes bytes = matter_of(answer.words.data(), answer.request.at);
    faults_.known(which, surface, bytes);
    if (which == 0)
      surface.matter = bytes;
    else
      surface.matter.obstacle = bytes.obstacle;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class LightStage final : public AttachStage<ClampedRequest, LightGather::Out> {
 public:
  LightStage(const Registers& registers, int waiting, Faults faults = {})
      : AttachStage("light", waiting), registers_(registers), faults_(faults) {}

 private:
  int questions(const Surface& surface) const override {
    return surface.kind == Surface::Kind::background ? 0 : 1;
  }
  ClampedRequest question(const Surface& surface, int) const override {
    const int s = registers_.light_shift;
    const Vec q = surface.position + surface.normal * (std::int64_t{1} << (6 + s));
    ClampedRequest ask;
    ask.at = spots_of(q >> s);
    const Vec& cells = registers_.light_cells;
    ask.count = {static_cast<std::int32_t>(cells.x), static_cast<std::int32_t>(cells.y),
                 static_cast<std::int32_t>(cells.z)};
    return ask;
  }
  void take(Surface& surface, int, const LightGather::Out& answer) override {
    surface.light = light_of(answer.words.data(), answer.request.at, registers_.look.glow);
    faults_.lighted(answer, registers_.look.glow, surface);
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
};

}  // namespace voxmelt::hwmodel::raycast
