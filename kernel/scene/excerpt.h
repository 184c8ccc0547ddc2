// An excerpt is a part of a scene as a file of its own, that needs no other scene. Its grid is smaller, and
// its state comes from fields. An excerpt to be run has the rules, and the sources, vents and drains, moved.
// One to be drawn has the rules, the camera, moved, and the look.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/scene/text/document.h"

namespace voxmelt::scene {

struct Part {
  std::array<int, 3> from{}, size{};  // cells of the scene's grid
  std::vector<std::string> without;   // names from Excerpt::removable
};

class Excerpt {
 public:
  // Reads the scene as `load` does, with these overrides. It throws InputError.
  Excerpt(const std::filesystem::path& file, const std::vector<std::string>& overrides);

  // Lists what a part may go without: "vent.0", "heat_source.1", "grid.border", "heat.air".
  std::vector<std::string> removable() const;

  // Returns the text of a part to be run. `fields` is the folder of the state, beside the file. `step` is the
  // number of its first step.
  std::string text(const Part& part, const std::string& fields, std::uint32_t step) const;
  // Returns the text of a part to be drawn. `camera` is the scene's. Only the terrain stays of the shapes,
  // because the drawing of the ground depends on it. The part may go without "terrain".
  std::string picture_text(const Part& part, const std::string& fields, const Camera& camera) const;

 private:
  Value document_;
};

}  // namespace voxmelt::scene
