#include "app/options.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "app/message.h"
#include "app/resources.h"
#include "app/visibility.h"
#include "kernel/engine/visibility/providers.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "kernel/run/opening/opening.h"
#include "kernel/run/trial/fastest.h"
#include "kernel/scene/text/suggestion.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

void say_warnings(const Common& common, const std::vector<std::string>& warnings) {
  if (common.quiet) return;
  for (const std::string& warning : warnings) say("warning: " + warning);
}

}  // namespace

std::filesystem::path find_scene(const std::string& given) {
  const fs::path path(given);
  if (path.has_parent_path() || path.has_extension()) return path;
  for (const fs::path& folder : scene_folders()) {
    const fs::path candidate = folder / (given + ".toml");
    std::error_code ignored;
    if (fs::exists(candidate, ignored)) return candidate;
  }
  const std::vector<std::string> names = scene_names();
  if (names.empty())
    throw UsageError(
        fmt::format("error: no scene file and no scene named '{}'; {}", given, no_scenes_text()));
  const std::string near = scene::nearest_name(given, names);
  throw UsageError(
      fmt::format("error: no scene file and no scene named '{}'; {}`voxmelt list scenes` names those "
                  "that came with it",
                  given, near.empty() ? "" : fmt::format("did you mean '{}'? ", near)));
}

void add_scene(Command command, Common& common) {
  command
      .option("scene", common.scene,
              "scene file (TOML), a name of `voxmelt list scenes`, a model, or a checkpoint")
      .required();
}

void add_common(Command command, Common& common) {
  command
      .option("--implementation", common.implementation,
              "who computes: auto, or a name of `voxmelt list implementations`")
      .shows_default();
  command.option("--threads", common.threads, "threads (default: all); no result depends on it")
      .within(1, 1024);
  command.option("--seed", common.seed, "seed of the random function, instead of the scene's")
      .within(std::uint64_t{0}, std::uint64_t{INT64_MAX});
  command.option("--set", common.sets, "override a key of the scene: path.to.key=value (repeatable)")
      .written_as("KEY=VALUE")
      .one_each_time();
  command.option("--report", common.report, "also write the report to this JSON file");
  command.flag("--quiet", common.quiet, "no progress line, no notes");
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const fs::path& folder : scene_folders()) {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored))
      if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string no_scenes_text() {
  std::string folders;
  for (const fs::path& folder : scene_folders()) folders += (folders.empty() ? "" : ", ") + folder.string();
  return fmt::format(
      "no scenes are in any of {}: give the environment VOXMELT_SCENES, the folder of those that "
      "came with the program",
      folders);
}

std::vector<fs::path> scene_folders() {
  std::vector<fs::path> folders{"scenes"};
  if (const char* installed = std::getenv("VOXMELT_SCENES")) folders.emplace_back(installed);
  folders.push_back(resource_folder("scenes"));
  return folders;
}

scene::Scene load_scene(const Common& common) {
  const fs::path file = find_scene(common.scene);
  if (run::is_checkpoint(file)) {
    if (!common.sets.empty() || common.seed)
      throw UsageError(fmt::format("error: {} is a checkpoint: --set and --seed come too late for its scene",
                                   common.scene));
    return run::scene_of(checkpoint::read(file), file);
  }
  std::vector<std::string> sets = common.sets;
  if (common.seed) sets.push_back(fmt::format("run.seed={}", *common.seed));
  scene::Scene scene = scene::load(file, sets);
  for (const std::string& line : scene.assumed)
    if (!common.quiet) say("assumed: " + line);
  say_warnings(common, scene.warnings);
  return scene;
}

void refuse_changes(const scene::Scene& scene, const char* command) {
  const std::uint64_t next =
      std::uint64_t{scene.first_step} + (scene.mid_run ? scene.mid_run->steps_done : 0);
  if (!scene.changes.empty() && scene.changes.back().step >= next)
    throw UsageError(
        fmt::format("{}: error: `voxmelt {}` makes no [[change]]; a checkpoint after the last of "
                    "them will do",
                    scene.changes.back().place, command));
}

