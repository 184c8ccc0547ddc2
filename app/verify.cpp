// voxmelt verify: the hardware model in lock-step with the software.
#include "hwmodel/lockstep/verify.h"

#include <fmt/format.h>

#include <iostream>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "hwmodel/lockstep/replay.h"
#include "hwmodel/lockstep/report.h"
#include "hwmodel/presets/presets.h"
#include "kernel/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

struct VerifyCommand {
  Common common;
  std::uint32_t steps = 10, every = 1, from = 0;
  std::optional<std::uint32_t> plant_step;
  std::string hw, plant, out;
  std::vector<std::string> hw_sets;
};

fs::path find_preset(const std::string& given) {
  const fs::path path(given);
  if (given.empty() || path.has_parent_path() || path.has_extension()) return path;
  const fs::path named = fs::path(VOXMELT_PRESETS_FOLDER) / (given + ".toml");
  std::error_code ignored;
  if (fs::exists(named, ignored)) return named;
  throw UsageError(
      fmt::format("error: --hw {}: no hardware configuration of that name; `voxmelt list presets` names "
                  "those that came with it",
                  given));
}

// --set reaches both: hw.* is the hardware's, everything else the scene's.
void split_sets(VerifyCommand& command) {
  std::vector<std::string> scene;
  for (std::string& set : command.common.sets)
    (set.starts_with("hw.") ? command.hw_sets : scene).push_back(std::move(set));
  command.common.sets = std::move(scene);
}

// Everything that the user must type to see it again.
std::string again(const VerifyCommand& command, const std::string& scene, std::uint32_t steps,
                  std::uint32_t step) {
  std::string text = fmt::format("voxmelt verify {} --steps {}", scene, steps);
  if (!command.hw.empty()) text += " --hw " + command.hw;
  for (const std::string& set : command.hw_sets) text += " --set " + set;
  for (const std::string& set : command.common.sets) text += " --set " + set;
  if (command.common.seed) text += fmt::format(" --seed {}", *command.common.seed);
  if (!command.plant.empty()) text += fmt::format(" --plant {} --plant-step {}", command.plant, step);
  return text;
}

// The software runs alone to the step from which to verify; with radiation to the last step of visibility
// before.
run::Simulation run_ahead(scene::Scene& scene, const VerifyCommand& command) {
  const rule::Heat& heat = scene.parameters.heat;
  std::uint32_t until = scene.first_step + command.from;
  if (heat.enabled && heat.radiation) until -= until % heat.visibility_every;
  until = std::max(until, scene.first_step);
  if (!command.common.quiet && until != scene.first_step + command.from)
    fmt::print("verifying from step {}, a step of visibility\n", until);
  run::Simulation simulation = make_simulation(scene, command.common);
  while (simulation.step_number() < until) {
    simulation.step();
    stop_if_interrupted();
  }
  return simulation;
}

void write_replay(const VerifyCommand& command, const scene::Scene& scene,
                  const hwmodel::VerifyReport& report) {
  if (!report.replay || report.mismatch == nullptr) return;
  const std::uint32_t steps = report.mismatch->step - report.replay_step + 1;
  const fs::path place =
      command.out.empty() ? fs::path("out") / ("verify_" + scene.name) : fs::path(command.out);
  io::OutputFolder out(place);
  const std::string typed = again(command, (place / "scene.toml").string(), steps, report.mismatch->step);
  hwmodel::write_replay(out.partial(), scene.file, *report.replay, report.replay_step, typed);
  out.commit();
  fmt::print("the state before step {} is in {}; to see it again:\n  {}\n", report.replay_step,
             place.string(), typed);
}

int conclude(const VerifyCommand& command, const hwmodel::VerifyReport& report) {
  if (command.plant.empty()) return report.mismatch == nullptr ? kDone : kCheckFailed;
  if (!report.strike)
    throw UsageError(fmt::format(
        "error: --plant {}: in these steps of this scene there is nothing that this fault could change",
        command.plant));
  const auto& at = *report.strike;
  fmt::print("planted: {}, step {}, cell ({}, {}, {}); {}\n", at.where, at.step, at.x, at.y, at.z,
             report.mismatch == nullptr     ? "NOT FOUND"
             : report.found_where_planted() ? "found there"
                                            : "found, but ELSEWHERE");
  return kCheckFailed;
}

