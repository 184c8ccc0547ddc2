// A picture that is drawn on a device, from the state that lies there (docs/picture/definition.md). It has
// the bytes of Picture, and only they go over the bus, with a number for each column of the ground.
//
// All of it is made anew for each state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/engine/gpu/state_on_device.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/device/device_field.h"
#include "render/device/kernels.h"
#include "render/device/picture_numbers.h"
#include "render/ground/ground_map.h"
#include "render/image/image.h"
#include "render/light/light_bytes.h"
#include "render/packet/draw_picture.h"
#include "render/rule/look.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

// Tells if a device draws such a look. A glow is the host's where the device has no
// heat.
bool device_draws(const gpu::StateOnDevice& state, const scene::Look& look);

// Every function may throw gpu::DeviceError. Then the host can draw the state.
class DevicePicture {
 public:
  // The kernels are those of the states' device.
  explicit DevicePicture(std::shared_ptr<const PictureKernels> kernels)
      : kernels_(std::move(kernels)), field_(kernels_) {}

  // Takes over a state, with a look that device_draws().
  void update(const gpu::StateOnDevice& state, const scene::Look& look, const scene::Light& light,
              const scene::Terrain& terrain);
  // Draws the state of the last update, also after the device has gone on.
  Image draw(const scene::Camera& camera, Setting setting);

  std::int32_t fetch_pressed() const { return field_.fetch_pressed(); }  // of the last update
  // Fetches the bytes of cells of light, as LightVolume has them.
  std::vector<LightBytes> fetch_light() const;

 private:
  using Buffer = std::unique_ptr<gpu::Memory>;

  void find_ground(const scene::Look& look, const scene::Terrain& terrain, bool same);
  void find_levels();
  void find_light();
  void run(PictureKernel kernel, std::initializer_list<gpu::Argument> arguments) const {
    kernels_->run(kernel, groups_, arguments);
  }
  template <class Number>
  void write(Buffer& to, std::vector<Number> numbers);
  void make_room(Buffer& buffer, std::size_t& has, std::size_t wanted);

  std::shared_ptr<const PictureKernels> kernels_;
  DeviceField field_;
  int groups_ = 1;
  scene::Look scene_look_;
  scene::Light scene_light_;
  std::optional<scene::Terrain> terrain_;  // of the last update, which was of this version
  std::uint64_t version_ = 0;
  state::Grid grid_{0, 0, 0};
  picture::Look look_;
  picture::Paint paint_;
  GroundMap ground_;
  LampSweep lamp_;
  ViewNumbers numbers_ = ViewNumbers(kViewNumbers);
  Buffer view_, paint_numbers_, ground_numbers_, texels_;
  Buffer blocks_, next_blocks_;
  Buffer light_matter_, light_, along_, rays_, left_rays_, soft_rays_;
  Buffer image_, list_, count_;
  std::size_t light_room_ = 0, ray_room_ = 0, image_room_ = 0, list_room_ = 0;
};

}  // namespace voxmelt::render
