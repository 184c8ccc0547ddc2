// The picture's side of the whole machine: the host takes over a state and sends what changed, and the ray
// caster draws it, once alone and once while the pipeline uses the same memory.
#pragma once

#include <cstdint>
#include <optional>

#include "hwmodel/caster/check/picture_run.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/machine/stream_twin.h"
#include "kernel/automaton/state/volume.h"
#include "render/density/density_field.h"
#include "render/image/image.h"
#include "render/packet/picture.h"
#include "render/reference/picture_scene.h"
#include "render/rule/camera.h"

namespace voxmelt::hwmodel {

class Screen {
 public:
  // Draws as `input` says, whatever its volume is.
  Screen(const raycast::PictureInput& input, const raycast::PictureOptions& options);

  // The first state is sent whole, of later ones what changed. The upload is without its lists.
  raycast::UploadReport take_over(const state::Volume& volume);
  // Draws the state that was taken over last; checked.
  void draw();
  // Draws it again, by a ray caster that shares the memory with the pipeline; its bytes are checked.
  // Ends when both are done.
  void draw_beside(const StreamWork& work);

  bool good() const { return good_; }
  double host_seconds() const { return host_seconds_; }  // of the last state: field, light, comparing lines
  const raycast::PictureRun& alone() const { return *alone_; }
  const raycast::PictureRun& beside() const { return *beside_; }
  const StreamTwin& twin() const { return twin_; }
  raycast::PictureReport report() { return alone_->report(); }
  std::int64_t different_beside();  // pixels
  const raycast::Memory& memory() { return uploader_.memory(); }

 private:
  raycast::PictureInput input_;
  raycast::PictureOptions options_;
  picture::Camera camera_;
  render::DensityField field_;
  render::Picture software_;
  std::optional<render::PictureScene> scene_;
  render::Image expected_;
  raycast::Uploader uploader_;
  std::optional<raycast::PictureRun> alone_, beside_;
  StreamTwin twin_;  // of the pipeline, on the memory of `beside_`
  bool good_ = true;
  double host_seconds_ = 0;
};

}  // namespace voxmelt::hwmodel
