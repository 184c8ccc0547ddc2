// A scene is a resolved TOML file. The automaton sees `initial` and `parameters` only.
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

// Is what happens before the step of this number, in the words of a journal (library/journal/change.h).
struct Change {
  std::uint32_t step = 0;
  std::string what;
  std::string place{};  // file:line:column, for messages
};

struct Scene {
  std::string name;  // file name without folder and suffix
  std::filesystem::path file;
  std::string title;           // one line for `voxmelt list scenes`
  std::uint32_t steps = 1000;  // steps that `voxmelt run` does by default
  std::uint32_t frame_every = 100;
  std::uint32_t first_step = 0;              // the automaton's number of the first step
  std::vector<std::string> materials;        // names of several materials; the first is ""
  std::vector<std::string> features;         // named extras and features that this scene asks for
  std::vector<std::string> warnings;         // e.g. leaks of a mesh
  std::vector<std::filesystem::path> files;  // files that were read for it
  rule::Parameters parameters;
  state::Volume initial;
  std::uint64_t initial_digest = 0;
  Camera camera;
  Light light;
  Look look;
  Terrain terrain;
  std::vector<Change> changes;       // [[change]], steps ascending; those before `first_step` count as made
  std::vector<std::string> assumed;  // lines that say what was assumed of a model without a scene
  std::string assumed_text;          // scene file of such a model, with comments
  std::string text;                  // TOML: all of the document; nothing for a checkpoint
  std::string settings;              // TOML: all of the document but what fills the grid
  std::optional<state::MidRun> mid_run;  // set if a run goes on from `initial`, not if it begins there
};

// Reads a scene file, or a model, for which a scene is assumed. `overrides` are "path.to.key=value" of --set.
// They are applied to the parsed document before it is read, so that they are checked like the file itself.
// It throws InputError or ResourceError.
Scene load(const std::filesystem::path& file, const std::vector<std::string>& overrides);

// Makes a scene of `settings` that an earlier load() gave, without anything in its grid. `origin` names it in
// messages. It throws InputError or ResourceError.
Scene load_settings(const std::string& settings, const std::string& origin);
// Fills the grid with these cells, and sets what depends on them: walls and features.
void fill(Scene& scene, state::Volume cells);

// Returns the title alone, without reading the rest. It throws InputError.
std::string title_of(const std::filesystem::path& file);

}  // namespace voxmelt::scene
