// The stretch stage leads a ray through clear matter (docs/picture/translucent.md, section 3). The ray goes
// stretch by stretch to the surface at which it leaves, and back to the walk, until it ends. The stage tells
// what is on the ray, in order: surfaces and ways, and at last the ground or the background. One event a
// cycle leaves. A ray asks for one sample at a time, because one that lies behind the surface would be read
// in vain. Other rays fill the time.
#pragma once

#include <array>
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
      : Stage("stretch"), registers_(registers), passed_(passed), faults_(faults), rays_(rays) {}
  void connect(Fifo<MetToken>& missed, Fifo<MetToken>& crossed, Fifo<LevelRequest>& ask,
               Fifo<LevelToken>& answer, Fifo<HitToken>& exit, Fifo<OnwardToken>& onward,
               Fifo<Surface>& out) {
    missed_ = &missed;
    crossed_ = &crossed;
    ask_ = &ask;
    answer_ = &answer;
    exit_ = &exit;
    onward_ = &onward;
    out_ = &out;
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
    std::int64_t last = 0;  // last sample before the ground
    std::int64_t k = 0;     // a sample in matter, its position and level
    Vec at;
    std::int16_t level = 0, beyond = 0;  // levels of sample k, and of sample k + 1
    std::int16_t span = 0;               // times that the ray has entered matter before
    int steps = 0;                       // steps of the stretch so far
    UInt<18> way;                        // way of the stretch so far
    std::int32_t told = 0;               // number of events that were told
    std::array<Event, 3> events{};       // events that are to be told
    int first = 0, count = 0;
    Next next = Next::nothing;
  };
  Context& at(int i) { return rays_[i]; }

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
      const Context& context = at(i);
      *onward_->put() = {i, context.k + 1, context.at + context.ray.ray.step, context.beyond};
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
    Context& context = at(met.context);
    context = {};
    context.ray = {met.id, met.ray, met.ground};
    context.to_eye = unit_of(Vec{} - met.ray.step);
    context.length = length_of_step(met.ray.step, context.to_eye);
    context.last = met.ground.found ? met.ground.part >> 8 : std::numeric_limits<std::int64_t>::max();
  }
  void add(Context& context, const Event& event) { context.events[context.count++] = event; }
  void add_way(Context& context) {
    add(context, {Kind::way, false, from_lattice(context.at), static_cast<std::int32_t>(context.way)});
    context.way = 0;
    context.steps = 0;
  }
  // Ends a ray at the ground, or nowhere.
  void end(int i, bool dark = false) {
    Context& context = at(i);
    const GroundHit& ground = context.ray.ground;
    if (ground.found && !dark)
      add(context, {Kind::ground, false, ground.position, 0});
    else
      add(context, {});
  }
  void tell_soon(int i, Next next) {
    at(i).next = next;
    telling_.push_back(i);
  }

  // Takes a ray that meets a surface from air.
  void entered(const MetToken& met) {
    const int i = met.context;
    if (met.span == 0) begin(met);
    Context& context = at(i);
    context.span = met.span;
    if (ground_first(met.ground, met.matter, registers_.camera.halvings)) {
      end(i);
      return tell_soon(i, Next::nothing);
    }
    if (met.matter.sample > 0) add(context, {Kind::matter, false, met.matter.position, 0});
    context.k = met.matter.sample;
    context.at = met.at;
    context.level = met.level;
    context.steps = 0;
    if (context.k > context.last) {  // the ground follows within the step
      const std::int64_t place = (context.k - 1) * 2048 + met.matter.part;
      context.way = part_of_step(context.length, UInt<12>(8 * met.ground.part - place), 11);
      add_way(context);
      end(i);
      return tell_soon(i, Next::nothing);
    }
    context.way = part_of_step(context.length, 2048 - met.matter.part, 11);
    proceed(i);
  }
  // Goes on behind a sample in matter.
  void proceed(int i) {
    Context& context = at(i);
    if (context.k == context.last) {
      context.way = context.way + part_of_step(context.length, context.ray.ground.part & 255, 8);
      add_way(context);
      end(i);
      return tell_soon(i, Next::nothing);
    }
    if (context.steps == 1 << registers_.camera.spacing) add_way(context);
    if (context.count > 0) return tell_soon(i, Next::sample);
    go(i, Next::sample);
  }
  void take(int i, std::int16_t level) {
    Context& context = at(i);
    --asked_;
    if (level < 0) {
      context.beyond = level;
      return go(i, Next::exit);
    }
    ++context.k;
    context.at = context.at + context.ray.ray.step;
    context.level = level;
    context.way = context.way + context.length;
    ++context.steps;
    proceed(i);
  }
  // Takes a ray that meets the surface to air.
  void left(const MetToken& met) {
    Context& context = at(met.context);
    context.way = context.way + part_of_step(context.length, 2048 - met.matter.part, 11);
    add_way(context);
    add(context, {Kind::matter, true, met.matter.position, 0});
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
    Context& context = at(i);
    const Event& event = context.events[context.first];
    Surface& to = *out_->put();
    to = {};
    to.id = context.ray.id;
    to.kind = event.kind;
    to.face = context.ray.ground.face;
    to.inside = event.kind == Kind::ground && to.face == Face::none;
    to.position = event.position;
    to.step = context.ray.ray.step;
    to.to_eye = context.to_eye;
    if (event.kind == Kind::ground) to.normal = context.ray.ground.normal;
    to.clear = {i, event.leaves, context.told++, event.way, {}};
    faults_.told(to);
    if (++context.first < context.count) return telling_.push_front(i);
    context.first = context.count = 0;
    go(i, context.next);
  }
  void ask(int i) {
    const Context& context = at(i);
    *ask_->put() = {Asker::stretch, i, context.ray.id, UInt<27>(context.k + 1),
                    on_wires<32>(context.at + context.ray.ray.step)};
    ++asked_;
  }
  void leave(int i) {
    const Context& context = at(i);
    *exit_->put() = {i,    context.ray,    context.k,    context.at, context.level,
                     true, context.beyond, context.span, true};
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
