// A picture on a device (render/device): how long it takes there, beside a processor that makes it anew, too.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/gpu/state_on_device.h"
#include "kernel/scene/scene.h"

namespace voxmelt::measure {

class WatchedDevice;

struct DevicePictureTime {
  int width = 0, height = 0;
  double update = 0, draw = 0;  // seconds: what is drawn, and the drawing, until its bytes are here
  int launches = 0;
  std::uint64_t fetched = 0;  // bytes
  double processor = 0;       // seconds on a processor
  double seconds() const { return update + draw; }
};

// A state on a device. `again` brings it there once more, so that it counts as another one.
struct DrawnState {
  std::shared_ptr<WatchedDevice> device;
  std::function<gpu::StateOnDevice()> again;
  const state::Volume& volume;  // the same on the host
};

// Times the scene's own picture of that state, of so many rounds the shortest. There is none where the host
// draws it. Throws Mismatch if a byte differs.
std::optional<DevicePictureTime> time_picture(const DrawnState& state, const scene::Scene& scene, int threads,
                                              int rounds);

}  // namespace voxmelt::measure
