#include "render/device/picture_on_device.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "render/device/device_picture.h"
#include "render/device/kernels.h"

namespace voxmelt::render {

PictureOnDevice::PictureOnDevice() = default;
PictureOnDevice::~PictureOnDevice() = default;

// The driver of a lost device may still write where the picture wanted it to, so that one never ends.
template <class Work>
bool PictureOnDevice::tried(const Work& work) {
  try {
    work();
    return true;
  } catch (const step::DeviceLost&) {
    static auto& lost = *new std::vector<std::unique_ptr<DevicePicture>>;
    lost.push_back(std::move(picture_));
  } catch (const gpu::DeviceError&) {
    picture_.reset();
  }
  refused_ = true;
  return false;
}

bool PictureOnDevice::update(const std::optional<gpu::StateOnDevice>& state, const scene::Look& look,
                             const scene::Light& light, const scene::Terrain& terrain) {
  if (!state || !device_draws(*state, look)) return false;
  if (device_ != state->device || !(grid_ == state->shape->grid)) {
    picture_.reset();
    device_ = state->device;
    grid_ = state->shape->grid;
    refused_ = false;
  }
  if (refused_) return false;
  return tried([&] {
    if (!picture_)
      picture_ = std::make_unique<DevicePicture>(std::make_shared<PictureKernels>(device_, state->shape));
    picture_->update(*state, look, light, terrain);
  });
}

std::optional<std::int32_t> PictureOnDevice::pressed() {
  std::int32_t most = 0;
  if (!picture_ || !tried([&] { most = picture_->fetch_pressed(); })) return std::nullopt;
  return most;
}

std::optional<Image> PictureOnDevice::draw(const scene::Camera& camera, Setting setting) {
  Image image;
  if (!picture_ || !tried([&] { image = picture_->draw(camera, setting); })) return std::nullopt;
  return image;
}

}  // namespace voxmelt::render
