#include "hwmodel/machine/screen.h"

#include <cstdint>
#include <ctime>
#include <vector>

#include "render/packet/scene_in_integers.h"

namespace voxmelt::hwmodel {

Screen::Screen(const raycast::PictureInput& input, const raycast::PictureOptions& options)
    : input_(input),
      options_(options),
      camera_(render::camera_in_integers(input.camera)),
      uploader_(options.configuration) {
  take_over(input.volume);
  raycast::PictureOptions bytes_alone = options_;
  bytes_alone.compare = false;
  bytes_alone.fault = raycast::Fault::none;
  bytes_alone.configuration.memory_trace.clear();
  bytes_alone.configuration.command_trace.clear();
  alone_.emplace(uploader_.registers(), uploader_.memory(), bytes_alone);
}

void Screen::connect(const raycast::Shares& shares) {
  beside_.emplace(uploader_.registers(), uploader_.memory(), options_, shares);
}

const raycast::UploadReport& Screen::take_over(const state::Volume& volume) {
  const bool first = !alone_;
  const std::clock_t begin = std::clock();  // processor time, as the machine may have other work
  field_.update(volume, input_.look, input_.terrain, 1);
  const std::vector<std::uint32_t>* changed = first ? nullptr : &field_.refreshed();
  software_.update(field_, input_.look, input_.light, input_.terrain, changed, 1);
  upload_ = uploader_.update(software_.data(camera_, input_.setting), changed);
  host_seconds_ = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;

  scene_.emplace(field_, input_.look, input_.light, input_.terrain);
  expected_ = software_.draw(input_.camera, input_.setting, 1);
  if (!first) {
    beside_->forget(upload_);
    alone_->forget(upload_);
  }
  upload_.bricks.clear();
  for (auto& lines : upload_.lines) lines.clear();
  return upload_;
}

void Screen::begin() {
  beside_->begin(*scene_, camera_, input_.setting, expected_);
  draws_ = true;
}

void Screen::finish() {
  if (!draws_) return;
  draws_ = false;
  beside_->finish();
  good_ = good_ && beside_->good();
}

void Screen::draw_alone() {
  alone_->draw(*scene_, camera_, input_.setting, expected_);
  good_ = good_ && alone_->good();
}

}  // namespace voxmelt::hwmodel
