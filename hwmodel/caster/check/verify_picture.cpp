#include "hwmodel/caster/check/verify_picture.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"

namespace voxmelt::hwmodel::raycast {

PictureReport verify_picture(const PictureInput& input, const PictureOptions& options) {
  render::DensityField field;
  field.update(input.volume, input.look, input.terrain, 1);
  const render::PictureScene scene(field, input.look, input.light, input.terrain);
  render::Picture software;
  software.update(field, input.look, input.light, input.terrain, nullptr, 1);
  const picture::Camera camera = render::camera_in_integers(input.camera);
  const render::PictureData data = software.data(camera, input.setting);
  const render::Image expected = software.draw(input.camera, input.setting, 1);

  Uploader uploader(options.configuration);
  std::vector<UploadReport> uploads{uploader.update(data, nullptr)};
  PictureRun run(uploader.registers(), uploader.memory(), options);
  for (int frame = 0; frame < options.frames; ++frame) {
    if (frame > 0) {
      const std::vector<std::uint32_t> none;  // the same picture again
      uploads.push_back(uploader.update(data, &none));
      run.forget(uploads.back());
    }
    uploads.back().bricks.clear();
    for (auto& lines : uploads.back().lines) lines.clear();
    run.draw(scene, camera, input.setting, expected);
    if (!run.good()) break;
  }
  PictureReport report = run.report();
  report.uploads = std::move(uploads);
  return report;
}

}  // namespace voxmelt::hwmodel::raycast
