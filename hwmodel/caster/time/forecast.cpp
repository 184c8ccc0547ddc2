#include "hwmodel/caster/time/forecast.h"

#include <algorithm>
#include <cstddef>
#include <deque>
#include <initializer_list>
#include <memory>

#include "hwmodel/caster/model/tile_stages.h"
#include "hwmodel/caster/time/forecast_queues.h"

namespace voxmelt::hwmodel::raycast {
namespace {

using forecasts::Attach;
using forecasts::Course;
using forecasts::Fetch;
using forecasts::Request;
using forecasts::SharedMemory;
using forecasts::Time;
using forecasts::Transfer;
template <class Token>
using Line = forecasts::Line<Token>;

enum Client : int { kLevels, kMatter, kLight, kColumns, kTexels, kTiles };
constexpr int kBurstsOfTile = kTileBytes / kBurst;

struct Tile {
  std::int32_t number = 0;
  int asked = 0;
};

// A pipe, stage by stage as pipe_of.h has them.
class QueuedPipe {
 public:
  QueuedPipe(const ForecastInput& input, const PipeCounts& counts, const Configuration& c,
             Line<Transfer>& requests, Line<Transfer>& replies)
      : counts_(counts),
        c_(c),
        second_(input.second),
        samples_(input.samples),
        requests_(requests),
        replies_(replies),
        free_buffers_(c.tiles),
        open_(static_cast<std::size_t>(c.tiles)),
        jobs(c.fifo_depth) {
    const auto fetch = [&](int client, const CacheShape& shape, int wide) {
      const auto i = static_cast<std::size_t>(client);
      return std::make_unique<Fetch>(client, shape.queue, counts.free[i], input.line_bytes[i], c.fifo_depth,
                                     wide);
    };
    fetches_[kLevels] = fetch(kLevels, c.levels, 5);
    fetches_[kMatter] = fetch(kMatter, c.matter, 1);
    fetches_[kLight] = fetch(kLight, c.light, 1);
    fetches_[kColumns] = fetch(kColumns, c.ground, 1);
    fetches_[kTexels] = fetch(kTexels, c.ground, 1);
    courses_.reserve(counts.rays.size());
    for (const std::vector<RayEvent>& events : counts.rays) courses_.emplace_back(events);
    steps_.resize(counts.rays.size());
    std::int32_t ray = 0;
    for (std::size_t t = 0; t < counts.tiles.size(); ++t) {
      first_rays_.push_back(ray);
      pixels_left_.push_back(counts.tiles[t].rays / samples_);
      for (std::int32_t i = 0; i < counts.tiles[t].rays; ++i, ++ray)
        tile_of_.push_back(static_cast<std::int32_t>(t));
    }
    samples_left_.assign(counts.rays.size() / static_cast<std::size_t>(samples_) + 1, samples_);
  }

  std::size_t tiles() const { return counts_.tiles.size(); }

  void cycle(Time now) {
    port(now);
    write(now);
    pixel(now);
    hand_on(now, pressing_, to_pixel_);
    hand_on(now, colouring_, pressing_);
    hand_on(now, mirroring_, colouring_);
    hand_on(now, arriving_, mirroring_);
    light_.cycle(now, courses_, to_light_, light_asks_, light_answers_, arriving_);
    fetch(now, kLight, light_asks_, light_answers_);
    matter_.cycle(now, courses_, to_matter_, matter_asks_, matter_answers_, to_light_);
    fetch(now, kMatter, matter_asks_, matter_answers_);
    texture_.cycle(now, courses_, to_texture_, texel_asks_, texel_answers_, to_matter_);
    fetch(now, kTexels, texel_asks_, texel_answers_);
    hand_on(now, to_paint_, to_texture_);
    normal_.cycle(now, courses_, to_normal_, normal_asks_, normal_answers_, to_paint_);
    met(now);
    crossing(now);
    sample(now);
    fetches_[kLevels]->read(now, [&](const Request& of) -> Line<Request>& {
      return of.counted->kind == Asked::normal ? normal_answers_ : levels_;
    });
    fetches_[kLevels]->look_up(now, level_asks_);
    first_of(now, {&normal_asks_, &crossing_asks_, &walk_asks_}, level_asks_);
    walk(now);
    ground(now);
    fetch(now, kColumns, look_asks_, look_answers_);
    set_up(now);
    tile(now);
  }

