// The functions here give the command that shows a difference again, and write the state that it needs.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/print.h"
#include "app/shell_word.h"
#include "app/verify_command.h"
#include "hwmodel/pipeline/check/replay.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

std::string who_computes(const Common& common) {
  std::string text;
  if (common.seed) text += fmt::format(" --seed {}", *common.seed);
  if (common.implementation != "auto") text += " --implementation " + common.implementation;
  return text;
}

// Returns everything that the user must type to see it again.
std::string again(const VerifyCommand& command, const std::string& scene,
                  const hwmodel::VerifyReport& report) {
  const std::uint32_t step = report.mismatch->step;
  std::string text = fmt::format("voxmelt verify {} --steps {}", shell_word(scene),
                                 report.pass_end - report.replay_step);  // whole passes: the same cycles
  if (!command.hw.empty()) text += " --hw " + shell_word(command.hw);
  for (const std::string& set : command.hw_sets) text += " --set " + shell_word(set);
  for (const std::string& set : command.common.sets)  // the replay has its own start
    if (!set.starts_with("start.")) text += " --set " + shell_word(set);
  text += who_computes(command.common);
  if (!command.plant.empty()) text += fmt::format(" --plant {} --plant-step {}", command.plant, step);
  return text;
}

}  // namespace

// Returns everything that the user must type to see a picture again, but for its pixel.
std::string picture_again(const VerifyCommand& command, const std::string& scene) {
  const PictureChoice& picture = command.picture;
  std::string text = fmt::format("voxmelt verify {} --picture", shell_word(scene));
  if (command.from != 0) text += fmt::format(" --from {}", command.from);
  if (!picture.view.empty()) text += " --view=" + picture.view;
  if (!picture.size.empty()) text += " --size " + shell_word(picture.size);
  if (picture.setting != "normal") text += " --setting " + picture.setting;
  if (!command.hw.empty()) text += " --hw " + shell_word(command.hw);
  for (const auto* sets : {&command.hw_sets, &command.common.sets})
    for (const std::string& set : *sets) text += " --set " + shell_word(set);
  text += who_computes(command.common);
  if (!command.plant.empty()) text += " --plant " + command.plant;
  return text;
}

std::string small_picture_again(const VerifyCommand& command) {
  std::string text = fmt::format("voxmelt verify {} --picture", shell_word(command.shrink));
  if (!command.picture.compare) text += " --no-compare";
  if (command.picture.frames != 1) text += fmt::format(" --frames {}", command.picture.frames);
  if (!command.plant.empty()) text += " --plant " + command.plant;
  if (!command.hw.empty()) text += " --hw " + shell_word(command.hw);
  for (const std::string& set : command.hw_sets) text += " --set " + shell_word(set);
  return text;
}

// A replay is called scene.toml, so its folder names it.
std::string name_of(const scene::Scene& scene) {
  const std::string folder = fs::absolute(scene.file).parent_path().filename().string();
  return scene.name == "scene" && !folder.empty() ? folder : scene.name;
}

fs::path replay_place(const VerifyCommand& command, const scene::Scene& scene) {
  return command.out.empty() ? fs::path("out") / ("verify_" + name_of(scene)) : fs::path(command.out);
}

// A replay extends its scene, so it must not take that scene's place.
void check_replay_place(const VerifyCommand& command, const scene::Scene& scene) {
  const fs::path within =
      fs::absolute(scene.file)
          .lexically_normal()
          .lexically_relative(fs::absolute(replay_place(command, scene)).lexically_normal());
  if (!within.empty() && *within.begin() != "..")
    throw UsageError(
        fmt::format("error: --out {}: the scene itself lies there", replay_place(command, scene).string()));
  if (!command.out.empty()) const io::OutputFolder can_be_written(command.out);
}

void write_replay(const VerifyCommand& command, const scene::Scene& scene,
                  const hwmodel::VerifyReport& report) {
  if (command.from == 0 && report.replay_step == scene.first_step) {
    if (!command.common.quiet)
      print("the scene itself begins with the state from which it can be seen again:\n  {}\n",
            again(command, scene.file.string(), report));
    return;
  }
  const fs::path place = replay_place(command, scene);
  io::OutputFolder out(place);
  const std::string typed = again(command, (place / "scene.toml").string(), report);
  hwmodel::write_replay(out.partial(), scene.file, *report.replay, report.replay_step, typed);
  out.commit();
  if (!command.common.quiet)
    print("the state before step {} is in {}; to see it again:\n  {}\n", report.replay_step, place.string(),
          typed);
}

}  // namespace voxmelt::app
