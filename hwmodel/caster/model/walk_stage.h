// In the walk, rays under way look for their first sample in matter. In each cycle some of them take a step
// through air, one is sampled and one may begin. So no ray waits for another one's memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <vector>

#include "hwmodel/caster/model/leap.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/caster/model/walk.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// Takes a ray in matter to the crossing. The ray's place in the walk stays taken until then.
struct HitToken {
  std::int32_t context = 0;
  GroundedRay ray;
  std::int64_t k = 0;
  Vec at;                     // place of sample k, in the lattice
  std::int16_t level = 0;     // level of sample k
  bool knows_before = false;  // the level of sample k - 1 is known
  std::int16_t before = 0;
  // In clear matter, `span` tells how often the ray has entered it before. If the ray leaves it here,
  // `before` is the level of sample k + 1.
  std::int16_t span = 0;
  bool leaves = false;
};

struct WalkCounts {
  std::int64_t rays = 0, samples = 0, leaps = 0;
};

template <class Faults = NoFaults>
class WalkStage final : public Stage {
 public:
  WalkStage(const Registers& registers, int rays, int walkers, Faults faults = {})
      : Stage("walk"), registers_(registers), faults_(faults), walkers_(walkers), rays_(rays) {
    for (int i = rays - 1; i >= 0; --i) free_.push_back(i);
  }
  void connect(Fifo<GroundedRay>& in, Fifo<LevelRequest>& ask, Fifo<LevelToken>& answer, Fifo<HitToken>& hit,
               Fifo<MetToken>& missed) {
    in_ = &in;
    ask_ = &ask;
    answer_ = &answer;
    hit_ = &hit;
    missed_ = &missed;
  }
  // Rays go on through clear matter: they return from there, and keep their places until they end.
  void connect_onward(Fifo<OnwardToken>& onward) { onward_ = &onward; }
  // This is called when the crossing is done with a ray.
  void crossed(int context) {
    if (onward_ == nullptr) give_back(context);
  }
  void give_back(int context) { free_.push_back(context); }
  const WalkCounts& counts() const { return counts_; }
  void watch(LeapWatcher* watcher) { watcher_ = watcher; }

 private:
  struct Context {
    GroundedRay ray;
    Walker walker;
    std::int64_t k = 0, most = 0;
    std::int64_t slope = 0;
    std::int64_t known = -2;  // the last sample whose level is known
    std::int16_t level = 0;
    std::int16_t span = 0;
  };
  Context& at(int i) { return rays_[i]; }

  Did cycle() override {
    bool moved = false, blocked = false;
    if (!lost_.empty()) {
      if (missed_->ready()) {
        const int i = lost_.front();
        const Context& context = at(i);
        *missed_->put() = {context.ray.id, context.ray.ray, context.ray.ground, {}, i, context.span};
        crossed(i);
        lost_.pop_front();
        moved = true;
      } else {
        blocked = true;
      }
    }
    if (!sampled_.empty()) {
      if (ask_->ready()) {
        ask(sampled_.front());
        sampled_.pop_front();
        moved = true;
      } else {
        blocked = true;
      }
    }
    const auto walking = std::min<std::ptrdiff_t>(walkers_, std::ssize(walking_));
    for (int i = 0; i < walking; ++i) {
      const int ray = walking_.front();
      walking_.pop_front();
      step(ray);
      moved = true;
    }
    if (answer_->valid() && hit_->ready()) {
      decide(*answer_->get());
      moved = true;
    }
    if (onward_ != nullptr && onward_->valid()) {
      go_on(*onward_->get());
      moved = true;
    }
    if (in_->valid() && !free_.empty()) {
      begin(*in_->get());
      moved = true;
    }
    if (moved) return Did::busy;
    if (blocked) return Did::blocked;
    if (onward_ != nullptr) return asked_ > 0 ? Did::memory : in_->valid() ? Did::blocked : Did::starved;
    return free_.size() == rays_.size() ? Did::starved : Did::memory;
  }

  void begin(const GroundedRay& ray) {
    const int i = free_.back();
    free_.pop_back();
    Context& context = at(i);
    context.ray = ray;
    context.walker = walker_of(ray.ray);
    context.k = 0;
    context.known = -2;
    context.span = 0;
    // Matter that is not behind the ground is met by the sample after it, at the latest.
    context.most = ray.ground.found ? (ray.ground.part >> 8) + 1 : kMostSamples;
    ++counts_.rays;
    faults_.begun(context);
    walking_.push_back(i);
  }

  void go_on(const OnwardToken& token) {
    Context& context = at(token.context);
    context.walker.at = token.at;
    context.k = context.known = token.k;
    context.level = token.level;
    ++context.span;
    walking_.push_back(token.context);
  }

  void advance(Context& context, Leap leap, std::int64_t steps) {
    faults_.leaps(context, leap, steps);
    if (watcher_ != nullptr) watcher_->leapt({context.ray.id, leap, context.k, steps});
    context.k += steps;
    context.walker.at = context.walker.at + context.walker.step * steps;
  }

  void step(int i) {
    Context& context = at(i);
    ++counts_.leaps;
    if (context.k > context.most) return lost_.push_back(i);
    const SkipMap& skip = registers_.skip;
    const auto to_box = steps_to_box(context.walker, skip.low, skip.high);
    if (!to_box) return lost_.push_back(i);
    if (*to_box > 0) {
      advance(context, Leap::to_box, *to_box);
      return walking_.push_back(i);
    }
    const Vec& q = context.walker.at;
    const std::uint16_t word = skip.at(q.x >> kBlockBits, q.y >> kBlockBits, q.z >> kBlockBits);
    if (word >= 256) {
      advance(context, Leap::out_of_block, steps_out(context.walker, word - 256));
      return walking_.push_back(i);
    }
    context.slope = word;
    if (context.known == context.k) return through_air(i);
    sampled_.push_back(i);
  }

  void ask(int i) {
    Context& context = at(i);
    LevelRequest& request = *ask_->put();
    request = {Asker::walk, i, context.ray.id, UInt<27>(context.k), on_wires<32>(context.walker.at)};
    faults_.asked(context, request);
    ++counts_.samples;
    ++asked_;
  }

  void decide(const LevelToken& token) {
    const int i = token.request.context;
    Context& context = at(i);
    --asked_;
    bool matter = token.level >= 0;
    faults_.judged(context, matter);
    if (matter) {
      HitToken& hit = *hit_->put();
      hit = {token.request.context,          context.ray,   context.k,   context.walker.at, token.level,
             context.known == context.k - 1, context.level, context.span};
      faults_.meets(context, hit);
      return;
    }
    context.known = context.k;
    context.level = token.level;
    through_air(i);
  }
  // Goes on from a sample whose level is known.
  void through_air(int i) {
    Context& context = at(i);
    const std::int64_t rise = steps_to_rise(context.level, context.slope, registers_.camera.spacing);
    advance(context, Leap::through_air, std::min(rise, steps_out(context.walker, 1)));
    walking_.push_back(i);
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  int walkers_;
  std::vector<Context> rays_;
  std::vector<int> free_;
  std::deque<int> walking_, sampled_, lost_;
  int asked_ = 0;  // samples under way
  WalkCounts counts_;
  LeapWatcher* watcher_ = nullptr;
  Fifo<GroundedRay>* in_ = nullptr;
  Fifo<LevelRequest>* ask_ = nullptr;
  Fifo<LevelToken>* answer_ = nullptr;
  Fifo<HitToken>* hit_ = nullptr;
  Fifo<MetToken>* missed_ = nullptr;
  Fifo<OnwardToken>* onward_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