 private:
  Course& course(std::int32_t ray) { return courses_[static_cast<std::size_t>(ray)]; }
  int& steps(std::int32_t ray) { return steps_[static_cast<std::size_t>(ray)]; }

  void fetch(Time now, int client, Line<Request>& asks, Line<Request>& answers) {
    fetches_[static_cast<std::size_t>(client)]->read(
        now, [&](const Request&) -> Line<Request>& { return answers; });
    fetches_[static_cast<std::size_t>(client)]->look_up(now, asks);
  }
  void hand_on(Time now, Line<std::int32_t>& in, Line<std::int32_t>& out) const {
    if (in.valid(now) && out.ready(now)) out.put(now, in.get(now));
  }
  template <class Token>
  static void first_of(Time now, std::initializer_list<Line<Token>*> in, Line<Token>& out) {
    for (Line<Token>* one : in)
      if (one->valid(now)) {
        if (out.ready(now)) out.put(now, one->get(now));
        return;
      }
  }

  void port(Time now) {
    if (replies_.valid(now)) {
      const Transfer of = replies_.get(now);
      if (of.client == kTiles)
        --tiles_missing_;
      else
        fetches_[static_cast<std::size_t>(of.client)]->arrived(of.request);
    }
    const std::array<Line<Transfer>*, 7> in{&fetches_[0]->to_memory,
                                            &fetches_[1]->to_memory,
                                            &fetches_[2]->to_memory,
                                            &fetches_[3]->to_memory,
                                            &fetches_[4]->to_memory,
                                            &tile_lines_,
                                            &written_};
    for (std::size_t i = 0; i < in.size(); ++i) {
      Line<Transfer>& from = *in[(turn_ + i) % in.size()];
      if (!from.valid(now)) continue;
      if (!requests_.ready(now)) return;
      requests_.put(now, from.get(now));
      turn_ = (turn_ + i + 1) % in.size();
      return;
    }
  }
  void write(Time now) {
    if (to_write_.valid(now)) {
      const std::int32_t t = to_write_.get(now);
      if (--pixels_left_[static_cast<std::size_t>(t)] == 0) complete_.push_back(t);
    }
    if (complete_.empty() || !written_.ready(now)) return;
    written_.put(now, {kTiles, 0, kBurst, true});
    if (++bursts_ < kBurstsOfTile) return;
    bursts_ = 0;
    complete_.pop_front();
    ++free_buffers_;
  }
  void pixel(Time now) {
    if (!to_pixel_.valid(now) || !to_write_.ready(now)) return;
    const std::int32_t ray = to_pixel_.get(now);
    if (--samples_left_[static_cast<std::size_t>(ray / samples_)] == 0)
      to_write_.put(now, tile_of_[static_cast<std::size_t>(ray)]);
  }
  void met(Time now) { first_of<std::int32_t>(now, {&crossed_, &missed_}, to_normal_); }

  void crossing(Time now) {
    if (!crossings_done_.empty() && crossed_.ready(now)) {
      crossed_.put(now, crossings_done_.front());
      crossings_done_.pop_front();
      --walking_rays_;
    }
    if (!crossings_asking_.empty() && crossing_asks_.ready(now)) {
      const std::int32_t ray = crossings_asking_.front();
      crossings_asking_.pop_front();
      crossing_asks_.put(now, {ray, course(ray).take()});
    }
    const auto go_on = [&](std::int32_t ray) {
      (course(ray).is(Asked::crossing) ? crossings_asking_ : crossings_done_).push_back(ray);
    };
    if (crossing_answers_.valid(now)) go_on(crossing_answers_.get(now).ray);
    if (hits_.valid(now)) go_on(hits_.get(now));
  }
  void sample(Time now) {
    if (!levels_.valid(now)) return;
    Line<Request>& out = levels_.front().counted->kind == Asked::sample ? walk_answers_ : crossing_answers_;
    if (out.ready(now)) out.put(now, levels_.get(now));
  }

