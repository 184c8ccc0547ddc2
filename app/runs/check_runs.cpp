#include "app/runs/check_runs.h"

#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>

#include "app/options.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "kernel/scene/overrides.h"

namespace voxmelt::app {
namespace {

constexpr std::size_t kShown = 200;  // bytes of an assignment that a message shows

// The settings of a scene lack what fills the grid, so such a key is read with all of the scene.
bool fills_the_grid(const std::string& key) {
  for (const char* list : {"solid.", "liquid.", "inert.", "start."})
    if (key.starts_with(list)) return true;
  return false;
}

// Throws the message again, with the place in the plan instead of the assignment's.
[[noreturn]] void fail_in_plan(const Plan& plan, const PlannedRun& run, const std::string& message) {
  for (std::size_t i = 0; i < plan.axes.size(); ++i) {
    const std::string set = set_of(plan.axes[i], run.values[i]);
    std::string head = "--set " + set.substr(0, kShown) + (set.size() > kShown ? "..." : "") + ": error: ";
    if (message.starts_with(head)) scene::fail_at(run.values[i].place, message.substr(head.size()));
  }
  scene::fail_at(plan.axes.front().place, fmt::format("run {}: {}", run.name, message));
}

}  // namespace

scene::Scene scene_of(const Plan& plan) {
  const std::filesystem::path file = find_scene(plan.scene);
  if (run::is_checkpoint(file))
    throw UsageError(fmt::format("{}: error: {} is a checkpoint, and a sweep wants a scene",
                                 plan.file.string(), plan.scene));
  return scene::load(file, {});
}

void check_runs(const Plan& plan, const std::vector<PlannedRun>& runs, const scene::Scene& scene) {
  std::set<std::string> filled;  // assignments that were read with all of the scene
  for (const PlannedRun& run : runs) {
    std::vector<std::string> settings;
    for (std::size_t i = 0; i < plan.axes.size(); ++i) {
      const std::string set = set_of(plan.axes[i], run.values[i]);
      if (!fills_the_grid(plan.axes[i].key))
        settings.push_back(set);
      else if (filled.insert(set).second)
        try {
          scene::load(scene.file, {set});
        } catch (const scene::InputError& error) {
          fail_in_plan(plan, run, error.what());
        }
    }
    try {
      scene::check_overrides(scene.settings, settings);
    } catch (const scene::InputError& error) {
      fail_in_plan(plan, run, error.what());
    }
  }
}

}  // namespace voxmelt::app
