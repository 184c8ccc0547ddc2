// The ground stage finds where rays meet the ground (docs/picture/ground.md, section 4). Many rays are under
// way. In each cycle some of them take a step over blocks that they pass above, and one looks at sixteen
// columns. A step is a quarter of a cell at most. So the columns serve its height, its eight halvings by a
// row of eight units, and the normal where it ends. Without ground the stage hands rays on.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <iterator>
#include <vector>

#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/ground_blocks.h"
#include "hwmodel/caster/model/leap.h"
#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/caster/model/tokens.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

// The stage knows its rays by their numbers. Each ray is in one of the queues.
template <class Faults = NoFaults>
class GroundStage final : public Stage {
 public:
  GroundStage(const Registers& registers, int rays, int searchers, Faults faults = {})
      : Stage("ground"), registers_(registers), faults_(faults), searchers_(searchers), rays_(rays) {
    for (int i = rays - 1; i >= 0; --i) free_.push_back(i);
  }
  void connect(Fifo<RayToken>& in, Fifo<ClampedRequest>& ask, Fifo<ColumnGather::Out>& answer,
               Fifo<GroundedRay>& out) {
    in_ = &in;
    ask_ = &ask;
    answer_ = &answer;
    out_ = &out;
  }
  void watch(LeapWatcher* watcher) { watcher_ = watcher; }

 private:
  struct Search {
    GroundedRay ray;
    Searcher searcher;
    Parts parts;
    std::int64_t part = 0;  // part that is looked at
  };
  Search& at(int i) { return rays_[i]; }

  Did cycle() override {
    bool moved = false, blocked = false;
    if (answer_->valid()) {
      const ColumnGather::Out& answer = *answer_->get();
      decide(answer.request.context, answer);
      moved = true;
    }
    if (!done_.empty()) {
      if (out_->ready()) {
        GroundedRay& ray = *out_->put();
        ray = at(done_.front()).ray;
        faults_.grounded(ray);
        free_.push_back(done_.front());
        done_.pop_front();
        moved = true;
      } else {
        blocked = true;
      }
    }
    const auto passing = std::min<std::ptrdiff_t>(searchers_, std::ssize(passing_));
    for (int i = 0; i < passing; ++i) {
      const int ray = passing_.front();
      passing_.pop_front();
      pass(ray);
      moved = true;
    }
    if (!ready_.empty()) {
      if (ask_->ready()) {
        look(ready_.front());
        ready_.pop_front();
        moved = true;
      } else {
        blocked = true;
      }
    }
    if (in_->valid() && !free_.empty()) {
      begin(*in_->get());
      moved = true;
    }
    if (moved) return Did::busy;
    if (blocked) return Did::blocked;
    return free_.size() == rays_.size() ? Did::starved : Did::memory;
  }

  void begin(const RayToken& token) {
    const int i = free_.back();
    free_.pop_back();
    Search& search = at(i);
    search = {};
    search.ray.id = token.id;
    search.ray.ray = token.ray;
    if (registers_.ground.any) search.parts = parts_of(registers_, token.ray);
    search.part = search.parts.first;
    search.searcher = searcher_of(token.ray);
    (search.parts.first > search.parts.last ? done_ : passing_).push_back(i);
  }

  // Takes a step over the blocks below. If there is none, the ray must look at columns.
  void pass(int i) {
    Search& search = at(i);
    auto samples =
        samples_above(registers_.ground.blocks, search.searcher, at_part(search.ray.ray, search.part));
    faults_.passes_blocks(search.ray, search.part, samples);
    if (!samples) return ready_.push_back(i);
    go_on(i, *samples, Leap::over_blocks);
  }
  // Goes on to the sample behind those that are left out.
  void go_on(int i, std::int64_t samples, Leap leap) {
    Search& search = at(i);
    if (search.part == search.parts.last) return done_.push_back(i);
    if (watcher_ != nullptr) watcher_->leapt({search.ray.id, leap, search.part, samples + 1});
    search.part = std::min(((search.part >> 8) + 1 + samples) << 8, search.parts.last);
    passing_.push_back(i);
  }

  // Returns a part before this one that is out of the ground. The bisection would begin there.
  std::int64_t part_before(const Search& search) const {
    return search.part == search.parts.first ? search.part - 1
                                             : std::max(search.parts.first, ((search.part - 1) >> 8) << 8);
  }
  // Asks for all columns that the step up to the part may need.
  void look(int i) {
    Search& search = at(i);
    const Vec a = at_part(search.ray.ray, part_before(search)), b = at_part(search.ray.ray, search.part);
    ClampedRequest& ask = *ask_->put();
    ask.at = {spot_of(std::min(a.x, b.x) - kCell / 2), {}, spot_of(std::min(a.z, b.z) - kCell / 2)};
    ask.count = {static_cast<std::int32_t>(registers_.cells.x), 1,
                 static_cast<std::int32_t>(registers_.cells.z)};
    ask.asker = 0;
    ask.context = i;
    ask.side = NearColumns::kSide;
    ask.id = search.ray.id;
  }

  void decide(int i, const ColumnGather::Out& answer) {
    Search& search = at(i);
    const NearColumns columns{answer.request.at.x.cell, answer.request.at.z.cell, answer.words};
    const Vec p = at_part(search.ray.ray, search.part);
    const std::int64_t above = (p.y >> 8) - columns.height(&Column::drawn, p.x, p.z);
    if (above < 0) return bisect(i, columns);
    std::int64_t samples = samples_over_slopes(registers_.ground.blocks, search.searcher, p, above);
    faults_.passes_slopes(search.ray, search.searcher, p, above, samples);
    go_on(i, samples, Leap::over_slopes);
  }
  void bisect(int i, const NearColumns& columns) {
    Search& search = at(i);
    std::int64_t outside = part_before(search), inside = search.part;
    while (inside - outside > 1) {
      const std::int64_t middle = (inside + outside) >> 1;
      const Vec p = at_part(search.ray.ray, middle);
      const bool in = in_slab(registers_, p) && (p.y >> 8) < columns.height(&Column::drawn, p.x, p.z);
      (in ? inside : outside) = middle;
    }
    GroundHit& hit = search.ray.ground;
    hit.found = true;
    hit.part = UInt<36>(inside);
    hit.position = on_wires<31>(at_part(search.ray.ray, inside));
    hit.face = inside == 0 ? Face::none : face_of(registers_, at_part(search.ray.ray, outside));
    if (hit.face == Face::top) hit.normal = normal_at(hit.position, columns);
    done_.push_back(i);
  }

  Vec normal_at(const Vec& p, const NearColumns& columns) const {
    const auto bare = [&](std::int64_t x, std::int64_t z) {
      return std::int64_t{columns.height(&Column::bare, x, z)};
    };
    constexpr std::int64_t kHalf = kCell / 2;
    return top_normal(
        registers_, p,
        {bare(p.x - kHalf, p.z), bare(p.x + kHalf, p.z), bare(p.x, p.z - kHalf), bare(p.x, p.z + kHalf)});
  }

  const Registers& registers_;
  [[no_unique_address]] Faults faults_;
  int searchers_;
  std::vector<Search> rays_;
  std::vector<int> free_;
  std::deque<int> passing_, ready_, done_;
  LeapWatcher* watcher_ = nullptr;
  Fifo<RayToken>* in_ = nullptr;
  Fifo<ClampedRequest>* ask_ = nullptr;
  Fifo<ColumnGather::Out>* answer_ = nullptr;
  Fifo<GroundedRay>* out_ = nullptr;
};

}  // namespace voxmelt::hwmodel::raycast
