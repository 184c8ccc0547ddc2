// A device fails at any of the things that a picture asks of it. Then the host is told to draw, and each
// picture that was drawn is right.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>

#include "kernel/engine/gpu/stepper.h"
#include "render/device/picture_on_device.h"
#include "render/packet/picture.h"
#include "tests/kernel/engine/gpu/failing_device.h"
#include "tests/render/device/plain_kernels.h"
#include "tests/render/hostile_picture.h"
#include "tests/render/picture_pairs.h"

namespace voxmelt::render {
namespace {

// Glowing lumps on a ground, with more than one sample for some pixels.
test::HostilePicture some_picture() {
  for (std::uint64_t seed = 0;; ++seed) {
    test::HostilePicture picture = test::hostile_picture(seed, 2000);
    picture.look.clear = {};
    if (picture.setting != Setting::fast && !picture.terrain.height.empty() && picture.camera.width < 200)
      return picture;
  }
}

struct Outcome {
  int drawn = 0;
  std::shared_ptr<gpu::Device> device;
};

// Draws two states on a device that fails after so many of its jobs.
int drawn_before(int times, gpu::Failure how, const test::HostilePicture& picture, const Image& expected) {
  rule::Parameters parameters;
  parameters.heat.enabled = true;
  const std::shared_ptr<gpu::Device> good = gpu::plain_device(1, plain_picture_kernels());
  gpu::Stepper stepper(good, parameters, picture.volume.grid);
  const auto failing =
      std::make_shared<gpu::FailingDevice>(gpu::plain_device(1, plain_picture_kernels()), times, how);
  PictureOnDevice drawn;
  int count = 0;
  for (int state = 0; state < 2; ++state) {
    stepper.upload(picture.volume, {});
    gpu::StateOnDevice where = stepper.where();
    where.device = failing;
    if (!drawn.update(where, picture.look, picture.light, picture.terrain)) continue;
    const std::optional<Image> image = drawn.draw(picture.camera, picture.setting);
    if (!image) continue;
    EXPECT_EQ(test::difference(expected, *image), "") << "after " << times;
    ++count;
  }
  return count;
}

TEST(PictureOnDevice, IsTheHostsWhereTheDeviceFails) {
  const test::HostilePicture picture = some_picture();
  Picture host;
  host.update(picture.volume, picture.look, picture.light, picture.terrain, 1);
  const Image expected = host.draw(picture.camera, picture.setting, 1);
  int drawn[3] = {0, 0, 0};
  for (int times = 0; drawn[2] == 0; ++times)
    ++drawn[drawn_before(times, times % 2 == 0 ? gpu::Failure::refuses : gpu::Failure::is_lost, picture,
                         expected)];
  EXPECT_GT(drawn[0], 40);
  EXPECT_GT(drawn[1], 20);
}

TEST(PictureOnDevice, IsTheHostsWhereTheDeviceHasNoStateOrDoesNotKnowTheLook) {
  test::HostilePicture picture = some_picture();
  rule::Parameters parameters;
  gpu::Stepper stepper(gpu::plain_device(1, plain_picture_kernels()), parameters, picture.volume.grid);
  stepper.upload(picture.volume, {});
  PictureOnDevice drawn;
  const auto draws = [&](const std::optional<gpu::StateOnDevice>& state) {
    return drawn.update(state, picture.look, picture.light, picture.terrain);
  };
  picture.look.glow = false;
  EXPECT_TRUE(draws(stepper.where()));
  EXPECT_FALSE(draws(std::nullopt));
  picture.look.glow = true;
  EXPECT_FALSE(draws(stepper.where())) << "the device has no heat";
  picture.look.glow = false;
  gpu::StateOnDevice full = stepper.where();
  full.taken = full.device->memory();
  PictureOnDevice other;
  EXPECT_FALSE(other.update(full, picture.look, picture.light, picture.terrain)) << "there is no room";
  EXPECT_TRUE(draws(stepper.where()));
}

}  // namespace
}  // namespace voxmelt::render
