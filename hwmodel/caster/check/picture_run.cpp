#include "hwmodel/caster/check/picture_run.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <stdexcept>

#include "hwmodel/caster/check/expectation.h"
#include "hwmodel/caster/faults/planted_pipe.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Returns the picture that lies in memory, tile by tile.
render::Image image_of(const Memory& memory, std::int64_t frame, int width, int height) {
  render::Image image(width, height);
  const int tiles_x = (width + kTileSide - 1) / kTileSide;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::int64_t tile = std::int64_t{y / kTileSide} * tiles_x + x / kTileSide;
      const std::uint8_t* bytes =
          memory.bytes.data() + frame + tile * kTileBytes + 3 * ((y % kTileSide) * kTileSide + x % kTileSide);
      image.at(x, y) = {bytes[0], bytes[1], bytes[2]};
    }
  return image;
}

// Widens a window by a pixel, because the second pass compares a pixel with those beside it.
Window with_neighbours(const Window& window) {
  return {window.left - 1, window.top - 1, window.right + 1, window.bottom + 1};
}

// Returns how many pixels it compared.
std::int64_t compare_bytes(PictureReport& report, const render::Image& expected, const Window& window) {
  std::int64_t pixels = 0;
  for (int y = 0; y < expected.height; ++y)
    for (int x = 0; x < expected.width; ++x) {
      if (!window.holds(x, y)) continue;
      ++pixels;
      if (report.image.at(x, y) == expected.at(x, y)) continue;
      if (!report.different) report.different = RayId{x, y, 0, 0};
      ++report.different_bytes;
    }
  return pixels;
}

void tell_hang(PictureReport& report, const RayCaster& caster) {
  std::string text, waiting, jammed;
  for (int i = 0; i < caster.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster.pipe(i).channels())
      if (channel.count > 0)
        text += "  pipe " + std::to_string(i) + ": " + channel.name + ": " + std::to_string(channel.count) +
                " of " + std::to_string(channel.depth) + "\n";
  for (int i = 0; i < caster.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster.pipe(i).channels())
      if (channel.count < channel.depth && !channel.ready) {
        report.jammed.push_back(channel.name);
        jammed += "  pipe " + std::to_string(i) + ": " + channel.name + "\n";
      }
  for (int i = 0; i < caster.pipes(); ++i)
    for (const Stage* stage : caster.pipe(i).stages()) {
      if (!stage->waits_for_memory()) continue;
      report.waiting.push_back(stage->name());
      waiting += "  pipe " + std::to_string(i) + ": " + stage->name() + "\n";
    }
  report.hang = "nothing moves any more; channels that hold tokens:\n" + text +
                "stages that wait for the memory:\n" + waiting;
  if (!jammed.empty()) report.hang += "channels that have room and take nothing:\n" + jammed;
  if (report.under_way)
    report.hang += "a ray under way: pixel (" + std::to_string(report.under_way->x) + ", " +
                   std::to_string(report.under_way->y) + "), sample " +
                   std::to_string(report.under_way->sample) + "\n";
}

void add(Account& sum, const Account& more) {
  sum.busy += more.busy;
  sum.starved += more.starved;
  sum.blocked += more.blocked;
  sum.memory += more.memory;
  sum.fill += more.fill;
  sum.drain += more.drain;
}

void take_accounts(PictureReport& report, const RayCaster& caster) {
  for (int i = 0; i < caster.pipes(); ++i) {
    const Pipe& pipe = caster.pipe(i);
    const std::vector<Stage*>& stages = pipe.stages();
    report.stages.resize(stages.size());
    for (std::size_t s = 0; s < stages.size(); ++s) {
      const Account& account = stages[s]->account();
      if (account.total() != report.all_cycles)
        throw std::logic_error("the cycles of stage " + stages[s]->name() + " do not sum up");
      report.stages[s].name = stages[s]->name();
      add(report.stages[s].account, account);
      if (stages[s]->name() == "sample") report.sampled += account.busy;
    }
    const auto caches = pipe.caches();
    report.caches.resize(caches.size());
    for (std::size_t c = 0; c < caches.size(); ++c) {
      report.caches[c].name = caches[c].name;
      report.caches[c].line_bytes = caches[c].line_bytes;
      report.caches[c].counts.lookups += caches[c].counts.lookups;
      report.caches[c].counts.misses += caches[c].counts.misses;
    }
    report.rays += pipe.walked().rays;
    report.samples += pipe.walked().samples;
    report.leaps += pipe.walked().leaps;
  }
}

}  // namespace

