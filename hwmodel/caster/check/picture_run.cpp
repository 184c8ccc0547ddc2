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

// The picture that lies in memory, tile by tile.
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

// The second pass compares a pixel with those beside it.
Window with_neighbours(const Window& of) { return {of.left - 1, of.top - 1, of.right + 1, of.bottom + 1}; }

// Tells how many pixels it compared.
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
  sum.busy += more.busy, sum.starved += more.starved, sum.blocked += more.blocked;
  sum.memory += more.memory, sum.fill += more.fill, sum.drain += more.drain;
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
  const auto names = [&](const std::vector<std::string>& of, const std::string& stage) {
    return std::find(of.begin(), of.end(), stage) != of.end();
  };
  if (!difference) return names(waiting, strike->stage + " data") || names(jammed, strike->stage);
  return difference->stage == strike->stage && difference->x == strike->x && difference->y == strike->y &&
         difference->sample == strike->sample && difference->address == strike->address;
}

PictureRun::PictureRun(const Registers& registers, Memory& memory, const PictureOptions& options)
    : registers_(registers),
      memory_(memory),
      options_(options),
      plan_(options.fault, options.fault_channel),
      caster_(registers, memory, options_.configuration,
              options.fault == Fault::none ? PipeMaker(make_pipe) : planted_pipes(plan_)) {
  caster_.poll(options.poll);
}

void PictureRun::forget(const UploadReport& upload) {
  if (upload.whole) return caster_.forget_all();
  for (std::size_t i = 0; i < kSentVolumes; ++i) caster_.forget(i, upload.lines[i]);
}

void PictureRun::draw(const render::PictureScene& scene, const picture::Camera& camera,
                      render::Setting setting, const render::Image& expected) {
  const bool fast = setting == render::Setting::fast;
  const int samples = fast ? 1 : setting == render::Setting::normal ? 8 : 32;
  const int most = setting == render::Setting::best ? 8 : 16;
  const int width = expected.width, height = expected.height;
  const std::int64_t second_frame = memory_.frame + frame_bytes(width, height);
  const Expectation expectation(scene, camera, setting);
  Checker checker(expectation, caster_, width, height);
  caster_.watch(options_.compare ? checker.watchers() : Watchers{});

  const std::clock_t begin = std::clock();  // of the processor: the machine may have other work
  const Window first = fast ? options_.window : with_neighbours(options_.window);
  caster_.draw_only(first);
  checker.begin_pass(1, 0, memory_.frame, first);
  report_.end = caster_.draw_first();
  if (options_.compare) checker.end_pass(report_.end);
  report_.all_cycles += report_.end.cycles;
  report_.passes.push_back({false, report_.end.cycles});
  if (!fast && !checker.difference() && report_.end.complete) {
    caster_.draw_only(options_.window);
    checker.begin_pass(samples, most, second_frame, options_.window);
    const FrameEnd second = caster_.draw_again(samples, most);
    report_.all_cycles += second.cycles;
    report_.passes.push_back({true, second.cycles});
    if (options_.compare) checker.end_pass(second);
    const std::int64_t first_cycles = report_.end.cycles;
    report_.end = second;
    report_.end.cycles += first_cycles;
  }
  caster_.watch({});
  report_.seconds += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  report_.difference = checker.difference();
  report_.compared += checker.compared();
  report_.under_way = checker.ray_under_way();
  if (report_.end.hangs) tell_hang(report_, caster_);
  if (options_.compare && checker.compared() == 0) throw std::logic_error("lock-step compared nothing");

  report_.image = image_of(memory_, fast ? memory_.frame : second_frame, width, height);
  const std::int64_t pixels = compare_bytes(report_, expected, options_.window);
  if (!options_.compare) report_.compared += pixels;
}

PictureReport PictureRun::report() {
  report_.strike = plan_.struck();
  report_.memory = caster_.memory_counts();
  report_.memory_bytes = static_cast<std::int64_t>(memory_.bytes.size());
  report_.cost = cost_of(options_.configuration, registers_, memory_);
  take_accounts(report_, caster_);
  return report_;
}

}  // namespace voxmelt::hwmodel::raycast
