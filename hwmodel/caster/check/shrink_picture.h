// The shrinker makes a failing picture smaller while it still fails: fewer pixels, a plainer machine, a part
// of the grid, less matter. The remaining scene shows the failure.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/check/shrink/shrink_volume.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel::raycast {

struct PictureCase {
  state::Volume volume;
  std::array<int, 3> from{};  // place in the grid of the scene; the camera stays where it was
  Window window;              // part of the picture; it ends where the picture ends
  render::Setting setting = render::Setting::normal;
  Configuration configuration;
  std::vector<std::string> without;  // "terrain", if this one lacks the scene's

  std::int64_t pixels() const {
    return std::int64_t{window.right - window.left} * std::int64_t{window.bottom - window.top};
  }
};

class PictureShrinker : public check::VolumeShrinker<PictureCase> {
 public:
  using VolumeShrinker::VolumeShrinker;

  // `near` is the cell of the first difference, if it is known.
  const PictureCase& shrink(const std::optional<std::array<int, 3>>& near);

 private:
  void shrink_window();
  void shrink_machine();
};

struct PictureShrinkRequest {
  std::filesystem::path fields;  // the folder of the scene's fields; another beside it is used meanwhile
  double seconds = 45;           // time that the search may take
  const scene::Scene& scene;     // only its file is used
  std::vector<std::string> overrides;  // overrides for the scene
  const PictureInput& input;           // the failed picture
  const PictureOptions& options;
};

struct SmallPicture {
  PictureCase small;
  int cells = 0;      // cells that hold something
  int tried = 0;      // pictures that were tried
  std::string stage;  // stage that differs; empty if it hangs, or if only bytes differ
  std::string text;   // the scene file, which takes its fields from `fields`
};

// Returns nothing if the difference is not seen again in a scene of its own.
std::optional<SmallPicture> shrink_to_scene(const PictureShrinkRequest& request, const PictureReport& report);

}  // namespace voxmelt::hwmodel::raycast
