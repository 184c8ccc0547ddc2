#include "library/parts.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "kernel/run/opening/opening.h"
#include "kernel/run/trial/fastest.h"
#include "library/journal/timeline.h"

namespace voxmelt {
namespace {

constexpr int kMostThreads = 1024;

const step::Implementation& find_implementation(const std::string& name) {
  try {
    return *run::chosen(name).implementation;
  } catch (const std::invalid_argument& error) {
    throw InputError("Options: error: implementation = \"" + name + "\": " + error.what());
  }
}

int checked_threads(int threads) {
  if (threads < 0 || threads > kMostThreads)
    throw InputError("Options: error: threads = " + std::to_string(threads) + " is outside 0.." +
                     std::to_string(kMostThreads));
  return threads > 0 ? threads : std::max(1u, std::thread::hardware_concurrency());
}

}  // namespace

Simulation::Parts::Parts(const std::filesystem::path& file, const Options& options)
    : implementation(find_implementation(options.implementation)),
      threads(checked_threads(options.threads)),
      file_(file),
      options_(options),
      opened_(open(file, options)),
      simulation(begin(opened_.scene)),
      by_hand(opened_.scene, simulation),
      world_(by_hand),
      timeline_(journal::timeline_of(opened_.scene)) {
  timeline_.seek(simulation.steps_done());
}

Simulation::Parts::Opened Simulation::Parts::open(const std::filesystem::path& file, const Options& options) {
  Opened opened;
  if (!run::is_checkpoint(file)) {
    opened.scene = scene::load(file, options.overrides);
    opened.digest = opened.scene.initial_digest;
    return opened;
  }
  if (!options.overrides.empty())
    throw InputError(file.string() + ": error: is a checkpoint: overrides come too late for its scene");
  checkpoint::Checkpoint read = checkpoint::read(file);
  opened.files = read.head.scene.files;
  opened.digest = read.head.digest;
  opened.scene = run::scene_of(std::move(read), file);
  return opened;
}

run::Simulation Simulation::Parts::begin(scene::Scene& scene) const {
  return run::begin_run(scene, implementation, {.threads = threads});
}

void Simulation::Parts::restart() {
  Opened again = open(file_, options_);
  if (again.digest != opened_.digest || again.scene.first_step != opened_.scene.first_step)
    throw InputError("restart: error: " + file_.string() + " has changed: it gives another first state");
  // A scene that changes itself begins with its own numbers, or the changes would be made twice.
  const bool changes_itself = !again.scene.changes.empty();
  if (!changes_itself) again.scene.parameters = opened_.scene.parameters;
  simulation = begin(again.scene);
  if (changes_itself) opened_ = std::move(again);
  timeline_.seek(simulation.steps_done());
}

void Simulation::Parts::step() {
  timeline_.apply(world_);
  simulation.step();
}

void Simulation::Parts::save(const std::filesystem::path& place) const {
  const state::Volume& volume = simulation.volume();
  checkpoint::SceneText text = run::scene_text(opened_.scene, volume.grid);
  if (!opened_.files.empty()) text.files = opened_.files;
  text.settings = by_hand.settings();
  checkpoint::Head head = run::head_of(version(), text, opened_.scene, simulation);
  head.command = "{}";  // no command runs it
  checkpoint::write(place, std::move(head), volume, simulation.irradiance(), threads);
}

Changes Simulation::Parts::changes(std::uint64_t since) {
  return versions_.changes(simulation.volume(), since);
}

std::optional<render::Image> Simulation::Parts::drawn_on_device(const scene::Camera& camera,
                                                                render::Setting setting) {
  const scene::Scene& scene = opened_.scene;
  if (!on_device_.update(simulation.state_on_device(), scene.look, scene.light, scene.terrain)) return {};
  return on_device_.draw(camera, setting);
}

render::Picture& Simulation::Parts::up_to_date() {
  const scene::Scene& scene = opened_.scene;
  picture_.update(simulation.volume(), scene.look, scene.light, scene.terrain, threads);
  return picture_;
}

}  // namespace voxmelt
