#include "measure/device_picture.h"

#include "measure/clocks.h"
#include "measure/measure.h"
#include "measure/watched_device.h"
#include "render/device/device_picture.h"
#include "render/packet/picture.h"

namespace voxmelt::measure {
namespace {

using render::Setting;

double on_a_processor(const DrawnState& state, const scene::Scene& scene, int threads, render::Image& image) {
  return seconds_for(Clock::wall, [&] {
    render::Picture picture;
    picture.update(state.volume, scene.look, scene.light, scene.terrain, threads);
    image = picture.draw(scene.camera, Setting::normal, threads);
  });
}

}  // namespace

std::optional<DevicePictureTime> time_picture(const DrawnState& state, const scene::Scene& scene, int threads,
                                              int rounds) {
  if (!render::device_draws(state.again(), scene.look)) return std::nullopt;
  DevicePictureTime time{.width = scene.camera.width, .height = scene.camera.height};
  render::DevicePicture drawn(std::make_shared<render::PictureKernels>(state.device, state.again().shape));
  Least update, draw, processor;
  for (int round = 0; round <= rounds; ++round) {  // the first one makes what is kept
    const gpu::StateOnDevice there = state.again();
    state.device->forget();
    render::Image found, expected;
    const double updated = seconds_for(Clock::wall, [&] {
      drawn.update(there, scene.look, scene.light, scene.terrain);
      state.device->wait();
    });
    const double drew = seconds_for(Clock::wall, [&] { found = drawn.draw(scene.camera, Setting::normal); });
    time.fetched = state.device->fetched();
    time.launches = state.device->launches();
    processor.add(on_a_processor(state, scene, threads, expected));
    if (!(found == expected)) throw Mismatch("the device's picture of " + scene.name + " is not the host's");
    if (round == 0) continue;
    update.add(updated);
    draw.add(drew);
  }
  time.update = update.value();
  time.draw = draw.value();
  time.processor = processor.value();
  return time;
}

}  // namespace voxmelt::measure
