// A picture is drawn where its state lies. The host draws what a device cannot.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "kernel/automaton/state/grid.h"
#include "kernel/engine/gpu/state_on_device.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/image/image.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::render {

class DevicePicture;

class PictureOnDevice {
 public:
  PictureOnDevice();
  ~PictureOnDevice();
  PictureOnDevice(const PictureOnDevice&) = delete;
  PictureOnDevice& operator=(const PictureOnDevice&) = delete;

  // Takes over a state, and tells if pictures of it can be drawn here. If not, the host must draw them: the
  // device does not have the state, does not know the look, or has no room. A device that has refused once is
  // not asked again.
  bool update(const std::optional<gpu::StateOnDevice>& state, const scene::Look& look,
              const scene::Light& light, const scene::Terrain& terrain);

  // Draws the state of the last update, which was told to be drawn here. There is no picture if the device
  // fails.
  std::optional<Image> draw(const scene::Camera& camera, Setting setting);

  // Returns DeviceField::fetch_pressed() of that state, or nothing if the device fails.
  std::optional<std::int32_t> pressed();

 private:
  template <class Work>
  bool tried(const Work& work);

  std::shared_ptr<gpu::Device> device_;  // that has drawn, or refused
  state::Grid grid_{0, 0, 0};            // for which its kernels were built
  std::unique_ptr<DevicePicture> picture_;
  bool refused_ = false;
};

}  // namespace voxmelt::render
