// The screen is the picture's side of the whole machine. The host takes over a state and sends what changed.
// The ray caster draws it, beside whatever else the simulation does.
#pragma once

#include <optional>

#include "hwmodel/caster/check/picture_run.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/caster/host/uploader.h"
#include "kernel/automaton/state/volume.h"
#include "render/density/density_field.h"
#include "render/image/image.h"
#include "render/packet/picture.h"
#include "render/reference/picture_scene.h"
#include "render/rule/camera.h"

namespace voxmelt::hwmodel {

class Screen {
 public:
  // Draws as `input` says, and begins with its volume, which is sent whole.
  Screen(const raycast::PictureInput& input, const raycast::PictureOptions& options);

  // Gives the machine's own ray caster what it shares with the pipeline.
  void connect(const raycast::Shares& shares);

  // Takes over the next state and sends what changed. The lists of the returned upload are empty.
  const raycast::UploadReport& take_over(const state::Volume& volume);
  const raycast::UploadReport& upload() const { return upload_; }  // last upload

  // Draws the state that was taken over last, and checks the picture. `begin` starts in the next cycle, and
  // `finish` draws the rest.
  void begin();
  void finish();
  // Draws the same with a ray caster that has a memory of its own. The bytes of its picture are checked.
  void draw_alone();

  bool good() const { return good_; }
  double host_seconds() const { return host_seconds_; }  // last state: field, light, comparing lines
  const raycast::PictureRun& beside() const { return *beside_; }
  const raycast::PictureRun& alone() const { return *alone_; }
  raycast::PictureReport report() { return beside_->report(); }

 private:
  raycast::PictureInput input_;
  raycast::PictureOptions options_;
  picture::Camera camera_;
  render::DensityField field_;
  render::Picture software_;
  std::optional<render::PictureScene> scene_;
  render::Image expected_;
  raycast::Uploader uploader_;
  raycast::UploadReport upload_;
  std::optional<raycast::PictureRun> beside_, alone_;
  bool good_ = true, draws_ = false;
  double host_seconds_ = 0;
};

}  // namespace voxmelt::hwmodel