int run_verify(VerifyCommand command) {
  split_sets(command);
  const hwmodel::FaultInfo* fault = hwmodel::find_fault(command.plant);
  if (!command.plant.empty() && (fault == nullptr || fault->fault == hwmodel::Fault::none))
    throw UsageError(
        fmt::format("error: --plant {}: unknown; `voxmelt list faults` names them", command.plant));
  const hwmodel::Preset preset = hwmodel::load_preset(find_preset(command.hw), command.hw_sets);
  scene::Scene scene = load_scene(command.common);
  check_report_place(command.common, "");
  catch_interrupts();
  const run::Simulation ahead = run_ahead(scene, command);

  hwmodel::VerifyOptions options;
  options.steps = command.steps;
  options.every = command.every;
  options.configuration = preset.configuration;
  if (fault != nullptr) options.fault = fault->fault;
  options.fault_step = command.plant_step.value_or(ahead.step_number() + command.steps / 2);
  options.progress = [](std::uint32_t) { stop_if_interrupted(); };
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  const step::Implementation& fast = find_implementation(command.common);
  const hwmodel::VerifyReport report =
      hwmodel::verify(scene.parameters, ahead.volume(), ahead.step_number(), fast, tuning, options);

  const hwmodel::Configuration& c = options.configuration;
  const hwmodel::Design design{scene.parameters, {ahead.volume().grid, c.lanes}};
  write_report(command.common, hwmodel::json_of(report, design, c).dump(2) + '\n');
  fmt::print("{}: lanes {}, cascade {}, fifo depth {}, stall seed {}; steps {} to {}\n", scene.name, c.lanes,
             c.cascade, c.fifo_depth, c.stall_seed, report.first_step, report.first_step + report.steps);
  if (!command.common.quiet) fmt::print("{}", hwmodel::table_of(report, design, c));
  if (report.mismatch == nullptr) {
    fmt::print("{} cells compared behind {} stages, {} with {}: no difference; digest {:016x}\n",
               report.compared_cells, report.stages.size() - 2, report.software_cells, fast.name,
               report.digest);
  } else {
    fmt::print("{}", hwmodel::text_of(*report.mismatch));
    write_replay(command, scene, report);
  }
  return conclude(command, report);
}

}  // namespace

void add_verify(CLI::App& program, Chosen& chosen) {
  auto options = std::make_shared<VerifyCommand>();
  CLI::App* command = program.add_subcommand(
      "verify", "Run the hardware model in lock-step with the software; stop at the first difference");
  add_scene(*command, options->common);
  command->add_option("--steps", options->steps, "steps to verify")
      ->check(CLI::Range(1u, 1000000u))
      ->capture_default_str();
  command->add_option("--from", options->from, "steps that the software runs first (mid-melt)")
      ->capture_default_str();
  command->add_option("--every", options->every, "compare every K-th step, and the last")
      ->check(CLI::Range(1u, 1000000u))
      ->capture_default_str();
  command->add_option("--hw", options->hw,
                      "hardware configuration: a TOML file, or a name of `voxmelt list presets`");
  command->add_option("--plant", options->plant,
                      "plant a fault in the model (`voxmelt list faults`), to see it found");
  command->add_option("--plant-step", options->plant_step,
                      "the first step in which it may strike (default: in the middle)");
  command->add_option("--out", options->out,
                      "folder for the replay of a mismatch (default: out/verify_SCENE)");
  add_common(*command, options->common);
  command->footer(
      "--set also takes hw.lanes (1, 2, 4 .. 32), hw.cascade (1 .. 16), hw.fifo_depth (1 .. 1024), "
      "hw.stall_seed (0: none).");
  command->callback([options, &chosen] { chosen = [options] { return run_verify(*options); }; });
}

}  // namespace voxmelt::app
