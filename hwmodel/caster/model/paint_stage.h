// The paint stage gives the ground's colour, and the normal of its sides (docs/picture/ground.md, sections 5
// and 8). The texture stage then reads four texels of rock.
#pragma once

#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/attach_stage.h"
#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/shade_stage.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class PaintStage final : public SurfaceStage {
 public:
  explicit PaintStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("paint", registers), registers_(registers), faults_(faults) {}

 private:
  void compute(Surface& surface) override {
    if (surface.kind != Surface::Kind::ground) return;
    if (surface.face == Face::top) {
      surface.color = registers_.ground.color;
    } else {
      surface.color = cut_color(registers_.ground, surface.position, surface.face);
      surface.normal = surface.face == Face::none ? surface.to_eye : side_normal(surface.face);
    }
    faults_.painted(registers_.ground, surface);
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
};

// Adds the texture of rock, if the ground has one.
template <class Faults = NoFaults>
class TextureStage final : public AttachStage<ClampedRequest, TexelGather::Out> {
 public:
  TextureStage(const Registers& registers, int waiting, Faults faults = {})
      : AttachStage("texture", waiting), registers_(registers), faults_(faults) {}

 private:
  int questions(const Surface& surface) const override {
    return registers_.ground.textured && surface.kind == Surface::Kind::ground && surface.face == Face::top
               ? 1
               : 0;
  }
  ClampedRequest question(const Surface& surface, int) const override {
    const int q = registers_.ground.fineness;
    ClampedRequest ask;
    ask.at = {spot_of(surface.position.x << q), {}, spot_of(surface.position.z << q)};
    ask.count = {static_cast<std::int32_t>(registers_.cells.x << q), 1,
                 static_cast<std::int32_t>(registers_.cells.z << q)};
    return ask;
  }
  void take(Surface& surface, int, const TexelGather::Out& answer) override {
    const auto between = [&](const auto& channel) {
      const auto value = [&](std::size_t n) {
        return std::int64_t{channel(answer.words[n < 2 ? n : n + 2])};
      };
      return between_columns(value, answer.request.at.x, answer.request.at.z);
    };
    surface.color = {static_cast<std::int32_t>(between([](const Texel& t) { return t.red; })),
                     static_cast<std::int32_t>(between([](const Texel& t) { return t.green; })),
                     static_cast<std::int32_t>(between([](const Texel& t) { return t.blue; }))};
    const SInt<14> x = between([](const Texel&t) { return 64 * t.bump_x; }),
                   z = between([](const Texel&t) { return 64 * t.bump_z; });
    const Vec smooth = surface.normal, bump{x, 0, z};
    surface.normal = unit_of(smooth + bump);
    faults_.textured(answer, smooth, bump, surface);
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
};

}  // namespace voxmelt::hwmodel::raycast
