// Shading in four stages (docs/picture-light.md, sections 6 and 7): what arrives and what matter is, what it
// mirrors, the sum, and the pressing of bright light. A surface a cycle.
#pragma once

#include <algorithm>
#include <cstddef>
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

// One surface in, one out.
class SurfaceStage : public Stage {
 public:
  SurfaceStage(std::string name, const Registers& registers)
      : Stage(std::move(name)), registers_(registers) {}
  void connect(Fifo<Surface>& in, Fifo<Surface>& out) { in_ = &in, out_ = &out; }

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
  void compute(Surface& of) override {
    if (of.kind == Surface::Kind::background) return;
    if (of.kind == Surface::Kind::way) {
      of.mixture = mixture_of(look(), of.matter);
      of.arriving.light = inner_light(look(), of.light);
      return;
    }
    const bool matter = of.kind == Surface::Kind::matter;
    if (matter) of.mixture = mixture_of(look(), of.matter);
    of.arriving = arriving_of(look(), of.normal, of.light, look().glow && (!matter || of.mixture.w > 0));
    faults_.arrived(look(), of);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class MirrorStage final : public SurfaceStage {
 public:
  explicit MirrorStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("mirror", registers), faults_(faults) {}

 private:
  void compute(Surface& of) override {
    if (of.kind != Surface::Kind::matter) return;
    Vec normal = of.normal;
    Arriving arriving = of.arriving;
    if (of.clear.leaves) {  // the eye sees the surface from within
      normal = Vec{} - normal;
      arriving.facing = SInt<16>(cosine(normal, look().to_light));
    }
    of.mirrored = mirrored_of(look(), normal, of.to_eye, of.light, arriving, of.mixture);
    faults_.mirrored(look(), of);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class ColourStage final : public SurfaceStage {
 public:
  explicit ColourStage(const Registers& registers, Faults faults = {})
      : SurfaceStage("colour", registers), faults_(faults) {}

 private:
  void compute(Surface& of) override {
    if (of.kind == Surface::Kind::background) {
      of.sum = look().background;
    } else if (of.kind == Surface::Kind::ground) {
      of.sum = scattered_color(of.arriving, of.color);
    } else if (look().clear) {
      of.sum = scattered_color(of.arriving, of.mixture.material.diffuse);
      if (of.kind == Surface::Kind::matter) of.clear.gleam = gleam_of(of.mixture, of.mirrored);
    } else {
      of.sum = matter_color(of.arriving, of.mixture, of.mirrored);
    }
    faults_.coloured(of);
  }

  [[no_unique_address]] Faults faults_;
};

template <class Faults = NoFaults>
class PressStage final : public Stage {
 public:
  explicit PressStage(const Registers& registers, Faults faults = {})
      : Stage("press"), registers_(registers), faults_(faults) {}
  void connect(Fifo<Surface>& in, Fifo<PressedToken>& out) { in_ = &in, out_ = &out; }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    const Surface& surface = *in_->get();
    PressedToken& token = *out_->put();
    token = {surface.id, surface.sum};
    if (surface.kind != Surface::Kind::background)
      for (std::int32_t& c : token.pressed)
        c = registers_.look.tone[static_cast<std::size_t>(std::clamp(c, 0, 12287))];
    faults_.pressed(registers_.look, surface, token);
    return Did::busy;
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  Fifo<Surface>* in_ = nullptr;
  Fifo<PressedToken>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