void warn(scene::Scene& scene, const Common& common, const std::vector<std::string>& warnings) {
  say_warnings(common, warnings);
  scene.warnings.insert(scene.warnings.end(), warnings.begin(), warnings.end());
}

const step::Implementation& find_implementation(const Common& common) {
  try {
    return *run::chosen(common.implementation).implementation;
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("--implementation {}: error: {}", common.implementation, error.what()));
  }
}

const step::Implementation& find_phased_implementation(const Common& common) {
  const step::Implementation& found = find_implementation(common);
  if (found.whole_steps)
    throw UsageError(
        fmt::format("--implementation {}: error: this command looks at single phases, and a device "
                    "runs whole steps",
                    common.implementation));
  return found;
}

namespace {

// Tells if a step of the scene asks nothing of the host's memory.
bool stays_on_device(const scene::Scene& scene, const VisibilityChoice& visibility) {
  return !scene.parameters.pieces.fall && visibility.name == visibility::kUsual;
}

}  // namespace

run::Simulation make_simulation(scene::Scene& scene, const Common& common, Steps steps) {
  step::Implementation implementation = find_implementation(common);
  step::Tuning tuning;
  tuning.threads = thread_count(common);
  const VisibilityChoice visibility = choose_visibility(common.visibility);
  if (common.implementation == "auto" && steps == Steps::whole && stays_on_device(scene, visibility)) {
    const run::Choice& choice = run::fastest_for_steps();
    implementation = *choice.implementation;
    implementation.spare = choice.spare;
    implementation.told = [device = implementation.name, choice](const step::DeviceError& why) {
      say(fmt::format("warning: {} fails, and {} goes on: {}", device, choice.spare->name, why.what()));
    };
  }
  return run::begin_run(scene, implementation, tuning, make_provider(visibility, tuning.threads));
}

std::string reason_of(const run::Simulation& simulation, const Common& common) {
  if (!simulation.failure().empty()) return "it went on where a device failed: " + simulation.failure();
  const run::Choice chosen = run::chosen(common.implementation);
  const bool card = chosen.implementation->name != simulation.implementation();
  return card ? run::fastest_for_steps().reason : chosen.reason;
}

void keep_inputs(const scene::Scene& scene, const std::vector<Output>& outputs) {
  for (const Output& output : outputs)
    for (const fs::path& file : scene.files) {
      if (output.place.empty()) continue;
      std::error_code ignored;
      const fs::path place = fs::weakly_canonical(output.place, ignored);
      const fs::path within = fs::weakly_canonical(file, ignored).lexically_relative(place);
      if (within.empty() || *within.begin() == "..") continue;
      throw UsageError(fmt::format("{} {}: error: {}", output.option, output.place,
                                   within == "." ? "the scene reads this file"
                                                 : fmt::format("the scene reads {} there", within.string())));
    }
}

void check_report_place(const Common& common, const std::string& out) {
  check_place("--report", common.report, out);
}

void check_place(const std::string& option, const std::string& file, const std::string& out) {
  if (file.empty()) return;
  const auto fail = [&](const std::string& why) {
    throw UsageError(fmt::format("{} {}: error: {}", option, file, why));
  };
  std::error_code error;
  const fs::path place = fs::absolute(file).lexically_normal();
  if (!out.empty()) {
    const fs::path within = place.lexically_relative(fs::absolute(out).lexically_normal());
    if (!within.empty() && *within.begin() != "..")
      fail("lies in --out, which gets its own report.json and is replaced whole");
  }
  if (fs::is_directory(place, error)) fail("is a folder");
  if (!fs::is_directory(place.parent_path(), error))
    fail("there is no folder " + place.parent_path().string());
  if (::access(place.parent_path().c_str(), W_OK) != 0) fail("cannot write there");
}

void write_report(const Common& common, const std::string& text) {
  if (!common.report.empty()) io::write_file(common.report, text);
}

int thread_count(const Common& common) {
  return common.threads > 0 ? common.threads : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace voxmelt::app
