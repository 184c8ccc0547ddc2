#include "kernel/run/opening/checkpoint_scene.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <string>
#include <system_error>
#include <utility>

#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/export.h"
#include "kernel/scene/start.h"

namespace voxmelt::run {
namespace {

namespace fs = std::filesystem;

std::string parameters_text(const scene::Scene& scene, state::Grid grid) {
  return io::parameters_json(scene.parameters, grid, scene.first_step);
}

}  // namespace

bool is_checkpoint(const fs::path& file) {
  if (file.extension() == ".vxc") return true;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored)) return false;  // a pipe would lose its first bytes
  std::ifstream stream(file, std::ios::binary);
  std::string begin(4, '\0');
  stream.read(begin.data(), 4);
  return stream && begin == "\x89VXC";
}

scene::Scene scene_of(checkpoint::Checkpoint checkpoint, const fs::path& file) {
  checkpoint::Head& head = checkpoint.head;
  checkpoint::SceneText& text = head.scene;
  scene::Scene scene;
  try {
    scene = scene::load_settings(text.settings, file.string() + " (its scene)");
  } catch (const scene::InputError& error) {
    throw checkpoint::Error(error.what());
  }
  if (scene.initial.grid != head.grid) checkpoint::fail(file, "its scene has another grid than its cells");
  const std::size_t materials = std::max<std::size_t>(1, scene.materials.size());
  if (const std::string broken = scene::first_broken(checkpoint.volume, materials); !broken.empty())
    checkpoint::fail(file, broken);
  scene::fill(scene, std::move(checkpoint.volume));
  scene.first_step = head.first_step;
  // If sources were taken away, they shine until the next step of visibility.
  rule::Heat& heat = scene.parameters.heat;
  if (heat.enabled && heat.sources.empty()) heat.radiation = head.radiates;
  if (parameters_text(scene, head.grid) != text.parameters)
    checkpoint::fail(file, "was written by voxmelt " + head.version +
                               ", which resolves its scene to other parameters than this program");
  if (head.radiates != scene.parameters.heat.radiates())
    checkpoint::fail(file, "has irradiance where its scene has none, or none where it has some");
  scene.name = std::move(text.name);
  scene.file = std::move(text.file);
  scene.title = std::move(text.title);
  scene.warnings = std::move(text.warnings);
  scene.initial_digest = text.initial_digest;
  scene.terrain = {head.grid.x, head.grid.z, std::move(text.terrain), text.textured};
  scene.files = {file};
  scene.mid_run = std::move(head.run);
  return scene;
}

checkpoint::SceneText scene_text(const scene::Scene& scene, state::Grid grid) {
  checkpoint::SceneText text;
  text.name = scene.name;
  text.file = scene.file.string();
  text.title = scene.title;
  text.settings = scene.settings;
  text.parameters = parameters_text(scene, grid);
  text.warnings = scene.warnings;
  for (const fs::path& file : scene.files)
    if (std::error_code ignored; fs::is_regular_file(file, ignored))
      text.files.push_back(checkpoint::state_of(file, fs::absolute(file).lexically_normal().string()));
  text.initial_digest = scene.initial_digest;
  text.terrain = scene.terrain.height;
  text.textured = scene.terrain.textured;
  return text;
}

checkpoint::Head head_of(const std::string& version, const checkpoint::SceneText& text,
                         const scene::Scene& scene, const Simulation& simulation) {
  checkpoint::Head head;
  head.version = version;
  head.first_step = scene.first_step;
  head.scene = text;
  head.run = simulation.mid_run();
  return head;
}

}  // namespace voxmelt::run
