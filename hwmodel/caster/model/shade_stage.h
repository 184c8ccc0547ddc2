// Shading takes four stages (docs/picture/light.md, sections 6 and 7): what arrives and what matter is, what
// it mirrors, the sum, and the pressing of bright light. Each of them takes a surface a cycle.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "hwmodel/caster/model/clear.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/shade.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// Takes one surface in, and gives one out.
class SurfaceStage : public Stage {
 public:
  SurfaceStage(std::string name, const Registers& registers)
      : Stage(std::move(name)), registers_(registers) {}
  void connect(Fifo<Surface>& in, Fifo<Surface>& out) {
    in_ = &in;
    out_ = &out;
  }

 protected:
  virtual void compute(Surface& surface) = 0;
  const LookRegisters& look() const { return registers_.look; }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    Surface& surface = *out_->put();
    surface = *in_->get();
    compute(surface);
    return Did::busy;
  }

  const Registers& registers_;
  Fifo<Surface>* in_ = nullptr;
  Fifo<Surface>* out_ = nullptr;
};

template <class Faults = NoFaults>
class ArrivingStage final : public SurfaceStage {
 public:
  explicit ArrivingStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("arriving", registers), faults_(faults) {}

 private:
  void compute(Surface& surface) override {
    if (surface.kind == Surface::Kind::background) return;
    if (surface.kind == Surface::Kind::way) {
      surface.mixture = mixture_of(look(), surface.matter);
      surface.arriving.light = inner_light(look(), surface.light);
      return;
    }
    const bool matter = surface.kind == Surface::Kind::matter;
    if (matter) surface.mixture = mixture_of(look(), surface.matter);
    surface.arriving =
        arriving_of(look(), surface.normal, surface.light, look().glow && (!matter || surface.mixture.w > 0));
    faults_.arrived(look(), surface);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class MirrorStage final : public SurfaceStage {
 public:
  explicit MirrorStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("mirror", registers), faults_(faults) {}

 private:
  void compute(Surface& surface) override {
    if (surface.kind != Surface::Kind::matter) return;
    Vec normal = surface.normal;
    Arriving arriving = surface.arriving;
    if (surface.clear.leaves) {  // the eye sees the surface from within
      normal = Vec{} - normal;
      arriving.facing = SInt<16>(cosine(normal, look().to_light));
    }
    surface.mirrored = mirrored_of(look(), normal, surface.to_eye, surface.light, arriving, surface.mixture);
    faults_.mirrored(look(), surface);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class ColourStage final : public SurfaceStage {
 public:
  explicit ColourStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("colour", registers), faults_(faults) {}

 private:
  void compute(Surface& surface) override {
    if (surface.kind == Surface::Kind::background) {
      surface.sum = look().background;
    } else if (surface.kind == Surface::Kind::ground) {
      surface.sum = scattered_color(surface.arriving, surface.color);
    } else if (look().clear) {
      surface.sum = scattered_color(surface.arriving, surface.mixture.material.diffuse);
      if (surface.kind == Surface::Kind::matter)
        surface.clear.gleam = gleam_of(surface.mixture, surface.mirrored);
    } else {
      surface.sum = matter_color(surface.arriving, surface.mixture, surface.mirrored);
    }
    faults_.coloured(surface);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class PressStage final : public Stage {
 public:
  explicit PressStage(const Registers& registers, Faults faults = {})
      : Stage("press"), registers_(registers), faults_(faults) {}
  void connect(Fifo<Surface>& in, Fifo<PressedToken>& out) {
    in_ = &in;
    out_ = &out;
  }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    const Surface& surface = *in_->get();
    PressedToken& token = *out_->put();
    token = {surface.id, surface.sum};
    if (surface.kind != Surface::Kind::background)
      for (std::int32_t& c : token.pressed) c = registers_.look.tone[std::clamp(c, 0, 12287)];
    faults_.pressed(registers_.look, surface, token);
    return Did::busy;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  Fifo<Surface>* in_ = nullptr;
  Fifo<PressedToken>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
