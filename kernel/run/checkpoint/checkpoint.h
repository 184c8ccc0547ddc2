// A run between two steps as one file (docs/checkpoint.md): what a second program needs to go on with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/state/mid_run.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::checkpoint {

// A file as it was when the checkpoint was written.
struct FileState {
  std::string name;
  std::uint64_t bytes = 0, digest = 0;  // XXH3
  friend bool operator==(const FileState&, const FileState&) = default;
};
// Throws Error where it cannot be read. `name` is what it is called.
FileState state_of(const std::filesystem::path& file, std::string name);

// What the automaton does not see.
struct SceneText {
  std::string name, file, title;
  std::string settings;    // TOML: all of the scene but what filled the grid
  std::string parameters;  // JSON: what they were resolved to
  std::vector<std::string> warnings;
  std::vector<FileState> files;  // that were read
  std::uint64_t initial_digest = 0;
  bool textured = false;
  std::vector<float> terrain;  // heights, x fastest; empty for none
};

struct Head {
  std::string version;  // of the program that wrote it
  state::Grid grid;
  std::uint32_t first_step = 0;  // the automaton's number of the first step
  std::uint64_t digest = 0;      // of the volume
  bool radiates = false;         // there is irradiance
  SceneText scene;
  state::MidRun run;    // its irradiance is a block of its own
  std::string command;  // JSON of who runs it
};

struct Checkpoint {
  Head head;
  state::Volume volume;
};

// Writes beside `place`, flushes and renames. Throws io::OutputError. `irradiance` is null for none.
void write(const std::filesystem::path& place, Head head, const state::Volume& volume,
           const state::Field<std::uint16_t>* irradiance, int threads);

// Throws Error where anything is not as write() leaves it: a bit, a length, a name. The cells are those of
// the digest; whether they make a volume is for the reader of scenes to say.
Checkpoint read(const std::filesystem::path& file);
// Without the cells, which are not looked at.
Head read_head(const std::filesystem::path& file);

}  // namespace voxmelt::checkpoint
