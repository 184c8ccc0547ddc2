// A ray through clear matter (docs/picture-translucent.md, section 3): stretch by stretch to the surface at
// which it leaves, and back to the walk, until it ends. It tells what is on the ray, in order: surfaces and
// ways, and at last the ground or the background. One event a cycle leaves. A ray asks for one sample at a
// time, because one that lies behind the surface would be read in vain; other rays fill the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "hwmodel/caster/model/clear.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/met_stage.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/passed_stage.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk_stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class StretchStage final : public Stage {
 public:
  StretchStage(const Registers& registers, const PassedStage<Faults>& passed, int rays, Faults faults = {})
      : Stage("stretch"),
        registers_(registers),
        passed_(passed),
        faults_(faults),
        rays_(static_cast<std::size_t>(rays)) {}
  void connect(Fifo<MetToken>& missed, Fifo<MetToken>& crossed, Fifo<LevelRequest>& ask,
               Fifo<LevelToken>& answer, Fifo<HitToken>& exit, Fifo<OnwardToken>& onward,
               Fifo<Surface>& out) {
    missed_ = &missed, crossed_ = &crossed, ask_ = &ask, answer_ = &answer, exit_ = &exit;
    onward_ = &onward, out_ = &out;
  }

 private:
  using Kind = Surface::Kind;
  enum class Next : std::uint8_t { sample, exit, onward, nothing };
  struct Event {
    Kind kind = Kind::background;
    bool leaves = false;
    Vec position;
    std::int32_t way = 0;
  };
  struct Context {
    GroundedRay ray;
    Vec to_eye;
    UInt<15> length;
    std::int64_t last = 0;  // the sample before the ground
    std::int64_t k = 0;     // a sample in matter, its position and level
    Vec at;
    std::int16_t level = 0, beyond = 0;  // there, and at sample k + 1
    std::int16_t span = 0;               // how often the ray has entered matter before
    int steps = 0;                       // of the stretch
    UInt<18> way;                        // of the stretch
    std::int32_t told = 0;               // events
    std::array<Event, 3> events{};       // to be told
    int first = 0, count = 0;
    Next next = Next::nothing;
  };
  Context& at(int i) { return rays_[static_cast<std::size_t>(i)]; }

  Did cycle() override {
    bool moved = false, blocked = false;
    const auto serve = [&](std::deque<int>& queue, auto& out, const auto& put) {
      if (queue.empty()) return;
      if (!out.ready()) {
        blocked = true;
        return;
      }
      const int i = queue.front();
      queue.pop_front();
      put(i);
      moved = true;
    };
    serve(asking_, *ask_, [&](int i) { ask(i); });
    serve(leaving_, *exit_, [&](int i) { leave(i); });
    serve(going_, *onward_, [&](int i) {
      const Context& of = at(i);
      *onward_->put() = {static_cast<std::int16_t>(i), of.k + 1, of.at + of.ray.ray.step, of.beyond};
    });
    serve(telling_, *out_, [&](int i) { tell(i); });
    if (answer_->valid()) {
      const LevelToken& token = *answer_->get();
      take(token.request.context, token.level);
      moved = true;
    }
    if (crossed_->valid()) {
      const MetToken& met = *crossed_->get();
      met.leaves ? left(met) : entered(met);
      moved = true;
    }
    if (missed_->valid()) {
      const MetToken& met = *missed_->get();
      if (met.span == 0) begin(met);
      end(met.context);
      tell_soon(met.context, Next::nothing);
      moved = true;
    }
    if (moved) return Did::busy;
    if (blocked) return Did::blocked;
    return asked_ == 0 ? Did::starved : Did::memory;
  }

  void begin(const MetToken& met) {
    Context& of = at(met.context);
    of = {};
    of.ray = {met.id, met.ray, met.ground};
    of.to_eye = unit_of(Vec{} - met.ray.step);
    of.length = length_of_step(met.ray.step, of.to_eye);
    of.last = met.ground.found ? met.ground.part >> 8 : std::numeric_limits<std::int64_t>::max();
  }
  void add(Context& of, const Event& event) { of.events[static_cast<std::size_t>(of.count++)] = event; }
  void add_way(Context& of) {
    add(of, {Kind::way, false, from_lattice(of.at), static_cast<std::int32_t>(of.way)});
    of.way = 0;
    of.steps = 0;
  }
  // At the ground, or nowhere.
  void end(int i, bool dark = false) {
    Context& of = at(i);
    const GroundHit& ground = of.ray.ground;
    if (ground.found && !dark)
      add(of, {Kind::ground, false, ground.position, 0});
    else
      add(of, {});
  }
  void tell_soon(int i, Next next) {
    at(i).next = next;
    telling_.push_back(i);
  }

  // At a surface from air.
  void entered(const MetToken& met) {
    const int i = met.context;
    if (met.span == 0) begin(met);
    Context& of = at(i);
    of.span = met.span;
    if (ground_first(met.ground, met.matter, registers_.camera.halvings)) {
      end(i);
      return tell_soon(i, Next::nothing);
    }
    if (met.matter.sample > 0) add(of, {Kind::matter, false, met.matter.position, 0});
    of.k = met.matter.sample, of.at = met.at, of.level = met.level;
    of.steps = 0;
    if (of.k > of.last) {  // the ground follows within the step
      const std::int64_t place = (of.k - 1) * 2048 + met.matter.part;
      of.way = part_of_step(of.length, UInt<12>(8 * met.ground.part - place), 11);
      add_way(of);
      end(i);
      return tell_soon(i, Next::nothing);
    }
    of.way = part_of_step(of.length, 2048 - met.matter.part, 11);
    proceed(i);
  }
  // Behind a sample in matter.
  void proceed(int i) {
    Context& of = at(i);
    if (of.k == of.last) {
      of.way = of.way + part_of_step(of.length, of.ray.ground.part & 255, 8);
      add_way(of);
      end(i);
      return tell_soon(i, Next::nothing);
    }
    if (of.steps == 1 << registers_.camera.spacing) add_way(of);
    if (of.count > 0) return tell_soon(i, Next::sample);
    go(i, Next::sample);
  }
  void take(int i, std::int16_t level) {
    Context& of = at(i);
    --asked_;
    if (level < 0) {
      of.beyond = level;
      return go(i, Next::exit);
    }
    ++of.k;
    of.at = of.at + of.ray.ray.step;
    of.level = level;
    of.way = of.way + of.length;
    ++of.steps;
    proceed(i);
  }
  // At the surface to air.
  void left(const MetToken& met) {
    Context& of = at(met.context);
    of.way = of.way + part_of_step(of.length, 2048 - met.matter.part, 11);
    add_way(of);
    add(of, {Kind::matter, true, met.matter.position, 0});
    tell_soon(met.context, Next::onward);
  }

  // A ray through which nothing passes ends here.
  void go(int i, Next next) {
    if (next == Next::nothing) return;
    if (passed_.dark(i)) {
      at(i).count = at(i).first = 0;
      end(i, true);
      return tell_soon(i, Next::nothing);
    }
    (next == Next::sample ? asking_ : next == Next::exit ? leaving_ : going_).push_back(i);
  }
  void tell(int i) {
    Context& of = at(i);
    const Event& event = of.events[static_cast<std::size_t>(of.first)];
    Surface& to = *out_->put();
    to = {};
    to.id = of.ray.id;
    to.kind = event.kind;
    to.face = of.ray.ground.face;
    to.inside = event.kind == Kind::ground && to.face == Face::none;
    to.position = event.position;
    to.step = of.ray.ray.step;
    to.to_eye = of.to_eye;
    if (event.kind == Kind::ground) to.normal = of.ray.ground.normal;
    to.clear = {static_cast<std::int16_t>(i), event.leaves, of.told++, event.way, {}};
    faults_.told(to);
    if (++of.first < of.count) return telling_.push_front(i);
    of.first = of.count = 0;
    go(i, of.next);
  }
  void ask(int i) {
    const Context& of = at(i);
    *ask_->put() = {Asker::stretch, static_cast<std::int16_t>(i), of.ray.id, UInt<27>(of.k + 1),
                    on_wires<32>(of.at + of.ray.ray.step)};
    ++asked_;
  }
  void leave(int i) {
    const Context& of = at(i);
    *exit_->put() = {
        static_cast<std::int16_t>(i), of.ray, of.k, of.at, of.level, true, of.beyond, of.span, true};
  }

  const Registers& registers_;
  const PassedStage<Faults>& passed_;
  [[no_unique_address]] Faults faults_;
  std::vector<Context> rays_;
  std::deque<int> telling_, asking_, leaving_, going_;
  int asked_ = 0;
  Fifo<MetToken>* missed_ = nullptr;
  Fifo<MetToken>* crossed_ = nullptr;
  Fifo<LevelRequest>* ask_ = nullptr;
  Fifo<LevelToken>* answer_ = nullptr;
  Fifo<HitToken>* exit_ = nullptr;
  Fifo<OnwardToken>* onward_ = nullptr;
  Fifo<Surface>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
