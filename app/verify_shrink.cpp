#include "app/verify_shrink.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "app/shell_word.h"
#include "hwmodel/caster/check/replay_pixel.h"
#include "hwmodel/caster/check/shrink_picture.h"
#include "hwmodel/pipeline/check/shrink_scene.h"
#include "kernel/run/io/export.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

constexpr double kSeconds = 40;  // time limit of the search

std::vector<std::string> overrides_of(const Common& common) {
  std::vector<std::string> sets = common.sets;
  if (common.seed) sets.push_back(fmt::format("run.seed={}", *common.seed));
  return sets;
}

// Returns the command that shows the small case.
std::string typed(const VerifyCommand& command, const hwmodel::Case& small) {
  std::string text = fmt::format("voxmelt verify {} --steps {}", shell_word(command.shrink), small.steps);
  for (const hwmodel::HwKey& key : hwmodel::kHwKeys)
    if (key.get(small.configuration) != key.usual())
      text += fmt::format(" --set hw.{}={}", key.name, key.get(small.configuration));
  if (command.common.implementation != "auto") text += " --implementation " + command.common.implementation;
  if (!command.plant.empty())
    text += fmt::format(" --plant {} --plant-step {}", command.plant, small.first_step);
  return text;
}

std::string typed(const VerifyCommand& command, const hwmodel::raycast::PictureCase& small,
                  const hwmodel::raycast::Configuration& whole) {
  std::string text = small_picture_again(command);
  const hwmodel::raycast::Configuration& c = small.configuration;
  for (const hwmodel::raycast::CasterKey& key : hwmodel::raycast::kCasterKeys)
    if (key.get(c) != key.get(whole)) text += fmt::format(" --set hw.{}={}", key.name, key.get(c));
  text += fmt::format(" --setting {}", render::kSettingNames[static_cast<std::size_t>(small.setting)]);
  return text + " --pixel " + hwmodel::raycast::pixel_text(small.window);
}

fs::path fields_folder(const std::string& file) {
  fs::path folder(file);
  folder.replace_extension();
  return folder.string() + "_fields";
}

void write_small(const std::string& file, const state::Volume& volume, const std::string& stage,
                 const std::string& to_type, const std::string& text) {
  io::OutputFolder fields(fields_folder(file));
  io::export_npy(volume, fields.partial());
  fields.commit();
  io::write_file(file, fmt::format("# A hardware model that differs from the software ({}), made small.\n"
                                   "#   {}\n{}",
                                   stage, to_type, text));
}

constexpr const char* kNotAgain =
    "--shrink: the difference is not seen again from the state before it; "
    "nothing was written\n";

}  // namespace

std::string make_small(const VerifyCommand& command, const scene::Scene& scene,
                       const hwmodel::VerifyOptions& options, const hwmodel::VerifyReport& report) {
  const fs::path folder = fields_folder(command.shrink);
  const std::optional<hwmodel::SmallScene> made =
      hwmodel::shrink_to_scene({folder, kSeconds, scene, overrides_of(command.common),
                                find_phased_implementation(command.common), options, stop_if_interrupted},
                               report);
  if (!made) return kNotAgain;
  const hwmodel::Case& small = made->small;
  const std::string to_type = typed(command, small);
  write_small(command.shrink, small.volume, made->stage, to_type, made->text);
  const std::array<int, 3> size = small.size();
  return fmt::format(
      "{} holds {} x {} x {} cells, {} of them not air, which fail in {} step{} ({} runs were tried); "
      "to see it:\n  {}\n",
      command.shrink, size[0], size[1], size[2], made->cells, small.steps, small.steps == 1 ? "" : "s",
      made->tried, to_type);
}

std::string make_small_picture(const VerifyCommand& command, const scene::Scene& scene,
                               const hwmodel::raycast::PictureInput& input,
                               const hwmodel::raycast::PictureOptions& options,
                               const hwmodel::raycast::PictureReport& report) {
  namespace raycast = hwmodel::raycast;
  const std::optional<raycast::SmallPicture> made = raycast::shrink_to_scene(
      {fields_folder(command.shrink), kSeconds, scene, overrides_of(command.common), input, options}, report);
  if (!made) return kNotAgain;
  const raycast::PictureCase& small = made->small;
  const std::string to_type = typed(command, small, options.configuration);
  write_small(command.shrink, small.volume, made->stage, to_type, made->text);
  return fmt::format(
      "{} holds {} x {} x {} cells, {} of them not air, of which a picture of {} pixel{} fails ({} pictures "
      "were tried); to see it:\n  {}\n",
      command.shrink, small.volume.grid.x, small.volume.grid.y, small.volume.grid.z, made->cells,
      small.pixels(), small.pixels() == 1 ? "" : "s", made->tried, to_type);
}

}  // namespace voxmelt::app
