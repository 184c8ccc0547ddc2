// The command `voxmelt verify` runs the hardware model in lock-step with the software.
#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "app/programs.h"
#include "app/resources.h"
#include "app/run_ahead.h"
#include "app/verify_command.h"
#include "app/verify_picture.h"
#include "app/visibility.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::app {

namespace fs = std::filesystem;

fs::path find_preset(const std::string& given) {
  const fs::path path(given);
  if (given.empty() || path.has_parent_path() || path.has_extension()) return path;
  const fs::path named = resource_folder("presets") / (given + ".toml");
  std::error_code ignored;
  if (fs::exists(named, ignored)) return named;
  throw UsageError(
      fmt::format("error: --hw {}: no hardware configuration of that name; `voxmelt list presets` names "
                  "those that came with it",
                  given));
}

// Reads --from.
scene::Scene load_beginning(VerifyCommand& command) {
  Beginning begin = begin_from(command.common, command.from_text);
  refuse_changes(begin.scene, "verify");
  command.from = begin.steps;
  return std::move(begin.scene);
}

void check_pipeline(const scene::Scene& scene, const hwmodel::Configuration& configuration) {
  const std::string missing = hwmodel::unmodelled_rule(scene.parameters);
  if (!missing.empty()) throw UsageError(fmt::format("error: {}", missing));
  const std::string problem = hwmodel::tile_problem(scene.parameters, scene.initial.grid, configuration);
  if (!problem.empty()) throw UsageError(fmt::format("error: hw.tile: {}", problem));
}

std::uint32_t plant_step(const VerifyCommand& command, std::uint32_t first_step) {
  return command.plant_step.value_or(first_step + command.steps / 2);
}

namespace {

// Splits the values of --set: hw.* is the hardware's, everything else the scene's.
void split_sets(VerifyCommand& command) {
  std::vector<std::string> scene;
  for (std::string& set : command.common.sets)
    (set.starts_with("hw.") ? command.hw_sets : scene).push_back(std::move(set));
  command.common.sets = std::move(scene);
}

int run_picture(VerifyCommand command) {
  scene::Scene scene = load_beginning(command);
  end_soon_at_interrupts();
  const run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);
  return verify_caster(command, scene, ahead);
}

// Refuses every option that the chosen machine does not have.
void check_asked(const VerifyCommand& command) {
  const bool picture = command.picture.asked, machine = command.picture.machine;
  const auto refuse = [](bool asked, const char* option, const char* why) {
    if (asked) throw UsageError(fmt::format("error: {}: {}", option, why));
  };
  refuse(machine && picture, "--machine", "it draws pictures without --picture");
  refuse(machine && !command.picture.pixel.empty(), "--pixel", "--machine draws whole pictures");
  refuse(machine && !command.vcd.empty(), "--vcd",
         "of one machine: the pipeline, or with --picture the caster");
  refuse(picture && !command.vcd.empty() && !command.vcd_from && !command.picture.compare, "--vcd",
         "with --no-compare no stage is compared; --vcd-from says which cycles");
  refuse(machine && !command.shrink.empty(), "--shrink",
         "of one machine: the pipeline, or with --picture the caster");
  if (command.sleep) {
    const char* const alone = "--sleep runs the software alone";
    refuse(picture, "--picture", alone);
    refuse(machine, "--machine", alone);
    refuse(!command.hw.empty() || !command.hw_sets.empty(), "--hw", alone);
    refuse(!command.plant.empty(), "--plant", alone);
    refuse(!command.vcd.empty(), "--vcd", alone);
    refuse(!command.shrink.empty(), "--shrink", alone);
    refuse(!command.size_fifos.empty(), "--size-fifos", alone);
    refuse(!command.picture.html.empty(), "--html", "--sleep has a --report, and no page");
    refuse(command.every != 1, "--every", "--sleep compares after every phase of every step");
  }
  refuse((picture || machine) && !command.size_fifos.empty(), "--size-fifos", "only of the pipeline alone");
  refuse(picture && command.plant_step.has_value(), "--plant-step", "a picture has no steps (--picture)");
  const bool rtl = !command.rtl.empty();
  refuse(rtl && picture, "--rtl", "the ray caster is not written in SystemVerilog");
  refuse(rtl && machine, "--rtl", "only of the pipeline alone");
  refuse(rtl && command.sleep, "--rtl", "--sleep runs the software alone");
  refuse(rtl && !command.shrink.empty(), "--rtl", "--shrink makes machines that it is not compiled for");
  refuse(rtl && !command.size_fifos.empty(), "--rtl", "--size-fifos is for the cycles of the models");
  refuse(command.plant_step && command.plant.empty(), "--plant-step",
         "there is no --plant whose step it would be");
  refuse(command.vcd_from && command.vcd.empty(), "--vcd-from",
         "there is no --vcd whose first cycle it would be");
  refuse(!command.size_fifos.empty() && !command.plant.empty(), "--size-fifos",
         "not with --plant; a fault may change the cycles");
  if (!command.shrink.empty() && fs::path(command.shrink).extension() != ".toml")
    throw UsageError(fmt::format("error: --shrink {}: want the name of a scene, FILE.toml", command.shrink));
}

