// The field that is drawn, made on a device from the state that lies there (docs/picture/field.md). It has
// the numbers of DensityField, and no cell goes over the bus.
//
// All of it is made anew each time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/automaton/state/grid.h"
#include "kernel/engine/gpu/state_on_device.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/device/kernels.h"

namespace voxmelt::render {

class DeviceField {
 public:
  // The kernels are those of the state's device.
  explicit DeviceField(std::shared_ptr<const PictureKernels> kernels) : kernels_(std::move(kernels)) {}

  // Makes the field of a state. It throws gpu::DeviceError where the device has no room beside the state.
  void update(const gpu::StateOnDevice& state, const scene::Look& look, const scene::Terrain& terrain);

  // These fetch it, cell by cell, [z][y][x]: intensity, solid, liquid, obstacle, and heat or tone.
  static constexpr int kChannels = 5;
  std::vector<std::uint16_t> fetch(int channel) const;
  std::vector<std::int32_t> fetch_ground() const;   // 1/4096 cell, by column
  std::vector<std::int32_t> fetch_wetness() const;  // 0..4096
  // Returns the largest amount of liquid that has nothing solid or inert above it, if that is more than two
  // cells, or 0.
  std::int32_t fetch_pressed() const;

  // These are for kernels that go on from the field: all channels, the numbers of its lattice (P), and memory
  // of the lattice's size that nobody needs until the next update. `room` has four bytes a place, and the
  // others two.
  const gpu::Memory* channels() const { return now_.get(); }
  const gpu::Memory* lattice() const { return shape_.get(); }
  const gpu::Memory* room() const { return next_.get(); }
  const gpu::Memory* small_room() const { return as_solid_.get(); }
  const gpu::Memory* other_small_room() const { return as_liquid_.get(); }
  int passes() const { return passes_; }  // of the liquid's filter

 private:
  using Buffer = std::unique_ptr<gpu::Memory>;

  void resize(const gpu::StateOnDevice& state, int channels);
  void find_columns(const gpu::StateOnDevice& state, const scene::Terrain& terrain, int passes);
  void filter(const gpu::StateOnDevice& state, int liquid_passes, int solid_passes);
  std::vector<std::int32_t> fetch_columns(int kinds) const;  // the first ones
  std::size_t places() const;
  std::size_t columns_of_all() const {
    return static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.z);
  }

  std::shared_ptr<const PictureKernels> kernels_;
  state::Grid grid_{0, 0, 0};
  int channels_ = 0, passes_ = 0;
  Buffer now_, next_;            // all channels, in the lattice of program/lattice.cl
  Buffer as_solid_, as_liquid_;  // the intensity by the solid's passes, and by the liquid's
  Buffer shape_, pressed_, columns_, levels_, next_levels_, heights_, tones_;
  std::vector<std::int32_t> known_heights_;  // of the terrain, as the device has them
};

}  // namespace voxmelt::render
