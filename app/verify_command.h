// The command holds the wishes of a user of `voxmelt verify`, for each of its three machines: the pipeline,
// the ray caster (--picture), and both on one memory (--machine).
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/message.h"
#include "app/options.h"
#include "app/verify_picture.h"
#include "hwmodel/pipeline/check/verify.h"
#include "hwmodel/pipeline/model/configuration.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct VerifyCommand {
  Common common;
  std::uint32_t steps = 10, every = 1, from = 0;
  std::string from_text = "0";  // --from: a step, or a checkpoint
  bool sleep = false;           // the software alone: --sleep
  std::optional<std::uint32_t> plant_step;
  std::string hw, plant, out, vcd, shrink, size_fifos, rtl;
  std::optional<std::int64_t> vcd_from;
  PictureChoice picture;
  std::vector<std::string> hw_sets;
};

int verify_pipeline(VerifyCommand command);
int verify_caster(const VerifyCommand& command, const scene::Scene& scene, const run::Simulation& state);
int verify_whole_machine(VerifyCommand command);
int verify_sleep(VerifyCommand command);

// Finds the file of --hw.
std::filesystem::path find_preset(const std::string& given);
// Reads --from.
scene::Scene load_beginning(VerifyCommand& command);
// Throws UsageError if it has no stage for a rule of the scene, or if its tiles are too narrow.
void check_pipeline(const scene::Scene& scene, const hwmodel::Configuration& configuration);
// Returns the first step in which a planted fault may strike, if the user names none.
std::uint32_t plant_step(const VerifyCommand& command, std::uint32_t first_step);

std::string name_of(const scene::Scene& scene);
// Returns the command that shows a picture again, but for its pixel.
std::string picture_again(const VerifyCommand& command, const std::string& scene);
// Does the same for the picture that --shrink makes, but for its pixels, its setting and what is plainer.
std::string small_picture_again(const VerifyCommand& command);

// Returns the folder of a replay. A replay extends its scene, so it must not take that scene's place.
std::filesystem::path replay_place(const VerifyCommand& command, const scene::Scene& scene);
void check_replay_place(const VerifyCommand& command, const scene::Scene& scene);
void write_replay(const VerifyCommand& command, const scene::Scene& scene,
                  const hwmodel::VerifyReport& report);

// Says if the planted fault was found.
void print_plant(const hwmodel::VerifyReport& report);

// Writes, and reports a full disk without ending: that must not hide a difference that was found.
template <class Write>
bool try_writing(Write&& write) {
  try {
    write();
    return true;
  } catch (const io::OutputError& error) {
    say(error.what());
    return false;
  }
}

}  // namespace voxmelt::app
