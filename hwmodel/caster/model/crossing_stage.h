// The crossing between a sample in air and the next one in matter is found by three middles and a straight
// line (docs/picture/definition.md, section 7). A ray that leaves clear matter has the samples in the other
// order. Many rays are under way. The level of sample k - 1 is asked for only if it is needed and not known.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk_stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

template <class Faults = NoFaults>
class CrossingStage final : public Stage {
 public:
  CrossingStage(WalkStage<Faults>& walk, int rays, Faults faults = {})
      : Stage("crossing"), walk_(walk), faults_(faults), rays_(rays) {}
  void connect(Fifo<HitToken>& in, Fifo<LevelRequest>& ask, Fifo<LevelToken>& answer, Fifo<MetToken>& out) {
    in_ = &in;
    ask_ = &ask;
    answer_ = &answer;
    out_ = &out;
  }
  void connect_exits(Fifo<HitToken>& exits) { exits_ = &exits; }

 private:
  struct Context {
    HitToken hit;
    Bracket bracket;
    int halved = 0;
  };
  Context& at(int i) { return rays_[i]; }

  Did cycle() override {
    bool moved = false, blocked = false;
    if (!done_.empty()) {
      if (out_->ready()) {
        finish(done_.front());
        done_.pop_front();
        moved = true;
      } else {
        blocked = true;
      }
    }
    if (!asking_.empty()) {
      if (ask_->ready()) {
        const int i = asking_.front();
        asking_.pop_front();
        const Context& context = at(i);
        *ask_->put() = {
            Asker::crossing, i, context.hit.ray.id, context.hit.k,
            on_wires<32>(context.halved < 3 ? middle_of(context.bracket) : context.bracket.outside)};
        moved = true;
      } else {
        blocked = true;
      }
    }
    if (answer_->valid()) {
      const LevelToken& token = *answer_->get();
      take(token.request.context, token.level);
      moved = true;
    }
    if (in_->valid()) {
      begin(*in_->get());
      moved = true;
    }
    if (exits_ != nullptr && exits_->valid()) {
      begin(*exits_->get());
      moved = true;
    }
    if (moved) return Did::busy;
    if (blocked) return Did::blocked;
    return waiting_ == 0 ? Did::starved : Did::memory;
  }

  void begin(const HitToken& hit) {
    Context& context = at(hit.context);
    context.hit = hit;
    ++waiting_;
    const Vec& step = hit.ray.ray.step;
    context.bracket = {hit.leaves ? hit.at + step : hit.at - step, hit.at, hit.before, hit.level, 0};
    context.halved = 0;
    (begins_in_matter(hit) ? done_ : asking_).push_back(hit.context);
  }
  void take(int i, std::int64_t level) {
    Context& context = at(i);
    if (context.halved == 3) {
      context.bracket.a = level;
      return done_.push_back(i);
    }
    halve(context.bracket, level);
    const bool needs_before = ++context.halved == 3 && context.bracket.e == 0 && !context.hit.knows_before;
    (context.halved < 3 || needs_before ? asking_ : done_).push_back(i);
  }
  void finish(int i) {
    const Context& context = at(i);
    const GroundedRay& ray = context.hit.ray;
    Crossing met = begins_in_matter(context.hit) ? Crossing{true, 0, 2048, on_wires<32>(ray.ray.start)}
                                                 : crossing_of(context.bracket, context.hit.k);
    faults_.crossed(context.hit, context.bracket, met);
    *out_->put() = {ray.id,
                    ray.ray,
                    ray.ground,
                    met,
                    context.hit.context,
                    context.hit.span,
                    context.hit.leaves,
                    context.hit.level,
                    context.hit.at};
    walk_.crossed(i);
    --waiting_;
  }
  static bool begins_in_matter(const HitToken& hit) { return hit.k == 0 && !hit.leaves; }

  WalkStage<Faults>& walk_;
  [[no_unique_address]] Faults faults_;
  std::vector<Context> rays_;
  int waiting_ = 0;
  std::deque<int> asking_, done_;
  Fifo<HitToken>* in_ = nullptr;
  Fifo<HitToken>* exits_ = nullptr;
  Fifo<LevelRequest>* ask_ = nullptr;
  Fifo<LevelToken>* answer_ = nullptr;
  Fifo<MetToken>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
