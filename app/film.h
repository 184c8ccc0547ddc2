// The frames of a run, and what is made of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/image/image.h"

namespace voxmelt::app {

// Sets the camera's size from "640x480"; throws UsageError.
void set_size(scene::Camera& camera, const std::string& size);

class Film {
 public:
  // Frames go to folder/frames/frame_00000.png, ...
  Film(const scene::Scene& scene, std::filesystem::path folder, int threads);

  void add_frame(const state::Volume& volume, std::uint32_t step);

  // Writes contact_sheet.png and film.mp4; returns why there is no film, or nothing.
  std::string finish();

  std::size_t frame_count() const { return labels_.size(); }
  double update_seconds() const { return update_seconds_; }
  double render_seconds() const { return render_seconds_; }

 private:
  std::filesystem::path frame_file(std::size_t frame) const;

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  int threads_;
  render::DensityField field_;
  std::vector<std::string> labels_;
  double update_seconds_ = 0, render_seconds_ = 0;
};

}  // namespace voxmelt::app
