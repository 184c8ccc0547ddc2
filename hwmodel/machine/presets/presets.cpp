#include "hwmodel/machine/presets/presets.h"

#include <optional>
#include <string>

#include "hwmodel/machine/presets/caster_preset.h"
#include "hwmodel/machine/presets/keys.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel {
namespace {

void read_pipeline(scene::Reader& hw, Configuration& c) {
  read_keys(hw, kHwKeys, c);
  if (c.tile % c.lanes != 0)
    hw.fail("tile",
            " = " + std::to_string(c.tile) + " is not a multiple of lanes = " + std::to_string(c.lanes));
  for (scene::Reader& channel : hw.tables("channel")) {
    c.depths.push_back({channel.text("name"), channel.integer("depth", 1, kMostDepth)});
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
      read_memory(*hw, preset.caster);
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
    // A trace needs a DRAM, which only the file may name. So this override is not checked alone.
    if (!assignment.starts_with("hw.memory_trace") && !assignment.starts_with("hw.command_trace"))
      scene::apply_override(options, assignment);
    scene::apply_override(document, assignment);
  }
  static_cast<void>(preset_of(options, runs));  // fails at a key of a part that does not run
  return preset_of(document, Runs::machine);
}

}  // namespace voxmelt::hwmodel