bool PictureReport::found_where_planted() const {
  if (!strike) return false;
  const auto names = [&](const std::vector<std::string>& all, const std::string& stage) {
    return std::find(all.begin(), all.end(), stage) != all.end();
  };
  if (!difference) return names(waiting, strike->stage + " data") || names(jammed, strike->stage);
  return difference->stage == strike->stage && difference->x == strike->x && difference->y == strike->y &&
         difference->sample == strike->sample && difference->address == strike->address;
}

PictureRun::PictureRun(const Registers& registers, Memory& memory, const PictureOptions& options,
                       const std::optional<Shares>& shares)
    : registers_(registers),
      memory_(memory),
      options_(options),
      plan_(options.fault, 0, options.fault_channel.empty() ? kUsualChannel : options.fault_channel),
      caster_(registers, memory, options_.configuration,
              options.fault == Fault::none ? PipeMaker(make_pipe) : planted_pipes(plan_), shares) {
  caster_.poll(options.poll);
  caster_.when_ended([this](const FrameEnd& end) { end_pass(end); });
  if (!options.waves) return;
  waves_.emplace(caster_, "ray caster", options.waves_from);
  caster_.probe(&*waves_);
  caster_.each_cycle([this] { end_cycle(); });
}

void PictureRun::forget(const UploadReport& upload) {
  if (upload.whole) return caster_.forget_all();
  for (std::size_t i = 0; i < kSentVolumes; ++i) caster_.forget(i, upload.lines[i]);
}

void PictureRun::draw(const render::PictureScene& scene, const picture::Camera& camera,
                      render::Setting setting, const render::Image& expected) {
  begin(scene, camera, setting, expected);
  finish();
}

void PictureRun::begin(const render::PictureScene& scene, const picture::Camera& camera,
                       render::Setting setting, const render::Image& expected) {
  drawing_ = std::make_unique<Drawing>(scene, camera, setting, expected, registers_, caster_);
  caster_.watch(options_.compare ? drawing_->checker.watchers() : Watchers{});
  const Window first = drawing_->fast() ? options_.window : with_neighbours(options_.window);
  caster_.draw_only(first);
  drawing_->checker.begin_pass(1, 0, memory_.frame, first);
  if (waves_) {
    drawing_->checker.run_on_at_difference();
    waves_->begin_train(report_.all_cycles);
  }
  begun_ = std::clock();  // processor time, as the machine may have other work
  caster_.begin_first();
}

// This is called between two cycles.
void PictureRun::end_cycle() {
  waves_->end_cycle();
  if (!drawing_->checker.difference()) return;
  caster_.watch({});  // after a difference anything may follow
  if (!waves_->wants_more()) caster_.stop();
}

// This is called between two cycles.
void PictureRun::end_pass(const FrameEnd& end) {
  Drawing& drawing = *drawing_;
  if (options_.compare) drawing.checker.end_pass(end);
  report_.all_cycles += end.cycles;
  report_.passes.push_back({drawing.second, end.cycles});
  const std::int64_t before = drawing.second ? report_.end.cycles : 0;
  report_.end = end;
  report_.end.cycles += before;
  if (drawing.fast() || drawing.second || drawing.checker.difference() || !end.complete) return;
  drawing.second = true;
  caster_.draw_only(options_.window);
  drawing.checker.begin_pass(drawing.samples(), drawing.most(), drawing.second_frame(memory_),
                             options_.window);
  if (waves_) waves_->begin_train(report_.all_cycles);
  caster_.begin_again(drawing.samples(), drawing.most());
}

void PictureRun::finish() {
  caster_.run();
  caster_.watch({});
  const Checker& checker = drawing_->checker;
  report_.seconds += static_cast<double>(std::clock() - begun_) / CLOCKS_PER_SEC;
  report_.difference = checker.difference();
  report_.compared += checker.compared();
  report_.under_way = checker.ray_under_way();
  if (report_.end.hangs) tell_hang(report_, caster_);
  if (options_.compare && checker.compared() == 0) throw std::logic_error("lock-step compared nothing");

  const render::Image& expected = drawing_->expected;
  report_.image = image_of(memory_, drawing_->fast() ? memory_.frame : drawing_->second_frame(memory_),
                           expected.width, expected.height);
  const std::int64_t pixels = compare_bytes(report_, expected, options_.window);
  if (!options_.compare) report_.compared += pixels;
}

PictureReport PictureRun::report() {
  report_.strike = plan_.struck();
  if (waves_) waves_->end();
  if (waves_ && !waves_->empty()) report_.waves = waves_->vcd();
  report_.memory = caster_.memory_counts();
  report_.memory_bytes = memory_.bytes.size();
  report_.cost = cost_of(options_.configuration, registers_, memory_);
  take_accounts(report_, caster_);
  return report_;
}

}  // namespace voxmelt::hwmodel::raycast
