// A checkpoint is a run between two steps as one file (docs/checkpoint.md). A second program needs no more to
// go on with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/automaton/state/mid_run.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::checkpoint {

// Describes a file as it was when the checkpoint was written.
struct FileState {
  std::string name;
  std::uint64_t bytes = 0, digest = 0;  // XXH3
  friend bool operator==(const FileState&, const FileState&) = default;
};
// Reads the state of a file. It throws Error if the file cannot be read. `name` is its name in the
// checkpoint.
FileState state_of(const std::filesystem::path& file, std::string name);

// Holds those parts of a scene that the automaton does not see.
struct SceneText {
  std::string name, file, title;
  std::string settings;    // TOML: all of the scene but what filled the grid
  std::string parameters;  // JSON: the resolved parameters
  std::vector<std::string> warnings;
  std::vector<FileState> files;  // files that were read
  std::uint64_t initial_digest = 0;
  bool textured = false;
  std::vector<float> terrain;  // heights, x fastest; empty for none
};

struct Head {
  std::string version;  // version of the program that wrote it
  state::Grid grid;
  std::uint32_t first_step = 0;  // the automaton's number of the first step
  std::uint64_t digest = 0;      // digest of the volume
  bool radiates = false;         // there is irradiance
  SceneText scene;
  state::MidRun run;    // its irradiance is a block of its own
  std::string command;  // JSON of the command that runs it
};

struct Checkpoint {
  Head head;
  state::Volume volume;
};

// Writes beside `place`, flushes and renames. It throws io::OutputError. `irradiance` is null for none.
void write(const std::filesystem::path& place, Head head, const state::Volume& volume,
           const state::Field<std::uint16_t>* irradiance, int threads);

// Reads a checkpoint. It throws Error if anything is not as write() leaves it: a bit, a length, a name. The
// cells are those of the digest. The reader of scenes decides if they make a volume.
Checkpoint read(const std::filesystem::path& file);
// Reads the head without the cells, which are not looked at.
Head read_head(const std::filesystem::path& file);

}  // namespace voxmelt::checkpoint
