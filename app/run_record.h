// A checkpoint holds more than the automaton's run: the command that runs it, and what that has made.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/options.h"
#include "app/report.h"
#include "app/watch.h"
#include "kernel/run/checkpoint/checkpoint.h"

namespace voxmelt::app {

inline constexpr int kMostFramesPerSecond = 240;
// A run makes this beside its report, by the names of --keep: frames, contact sheet, film and last state.
inline constexpr std::array<std::string_view, 4> kKept{"frames", "sheet", "film", "state"};

// The names of --surface: as in the pictures, or around cells that are half full.
inline constexpr std::array<std::string_view, 2> kSurfaces{"picture", "cells"};

struct RunRecord {
  Common common;  // scene left empty
  std::uint32_t steps = 0, frame_every = 0;
  std::string size;                   // as --size; empty for the scene's
  std::string setting = "normal";     // as --setting
  std::string checkpoint_every;       // as --checkpoint-every; empty for none
  std::vector<std::string> write;     // formats of --write
  std::uint32_t write_every = 0;      // steps between states written; 0: the first and the last
  std::string surface;                // as --surface; empty for the usual one
  std::vector<std::string> left_out;  // of kKept, what a complete run removes
  std::string journal;                // text of --journal; empty for none
  std::string journal_name;           // as --journal
  int frames_per_second = 12;         // of the film
  std::string film = "auto";          // as --film
  std::string id;                     // random name of this run
  std::string shown_place;            // place of the output, as the user named it
  std::vector<checkpoint::FileState> frames;
  std::vector<std::uint32_t> frame_steps;
  Watch::Seen seen;
  RunSeconds seconds;
};

std::string json_of(const RunRecord& record);
// Reads a record. Throws checkpoint::Error naming `file`.
RunRecord run_record_of(const std::string& json, const std::filesystem::path& file);

// Returns what is not in the list of --keep. Throws UsageError.
std::vector<std::string> left_out_of(const std::optional<std::string>& keep);
bool is_kept(const RunRecord& record, std::string_view name);

// Returns what is in --film. Throws UsageError where this build cannot make such a film.
std::string film_named(const std::string& name);

// Tells if a frame is due: at the first step, every `frame_every` steps, and at the last one.
bool frame_is_due(const RunRecord& record, std::uint32_t step);
// Tells the same of the states of --write.
bool write_is_due(const RunRecord& record, std::uint32_t step);
std::size_t frames_due_before(const RunRecord& record, std::uint32_t step);

}  // namespace voxmelt::app
