#include "hwmodel/picture/verify_picture.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <stdexcept>

#include "hwmodel/caster_faults/planted_pipe.h"
#include "hwmodel/picture/expectation.h"
#include "hwmodel/picture/upload.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"

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

void tell_hang(PictureReport& report, const RayCaster& caster) {
  std::string text, waiting;
  for (int i = 0; i < caster.pipes(); ++i)
    for (const Pipe::ChannelState& channel : caster.pipe(i).channels())
      if (channel.count > 0)
        text += "  pipe " + std::to_string(i) + ": " + channel.name + ": " + std::to_string(channel.count) +
                " of " + std::to_string(channel.depth) + "\n";
  for (int i = 0; i < caster.pipes(); ++i)
    for (const Stage* stage : caster.pipe(i).stages()) {
      if (!stage->waits_for_memory()) continue;
      report.waiting.push_back(stage->name());
      waiting += "  pipe " + std::to_string(i) + ": " + stage->name() + "\n";
    }
  report.hang = "nothing moves any more; channels that hold tokens:\n" + text +
                "stages that wait for the memory:\n" + waiting;
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
  if (!difference) return std::find(waiting.begin(), waiting.end(), strike->stage + " data") != waiting.end();
  return difference->stage == strike->stage && difference->x == strike->x && difference->y == strike->y &&
         difference->sample == strike->sample;
}

PictureReport verify_picture(const PictureInput& input, const PictureOptions& options) {
  const bool fast = input.setting == render::Setting::fast;
  render::DensityField field;
  field.update(input.volume, input.look, input.terrain, 1);
  const render::PictureScene scene(field, input.look, input.light, input.terrain);
  render::Picture software;
  software.update(field, input.look, input.light, input.terrain, nullptr, 1);
  const picture::Camera camera = render::camera_in_integers(input.camera);
  const render::PictureData data = software.data(camera, input.setting);
  const render::Image expected = software.draw(input.camera, input.setting, 1);

  const Configuration& c = options.configuration;
  const Registers registers = registers_of(data);
  Memory memory = memory_of(data, c);
  const Expectation expectation(scene, camera, input.setting);
  FaultPlan plan(options.fault);
  RayCaster caster(registers, memory, c,
                   options.fault == Fault::none ? PipeMaker(make_pipe) : planted_pipes(plan));
  caster.poll(options.poll);
  caster.predict(options.predict);
  Checker checker(expectation, caster, data.width, data.height);
  if (options.compare) caster.watch(checker.watchers());

  PictureReport report;
  const int samples = fast ? 1 : input.setting == render::Setting::normal ? 8 : 32;
  const int most = input.setting == render::Setting::best ? 8 : 16;
  const std::clock_t begin = std::clock();  // of the processor: the machine may have other work
  for (int frame = 0; frame < options.frames && !checker.difference(); ++frame) {
    checker.begin_pass(1, 0, memory.frame);
    report.end = caster.draw_first();
    report.all_cycles += report.end.cycles;
    report.passes.push_back({false, report.end.cycles, report.end.predicted});
    if (fast || checker.difference() || !report.end.complete) continue;
    checker.begin_pass(samples, most, memory.frame + frame_bytes(data.width, data.height));
    const FrameEnd second = caster.draw_again(samples, most);
    report.all_cycles += second.cycles;
    report.passes.push_back({true, second.cycles, second.predicted});
    report.end = {report.end.cycles + second.cycles, -1, second.complete, second.hangs};
  }
  report.seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  report.difference = checker.difference();
  report.compared = checker.compared();
  if (report.end.hangs) tell_hang(report, caster);
  report.strike = plan.struck();
  if (options.compare && report.compared == 0) throw std::logic_error("lock-step compared nothing");

  report.image = image_of(memory, memory.frame + (fast ? 0 : frame_bytes(data.width, data.height)),
                          data.width, data.height);
  for (int y = 0; y < data.height; ++y)
    for (int x = 0; x < data.width; ++x)
      if (report.image.at(x, y) != expected.at(x, y)) ++report.different_bytes;
  report.memory = caster.memory_counts();
  report.memory_bytes = static_cast<std::int64_t>(memory.bytes.size());
  take_accounts(report, caster);
  return report;
}

}  // namespace voxmelt::hwmodel::raycast