int run_verify(VerifyCommand command) {
  split_sets(command);
  check_asked(command);
  if (command.sleep) return verify_sleep(std::move(command));
  if (command.picture.machine) return verify_whole_machine(std::move(command));
  if (command.picture.asked) return run_picture(std::move(command));
  return verify_pipeline(std::move(command));
}

void add_outputs(Command command, VerifyCommand& options) {
  command.option("--shrink", options.shrink,
                 "make what fails small (grid, steps or pixels, machine, matter): a scene FILE.toml");
  command.option("--vcd", options.vcd,
                 "write the waves of the 64 cycles around the first difference, for a waveform viewer");
  command.option("--vcd-from", options.vcd_from, "with --vcd: the 64 cycles from this cycle of the run on")
      .not_negative();
  command.option("--out", options.out, "folder for the replay of a mismatch (default: out/verify_SCENE)");
  command
      .option("--size-fifos", options.size_fifos,
              "first find the smallest depth of each channel that loses no cycle; write it to this file")
      .written_as("FILE.toml");
}

}  // namespace

void add_verify(CommandLine& program) {
  auto options = std::make_shared<VerifyCommand>();
  const Command command = program.add("verify", std::string(description_of("verify")));
  add_scene(command, options->common);
  command.option("--steps", options->steps, "steps to verify").within(1u, 1000000u).shows_default();
  command
      .option("--from", options->from_text,
              "steps that the software runs first (mid-melt), or a checkpoint of the scene")
      .shows_default();
  command.option("--every", options->every, "compare every K-th step, and the last")
      .within(1u, 1000000u)
      .shows_default();
  command.option("--hw", options->hw,
                 "hardware configuration: a TOML file, or a name of `voxmelt list presets`");
  command.flag("--sleep", options->sleep,
               "the software alone: step what sleeps, too, and compare after every phase");
  command
      .option("--rtl", options->rtl,
              "stages in SystemVerilog stand in for their models: all that there are, or these")
      .written_as("all|STAGE,STAGE");
  command.option("--plant", options->plant,
                 "plant a fault in the model (`voxmelt list faults`), to see it found");
  command.option("--plant-step", options->plant_step,
                 "the first step in which it may strike (default: in the middle)");
  add_outputs(command, *options);
  add_picture_choice(command, options->picture);
  add_common(command, options->common);
  add_visibility(command, options->common);
  std::string keys;
  for (const hwmodel::HwKey& key : hwmodel::kHwKeys)
    keys += fmt::format("hw.{} ({}), ", key.name, key.values);
  command.footer(
      fmt::format("--set also takes {}hw.memory (ddr4-2400), hw.clock_mhz; the ray caster's keys are in "
                  "docs/hardware/ray-caster.md.",
                  keys));
  command.runs([options] { return run_verify(*options); });
}

}  // namespace voxmelt::app
