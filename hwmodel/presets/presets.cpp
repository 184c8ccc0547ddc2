#include "hwmodel/presets/presets.h"

#include <bit>
#include <cstdint>
#include <optional>

#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {

Preset load_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  scene::Value document;
  if (!file.empty()) document = scene::read_document(file);
  for (const std::string& assignment : overrides) scene::apply_override(document, assignment);

  Preset preset;
  scene::Reader root(document, "");
  preset.title = root.text("title", "");
  Configuration& c = preset.configuration;
  if (std::optional<scene::Reader> hw = root.table("hw")) {
    c.lanes = static_cast<int>(hw->integer("lanes", 1, kMostLanes, c.lanes));
    if (!std::has_single_bit(static_cast<unsigned>(c.lanes)))
      hw->fail("lanes", " = " + std::to_string(c.lanes) + " is not one of 1, 2, 4, 8, 16, 32");
    c.cascade = static_cast<int>(hw->integer("cascade", 1, kMostCascade, c.cascade));
    c.fifo_depth = static_cast<int>(hw->integer("fifo_depth", 1, kMostDepth, c.fifo_depth));
    c.stall_seed = static_cast<std::uint64_t>(hw->integer("stall_seed", 0, INT64_MAX, 0));
    c.substeps = static_cast<int>(hw->integer("substeps", 1, kMostSubsteps, c.substeps));
    c.overlap = hw->integer("overlap", 0, 1, c.overlap ? 1 : 0) == 1;
    hw->finish();
  }
  root.finish();
  return preset;
}

}  // namespace voxmelt::hwmodel
