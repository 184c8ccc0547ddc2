#include "hwmodel/machine/screen.h"

#include <ctime>
#include <vector>

#include "render/packet/scene_in_integers.h"

namespace voxmelt::hwmodel {

Screen::Screen(const raycast::PictureInput& input, const raycast::PictureOptions& options)
    : input_(input),
      options_(options),
      camera_(render::camera_in_integers(input.camera)),
      uploader_(options.configuration),
      twin_(options.configuration.dram ? 0 : options.configuration.latency) {}

raycast::UploadReport Screen::take_over(const state::Volume& volume) {
  const bool first = !alone_;
  const std::clock_t begin = std::clock();  // of the processor: the machine may have other work
  field_.update(volume, input_.look, input_.terrain, 1);
  const std::vector<std::uint32_t>* changed = first ? nullptr : &field_.refreshed();
  software_.update(field_, input_.look, input_.light, input_.terrain, changed, 1);
  raycast::UploadReport upload = uploader_.update(software_.data(camera_, input_.setting), changed);
  host_seconds_ = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;

  scene_.emplace(field_, input_.look, input_.light, input_.terrain);
  expected_ = software_.draw(input_.camera, input_.setting, 1);
  if (first) {
    raycast::PictureOptions bytes_alone = options_;
    bytes_alone.compare = false;
    bytes_alone.configuration.memory_trace.clear();
    alone_.emplace(uploader_.registers(), uploader_.memory(), options_);
    beside_.emplace(uploader_.registers(), uploader_.memory(), bytes_alone);
    beside_->draw(*scene_, camera_, input_.setting, expected_);  // its caches are as warm as the other ones
  } else {
    alone_->forget(upload);
    beside_->forget(upload);
  }
  upload.bricks.clear();
  for (auto& lines : upload.lines) lines.clear();
  return upload;
}

void Screen::draw() {
  alone_->draw(*scene_, camera_, input_.setting, expected_);
  good_ = good_ && alone_->good();
}

void Screen::draw_beside(const StreamWork& work) {
  twin_.begin(work);
  beside_->share(&twin_);
  beside_->draw(*scene_, camera_, input_.setting, expected_);
  beside_->wait_for_neighbour();
  beside_->share(nullptr);
  good_ = good_ && beside_->good();
}

std::int64_t Screen::different_beside() { return beside_->report().different_bytes; }

}  // namespace voxmelt::hwmodel
