// A scene: what a TOML file says, resolved. The automaton sees `initial` and `parameters` only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/mid_run.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::scene {

struct Scene {
  std::string name;  // file name without folder and suffix
  std::filesystem::path file;
  std::string title;           // one line for `voxmelt list scenes`
  std::uint32_t steps = 1000;  // that `voxmelt run` does by default
  std::uint32_t frame_every = 100;
  std::uint32_t first_step = 0;              // the automaton's number of the first step
  std::vector<std::string> features;         // named extras and features that this scene asks for
  std::vector<std::string> warnings;         // e.g. leaks of a mesh
  std::vector<std::filesystem::path> files;  // that were read for it
  rule::Parameters parameters;
  state::Volume initial;
  std::uint64_t initial_digest = 0;
  Camera camera;
  Light light;
  Look look;
  Terrain terrain;
  std::string settings;                  // all of the document but what fills the grid: TOML
  std::optional<state::MidRun> mid_run;  // where a run goes on from `initial`; none where it begins
};

// Reads a scene file. `overrides` are "path.to.key=value" of --set, applied to the parsed document before it
// is read, so that they are checked like the file itself. Throws InputError or ResourceError.
Scene load(const std::filesystem::path& file, const std::vector<std::string>& overrides);

// A scene of `settings` that an earlier load() gave, without anything in its grid. `origin` names it in
// messages. Throws InputError or ResourceError.
Scene load_settings(const std::string& settings, const std::string& origin);
// Then these cells are its grid's, and what depends on them is known: walls, features.
void fill(Scene& scene, state::Volume cells);

// The title alone, without reading the rest. Throws InputError.
std::string title_of(const std::filesystem::path& file);

}  // namespace voxmelt::scene
