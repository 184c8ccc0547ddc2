// A part of a scene as a file of its own, that needs no other scene. Its grid is smaller, and its state comes
// from fields. To be run: the rules, and what heats and pours, moved. To be drawn: the rules, the camera,
// moved, and the look.
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
  std::vector<std::string> without;   // of Excerpt::removable
};

class Excerpt {
 public:
  // The scene of `load` with these overrides. Throws InputError.
  Excerpt(const std::filesystem::path& file, const std::vector<std::string>& overrides);

  // What a part may go without: "vent.0", "heat_source.1", "heat.air".
  std::vector<std::string> removable() const;

  // `fields`: the folder of the state, beside the file; `step`: the number of its first step.
  std::string text(const Part& part, const std::string& fields, std::uint32_t step) const;
  // To be drawn. `camera`: as the scene has it. Of the shapes the terrain stays, which says how ground is
  // drawn; the part may go without "terrain".
  std::string picture_text(const Part& part, const std::string& fields, const Camera& camera) const;

 private:
  Value document_;
};

}  // namespace voxmelt::scene
