#include "hwmodel/machine/presets/presets.h"

#include <bit>
#include <cstdint>
#include <optional>

#include "hwmodel/machine/presets/caster_preset.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {
namespace {

void read_pipeline(scene::Reader& hw, Configuration& c) {
  c.lanes = static_cast<int>(hw.integer("lanes", 1, kMostLanes, c.lanes));
  if (!std::has_single_bit(static_cast<unsigned>(c.lanes)))
    hw.fail("lanes", " = " + std::to_string(c.lanes) + " is not one of 1, 2, 4, 8, 16, 32");
  c.cascade = static_cast<int>(hw.integer("cascade", 1, kMostCascade, c.cascade));
  c.fifo_depth = static_cast<int>(hw.integer("fifo_depth", 1, kMostDepth, c.fifo_depth));
  c.stall_seed = static_cast<std::uint64_t>(hw.integer("stall_seed", 0, INT64_MAX, 0));
  c.substeps = static_cast<int>(hw.integer("substeps", 1, kMostSubsteps, c.substeps));
  c.tile = static_cast<int>(hw.integer("tile", 0, kMostTile, c.tile));
  if (c.tile % c.lanes != 0)
    hw.fail("tile",
            " = " + std::to_string(c.tile) + " is not a multiple of lanes = " + std::to_string(c.lanes));
  c.overlap = hw.integer("overlap", 0, 1, c.overlap ? 1 : 0) == 1;
  c.coded = hw.integer("coded", 0, 1, c.coded ? 1 : 0) == 1;
  for (scene::Reader& channel : hw.tables("channel")) {
    c.depths.push_back({channel.text("name"), static_cast<int>(channel.integer("depth", 1, kMostDepth))});
    channel.finish();
  }
}

Preset preset_of(const scene::Value& document, Runs runs) {
  Preset preset;
  scene::Reader root(document, "");
  preset.title = root.text("title", "");
  if (std::optional<scene::Reader> hw = root.table("hw")) {
    if (runs != Runs::caster) read_pipeline(*hw, preset.configuration);
    if (runs == Runs::pipeline)
      read_clock_and_memory(*hw, preset.caster);
    else
      read_caster(*hw, preset.caster);
    hw->finish();
  }
  root.finish();
  return preset;
}

}  // namespace

Preset load_preset(const std::filesystem::path& file, const std::vector<std::string>& overrides, Runs runs) {
  scene::Value document, options;
  if (!file.empty()) document = scene::read_document(file);
  for (const std::string& assignment : overrides) {
    // What a trace needs may stand in the file.
    if (runs == Runs::pipeline || !assignment.starts_with("hw.memory_trace"))
      scene::apply_override(options, assignment);
    scene::apply_override(document, assignment);
  }
  static_cast<void>(preset_of(options, runs));  // a key of what does not run is unknown
  return preset_of(document, Runs::machine);
}

}  // namespace voxmelt::hwmodel
