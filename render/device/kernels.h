// The picture's kernels on a device (program/), which is one of OpenCL, or in the tests the same kernels as
// C++.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/engine/gpu/device.h"
#include "kernel/engine/gpu/shape.h"

namespace voxmelt::render {

enum class PictureKernel {
  find_columns,
  begin_levels,
  smooth_levels,
  put_matter,
  fill_columns,
  fill_rim,
  filter_axis,
  keep_intensity,
  mix_intensity,
  prefilter_x,
  prefilter_y,
  make_levels,
  find_shares,
  find_blocks,
  spread_blocks,
  find_density,
  sweep_u,
  sweep_v,
  begin_lamp,
  pass_lamp,
  soften_lamp,
  draw_middles,
  find_differing,
  refine
};
inline constexpr const char* kPictureKernelNames[] = {
    "find_columns", "begin_levels",   "smooth_levels", "put_matter",   "fill_columns",   "fill_rim",
    "filter_axis",  "keep_intensity", "mix_intensity", "prefilter_x",  "prefilter_y",    "make_levels",
    "find_shares",  "find_blocks",    "spread_blocks", "find_density", "sweep_u",        "sweep_v",
    "begin_lamp",   "pass_lamp",      "soften_lamp",   "draw_middles", "find_differing", "refine"};

// The kernels, built for a device. Every function may throw gpu::DeviceError.
class PictureKernels {
 public:
  // They are for states of this shape alone, or for any.
  explicit PictureKernels(std::shared_ptr<gpu::Device> device, const gpu::Shape* shape = nullptr);

  gpu::Device& device() const { return *device_; }
  void run(PictureKernel kernel, int groups, std::initializer_list<gpu::Argument> arguments) const {
    device_->run(*kernels_, static_cast<std::size_t>(kernel), groups, arguments);
  }
  template <class Number>
  void write(gpu::Memory& to, std::vector<Number> numbers) const {
    const auto held = std::make_shared<std::vector<Number>>(std::move(numbers));
    in_flight_ = held;
    device_->write(to, held->data(), sizeof(Number) * held->size());
    in_flight_.reset();
  }
  template <class Number>
  std::vector<Number> read(const gpu::Memory& from, std::size_t count) const {
    const auto held = std::make_shared<std::vector<Number>>(count);
    in_flight_ = held;
    device_->read(from, held->data(), sizeof(Number) * count);
    in_flight_.reset();
    return std::move(*held);
  }

 private:
  std::shared_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::OtherKernels> kernels_;
  // Holds what is being sent or fetched. A device that is lost may still write there, so it lives as long as
  // we do.
  mutable std::shared_ptr<void> in_flight_;
};

}  // namespace voxmelt::render