  void begin_steps(std::int32_t ray, std::deque<std::int32_t>& stepping) {
    steps(ray) = course(ray).next().before;
    stepping.push_back(ray);
  }
  // Each cycle some rays take a step. Behind its last one a ray goes where its next event says.
  template <class Behind>
  void take_steps(std::deque<std::int32_t>& stepping, int most, const Behind& behind) {
    const int count = std::min(most, static_cast<int>(stepping.size()));
    for (int i = 0; i < count; ++i) {
      const std::int32_t ray = stepping.front();
      stepping.pop_front();
      if (--steps(ray) > 0)
        stepping.push_back(ray);
      else
        behind(ray);
    }
  }

  void walk(Time now) {
    if (!lost_.empty() && missed_.ready(now)) {
      course(lost_.front()).take();
      missed_.put(now, lost_.front());
      lost_.pop_front();
      --walking_rays_;
    }
    if (!sampled_.empty() && walk_asks_.ready(now)) {
      walk_asks_.put(now, {sampled_.front(), course(sampled_.front()).take()});
      sampled_.pop_front();
    }
    take_steps(walking_, c_.walkers,
               [&](std::int32_t ray) { (course(ray).is(Asked::sample) ? sampled_ : lost_).push_back(ray); });
    if (walk_answers_.valid(now) && hits_.ready(now)) {
      const std::int32_t ray = walk_answers_.get(now).ray;
      if (course(ray).is(Asked::hit)) {
        course(ray).take();
        hits_.put(now, ray);
      } else {
        begin_steps(ray, walking_);
      }
    }
    if (to_walk_.valid(now) && walking_rays_ < c_.rays) {
      ++walking_rays_;
      begin_steps(to_walk_.get(now), walking_);
    }
  }

  void ground(Time now) {
    if (look_answers_.valid(now)) {
      const std::int32_t ray = look_answers_.get(now).ray;
      go_on_in_search(ray);
    }
    if (!found_.empty() && to_walk_.ready(now)) {
      course(found_.front()).take();
      to_walk_.put(now, found_.front());
      found_.pop_front();
      --searching_rays_;
    }
    take_steps(passing_, c_.searchers,
               [&](std::int32_t ray) { (course(ray).is(Asked::look) ? looking_ : found_).push_back(ray); });
    if (!looking_.empty() && look_asks_.ready(now)) {
      look_asks_.put(now, {looking_.front(), course(looking_.front()).take()});
      looking_.pop_front();
    }
    if (to_ground_.valid(now) && searching_rays_ < kSearches) {
      ++searching_rays_;
      go_on_in_search(to_ground_.get(now));
    }
  }
  void go_on_in_search(std::int32_t ray) {
    if (course(ray).next().before > 0)
      begin_steps(ray, passing_);
    else
      (course(ray).is(Asked::look) ? looking_ : found_).push_back(ray);
  }

  void set_up(Time now) {
    if (orders_.valid(now)) {
      const auto place =
          std::find_if(open_.begin(), open_.end(), [](const Open& of) { return of.left == 0; });
      if (place != open_.end()) {
        const auto t = static_cast<std::size_t>(orders_.get(now));
        *place = {first_rays_[t], counts_.tiles[t].rays};
      }
    }
    if (!to_ground_.ready(now)) return;
    for (std::size_t i = 0; i < open_.size(); ++i) {
      const std::size_t at = (set_up_turn_ + i) % open_.size();
      if (open_[at].left == 0) continue;
      to_ground_.put(now, open_[at].ray++);
      --open_[at].left;
      set_up_turn_ = (at + 1) % open_.size();
      return;
    }
  }
  void tile(Time now) {
    if (!jobs.valid(now)) return;
    const TileCount& of = counts_.tiles[static_cast<std::size_t>(jobs.front())];
    if (second_ && tiles_asked_ < kBeside) {
      if ((of.reads >> tiles_asked_ & 1) != 0) {
        if (!tile_lines_.ready(now)) return;
        tile_lines_.put(now, {kTiles, 0, kTileBytes, false});
        ++tiles_missing_;
      }
      ++tiles_asked_;
      return;
    }
    if (tiles_missing_ > 0 || free_buffers_ == 0 || !orders_.ready(now)) return;
    --free_buffers_;
    tiles_asked_ = 0;
    const std::int32_t t = jobs.get(now);
    if (of.rays == 0)
      complete_.push_back(t);
    else
      orders_.put(now, t);
  }

  static constexpr int kBeside = 5;    // tiles that the second pass reads for one
  static constexpr int kWaiting = 16;  // as in pipe_of.h
  static constexpr int kSearches = 32;

