// The passed stage sums up what comes along a ray through clear matter, from front to back
// (docs/picture/translucent.md, sections 2, 5 and 6). It takes an event a cycle, and gives one token per ray.
// Then the light is pressed (section 7).
#pragma once

#include <vector>

#include "hwmodel/caster/model/clear.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk_stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// A ray's place in the walk stays taken until its last event has come here. If nothing passes any more, the
// ray ends soon. Events that are on their way by then count no more.
template <class Faults = NoFaults>
class PassedStage final : public Stage {
 public:
  PassedStage(const Registers& registers, WalkStage<Faults>& walk, int rays, Faults faults = {})
      : Stage("passed"), look_(registers.look), walk_(walk), faults_(faults), rays_(rays) {}
  void connect(Fifo<Surface>& in, Fifo<PassedToken>& out) {
    in_ = &in;
    out_ = &out;
  }

  bool dark(int context) const { return rays_[context].dark(); }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    const Surface& event = *in_->oldest();
    Passage& ray = rays_[event.clear.context];
    if (event.kind == Surface::Kind::matter || event.kind == Surface::Kind::way) {
      in_->get();
      if (!ray.dark()) add(event, ray);
      return Did::busy;
    }
    if (!out_->ready()) return Did::blocked;
    in_->get();
    *out_->put() = {event.id, event.kind == Surface::Kind::ground, ray, event.sum};
    ray = {};
    walk_.give_back(event.clear.context);
    return Did::busy;
  }
  void add(const Surface& event, Passage& ray) {
    const Passage before = ray;
    if (event.kind == Surface::Kind::way)
      pass_way(look_, ray, event.clear.way, event.sum, event.mixture.w);
    else
      pass_surface(look_, ray, event.clear.gleam, event.sum, event.mirrored.more, event.mixture.w);
    faults_.passed(look_, before, event, ray);
  }

  const LookRegisters& look_;
  WalkStage<Faults>& walk_;
  [[no_unique_address]] Faults faults_;
  std::vector<Passage> rays_;
  Fifo<Surface>* in_ = nullptr;
  Fifo<PassedToken>* out_ = nullptr;
};

// Takes the place of the stage that presses the light of opaque matter. It has three products, and the same
// table.
template <class Faults = NoFaults>
class ClearPressStage final : public Stage {
 public:
  explicit ClearPressStage(const Registers& registers, Faults faults = {})
      : Stage("press"), look_(registers.look), faults_(faults) {}
  void connect(Fifo<PassedToken>& in, Fifo<PressedToken>& out) {
    in_ = &in;
    out_ = &out;
  }

 private:
  Did cycle() override {
    if (!in_->valid()) return Did::starved;
    if (!out_->ready()) return Did::blocked;
    const PassedToken& ray = *in_->get();
    PressedToken& token = *out_->put();
    token = {ray.id, seen_through(look_, ray.passage, ray.on_ground, ray.behind)};
    faults_.seen_through(look_, ray, token);
    return Did::busy;
  }

  const LookRegisters& look_;
  [[no_unique_address]] Faults faults_;
  Fifo<PassedToken>* in_ = nullptr;
  Fifo<PressedToken>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