  const PipeCounts& counts_;
  const Configuration& c_;
  bool second_;
  int samples_;
  Line<Transfer>&requests_, &replies_;
  std::array<std::unique_ptr<Fetch>, PipeCounts::kCaches> fetches_;
  std::vector<Course> courses_;
  std::vector<int> steps_;  // left of a ray
  std::vector<std::int32_t> first_rays_, tile_of_;
  std::vector<int> pixels_left_, samples_left_;
  int free_buffers_, tiles_asked_ = 0, tiles_missing_ = 0, bursts_ = 0;
  int walking_rays_ = 0, searching_rays_ = 0;
  struct Open {
    std::int32_t ray = 0;
    int left = 0;
  };
  std::vector<Open> open_;  // tiles whose rays are made in turn
  std::size_t turn_ = 0, set_up_turn_ = 0;
  std::deque<std::int32_t> complete_, crossings_done_, crossings_asking_, lost_, sampled_, walking_, found_,
      looking_, passing_;
  int depth_ = c_.fifo_depth;
  Line<Transfer> tile_lines_{depth_}, written_{depth_};
  Line<std::int32_t> orders_{depth_}, to_ground_{depth_}, to_walk_{depth_}, hits_{std::max(depth_, c_.rays)},
      missed_{depth_}, crossed_{depth_}, to_normal_{depth_}, to_paint_{depth_}, to_texture_{depth_},
      to_matter_{depth_}, to_light_{depth_}, arriving_{depth_}, mirroring_{depth_}, colouring_{depth_},
      pressing_{depth_}, to_pixel_{depth_}, to_write_{depth_};
  Line<Request> walk_asks_{depth_}, crossing_asks_{depth_}, normal_asks_{depth_}, level_asks_{depth_},
      levels_{depth_}, normal_answers_{depth_}, walk_answers_{depth_}, crossing_answers_{depth_},
      look_asks_{depth_}, look_answers_{depth_}, texel_asks_{depth_}, texel_answers_{depth_},
      matter_asks_{depth_}, matter_answers_{depth_}, light_asks_{depth_}, light_answers_{depth_};
  Attach normal_{Asked::normal, kWaiting}, texture_{Asked::texel, kWaiting}, matter_{Asked::matter, kWaiting},
      light_{Asked::light, kWaiting};

 public:
  Line<std::int32_t> jobs;
};

}  // namespace

std::int64_t forecast(const ForecastInput& input, const Configuration& c) {
  if (c.stall_seed != 0 || c.dram) return -1;
  SharedMemory memory(c.latency, c.bus_bytes, static_cast<int>(input.pipes.size()), c.fifo_depth);
  std::vector<std::unique_ptr<QueuedPipe>> pipes;
  std::int64_t bytes = 0, work = 0;
  for (std::size_t i = 0; i < input.pipes.size(); ++i) {
    pipes.push_back(
        std::make_unique<QueuedPipe>(input, input.pipes[i], c, memory.requests[i], memory.replies[i]));
    bytes += static_cast<std::int64_t>(input.pipes[i].tiles.size()) * kTileBytes;
    for (const std::vector<RayEvent>& ray : input.pipes[i].rays)
      for (const RayEvent& of : ray) work += 2 + of.before + of.misses;
    work += 20 * static_cast<std::int64_t>(input.pipes[i].tiles.size());
  }
  const Time most = 1000 + work * (20 + c.latency + 4096 / c.bus_bytes);  // no machine takes so long
  std::vector<std::int32_t> dealt(pipes.size(), 0);
  std::size_t turn = 0;
  for (Time now = 0; now < most; ++now) {
    for (std::size_t i = 0; i < pipes.size(); ++i) {
      const std::size_t p = (turn + i) % pipes.size();
      if (static_cast<std::size_t>(dealt[p]) == pipes[p]->tiles() || !pipes[p]->jobs.ready(now)) continue;
      pipes[p]->jobs.put(now, dealt[p]++);
      turn = (p + 1) % pipes.size();
      break;
    }
    for (const auto& pipe : pipes) pipe->cycle(now);
    memory.cycle(now);
    if (memory.written == bytes) return now + 1;
  }
  return -1;
}

}  // namespace voxmelt::hwmodel::raycast
