// voxmelt verify: the hardware model in lock-step with the software.
#include "hwmodel/pipeline/check/verify.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/resources.h"
#include "app/run_ahead.h"
#include "app/shell_word.h"
#include "app/shrink.h"
#include "app/size_fifos.h"
#include "app/verify_machine.h"
#include "app/verify_picture.h"
#include "app/visibility.h"
#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/explore/content.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/machine/dram_streams.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/pipeline/check/replay.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/report/report.h"
#include "kernel/run/io/output_folder.h"
#include "report/hardware/page.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

constexpr double kShrinkSeconds = 40;

struct VerifyCommand {
  Common common;
  std::uint32_t steps = 10, every = 1, from = 0;
  std::string from_text = "0";  // --from: a step, or a checkpoint
  std::optional<std::uint32_t> plant_step;
  std::string hw, plant, out, vcd, shrink, size_fifos;
  std::optional<std::int64_t> vcd_from;
  PictureChoice picture;
  std::vector<std::string> hw_sets;
};

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

// --set reaches both: hw.* is the hardware's, everything else the scene's.
void split_sets(VerifyCommand& command) {
  std::vector<std::string> scene;
  for (std::string& set : command.common.sets)
    (set.starts_with("hw.") ? command.hw_sets : scene).push_back(std::move(set));
  command.common.sets = std::move(scene);
}

std::string who_computes(const Common& common) {
  std::string text;
  if (common.seed) text += fmt::format(" --seed {}", *common.seed);
  if (common.implementation != "auto") text += " --implementation " + common.implementation;
  return text;
}

// Everything that the user must type to see a picture again, but for its pixel.
std::string picture_again(const VerifyCommand& command, const std::string& scene) {
  const PictureChoice& picture = command.picture;
  std::string text = fmt::format("voxmelt verify {} --picture", shell_word(scene));
  if (command.from != 0) text += fmt::format(" --from {}", command.from);
  if (!picture.view.empty()) text += " --view=" + picture.view;
  if (!picture.size.empty()) text += " --size " + shell_word(picture.size);
  if (picture.setting != "normal") text += " --setting " + picture.setting;
  if (!command.hw.empty()) text += " --hw " + shell_word(command.hw);
  for (const auto* sets : {&command.hw_sets, &command.common.sets})
    for (const std::string& set : *sets) text += " --set " + shell_word(set);
  text += who_computes(command.common);
  if (!command.plant.empty()) text += " --plant " + command.plant;
  return text;
}

// Everything that the user must type to see it again.
std::string again(const VerifyCommand& command, const std::string& scene,
                  const hwmodel::VerifyReport& report) {
  const std::uint32_t step = report.mismatch->step;
  std::string text = fmt::format("voxmelt verify {} --steps {}", shell_word(scene),
                                 report.pass_end - report.replay_step);  // whole passes: the same cycles
  if (!command.hw.empty()) text += " --hw " + shell_word(command.hw);
  for (const std::string& set : command.hw_sets) text += " --set " + shell_word(set);
  for (const std::string& set : command.common.sets)  // the replay has its own start
    if (!set.starts_with("start.")) text += " --set " + shell_word(set);
  text += who_computes(command.common);
  if (!command.plant.empty()) text += fmt::format(" --plant {} --plant-step {}", command.plant, step);
  return text;
}

// A replay is called scene.toml, so its folder names it.
std::string name_of(const scene::Scene& scene) {
  const std::string folder = fs::absolute(scene.file).parent_path().filename().string();
  return scene.name == "scene" && !folder.empty() ? folder : scene.name;
}

fs::path replay_place(const VerifyCommand& command, const scene::Scene& scene) {
  return command.out.empty() ? fs::path("out") / ("verify_" + name_of(scene)) : fs::path(command.out);
}

// A replay extends its scene, so it must not take that scene's place.
void check_replay_place(const VerifyCommand& command, const scene::Scene& scene) {
  const fs::path within =
      fs::absolute(scene.file)
          .lexically_normal()
          .lexically_relative(fs::absolute(replay_place(command, scene)).lexically_normal());
  if (!within.empty() && *within.begin() != "..")
    throw UsageError(
        fmt::format("error: --out {}: the scene itself lies there", replay_place(command, scene).string()));
  if (!command.out.empty()) const io::OutputFolder can_be_written(command.out);
}

void write_replay(const VerifyCommand& command, const scene::Scene& scene,
                  const hwmodel::VerifyReport& report) {
  if (command.from == 0 && report.replay_step == scene.first_step) {
    if (!command.common.quiet)
      fmt::print("the scene itself begins with the state from which it can be seen again:\n  {}\n",
                 again(command, scene.file.string(), report));
    return;
  }
  const fs::path place = replay_place(command, scene);
  io::OutputFolder out(place);
  const std::string typed = again(command, (place / "scene.toml").string(), report);
  hwmodel::write_replay(out.partial(), scene.file, *report.replay, report.replay_step, typed);
  out.commit();
  if (!command.common.quiet)
    fmt::print("the state before step {} is in {}; to see it again:\n  {}\n", report.replay_step,
               place.string(), typed);
}

// A full disk must not hide a difference that was found.
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

void check_tile(const scene::Scene& scene, const hwmodel::Configuration& configuration) {
  const std::string problem = hwmodel::tile_problem(scene.parameters, scene.initial.grid, configuration);
  if (!problem.empty()) throw UsageError(fmt::format("error: hw.tile: {}", problem));
}

// What came of the planted fault.
void print_plant(const hwmodel::VerifyReport& report) {
  const auto& at = *report.strike;
  fmt::print("planted: {}, step {}, cell ({}, {}, {}); {}\n", at.where, at.step, at.x, at.y, at.z,
             report.mismatch == nullptr     ? "NOT FOUND"
             : report.found_where_planted() ? "found there"
                                            : "found, but ELSEWHERE");
}

// In one line.
std::string quiet_verdict(const hwmodel::VerifyReport& report) {
  if (report.mismatch == nullptr)
    return fmt::format("{} cells compared: no difference; digest {:016x}{}\n", report.compared_cells,
                       report.digest, report.strike ? "; the planted fault was NOT FOUND" : "");
  const hwmodel::Mismatch& m = *report.mismatch;
  return fmt::format("DIFFERS ({}): {}, step {}, cell ({}, {}, {}), {} expected {}, is {}{}\n",
                     name_of(m.kind), m.where, m.step, m.x, m.y, m.z, m.field.empty() ? "value" : m.field,
                     m.expected, m.actual,
                     !report.strike                 ? ""
                     : report.found_where_planted() ? "; planted there"
                                                    : "; planted ELSEWHERE");
}

void print_result(const VerifyCommand& command, const scene::Scene& scene,
                  const hwmodel::VerifyReport& report, const hwmodel::Design& design,
                  const hwmodel::Configuration& c, const std::string& fast) {
  if (command.common.quiet)
    return fmt::print("{}: {} cycles, predicted {}\n{}", name_of(scene), report.cycles,
                      report.predicted_cycles, quiet_verdict(report));
  fmt::print("{}: lanes {}, cascade {}, fifo depth {}, stall seed {}; steps {} to {}\n", name_of(scene),
             c.lanes, c.cascade, c.fifo_depth, c.stall_seed, report.first_step,
             report.first_step + report.steps);
  fmt::print("{}", hwmodel::table_of(report, design, c));
  const auto stages = std::count_if(
      report.stages.begin(), report.stages.end(),
      [](const hwmodel::StageReport& stage) { return phase_of(stage.kind) && stage.cascade == 0; });
  if (report.mismatch == nullptr)
    fmt::print(
        "{} cells compared behind {} stages of a time step, {} of the software ({}): no difference; digest "
        "{:016x}\n",
        report.compared_cells, stages, report.software_cells,
        fast == "reference" ? "the reference itself" : fast, report.digest);
  else
    fmt::print("{}", hwmodel::text_of(*report.mismatch));
  if (report.strike) print_plant(report);
}

// Reads --from.
scene::Scene load_beginning(VerifyCommand& command) {
  Beginning begin = begin_from(command.common, command.from_text);
  command.from = begin.steps;
  return std::move(begin.scene);
}

int run_picture(VerifyCommand command) {
  scene::Scene scene = load_beginning(command);
  end_soon_at_interrupts();
  const run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);
  PictureChoice picture = command.picture;
  picture.again = picture_again(command, scene.file.string());
  return verify_picture(command.common, picture, scene, ahead, find_preset(command.hw), command.hw_sets);
}

int run_machine(VerifyCommand command) {
  if (command.picture.asked) throw UsageError("error: --machine: it draws pictures without --picture");
  if (!command.picture.pixel.empty()) throw UsageError("error: --pixel: --machine draws whole pictures");
  if (!command.plant.empty() || command.plant_step)
    throw UsageError("error: --plant: not with --machine; plant it in one machine alone");
  const hwmodel::Preset preset =
      hwmodel::load_preset(find_preset(command.hw), command.hw_sets, hwmodel::Runs::machine);
  scene::Scene scene = load_beginning(command);
  check_tile(scene, preset.configuration);
  check_replay_place(command, scene);
  check_report_place(command.common, replay_place(command, scene).string());
  check_html_place(command.common, command.picture, replay_place(command, scene).string());
  end_soon_at_interrupts();
  const run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);
  hwmodel::VerifyOptions options;
  options.steps = command.steps;
  options.every = command.every;
  options.configuration = preset.configuration;
  options.poll = stop_if_interrupted;
  const hwmodel::MachineReport report =
      verify_machine(command.common, command.picture, scene, ahead, preset, options);
  if (report.steps.mismatch != nullptr) try_writing([&] { write_replay(command, scene, report.steps); });
  return report.good() ? kDone : kCheckFailed;
}

// What the DRAM gives at most, and what the closed form says of each train on it, for a run that moves what
// the state holds at its begin.
void predict_on_memory(hwmodel::VerifyReport& report, const hwmodel::Design& design,
                       const hwmodel::Preset& preset, run::Simulation& ahead) {
  report.most_bytes_per_cycle = hwmodel::raycast::most_bytes_per_cycle(preset.caster);
  ahead.begin_step();  // its irradiance
  const hwmodel::Configuration& c = preset.configuration;
  const hwmodel::Design uncut{design.parameters, {ahead.volume().grid, c.lanes}, 1};
  const std::vector<hwmodel::explore::Train> trains =
      trains_of(design, c, report.first_step, report.steps,
                hwmodel::explore::content_of(uncut, ahead.irradiance(), &ahead.volume()));
  if (trains.size() != report.trains.size()) return;  // the state decides on sub-steps
  for (std::size_t i = 0; i < trains.size(); ++i)
    report.trains[i].predicted_on_memory = hwmodel::explore::cycles_on(
        trains[i].work, *preset.caster.dram, preset.caster.clock_mhz, trains[i].placement);
}

// What the pipeline alone can do.
void check_outputs(const VerifyCommand& command) {
  const bool pipeline = !command.picture.asked && !command.picture.machine;
  if (!pipeline && !command.vcd.empty()) throw UsageError("error: --vcd: only of the pipeline alone");
  if (!pipeline && !command.shrink.empty())
    throw UsageError("error: --shrink: only of the pipeline alone (--picture finds one pixel by itself)");
  if (command.vcd_from && command.vcd.empty())
    throw UsageError("error: --vcd-from: there is no --vcd whose first cycle it would be");
  if (!command.shrink.empty() && fs::path(command.shrink).extension() != ".toml")
    throw UsageError(fmt::format("error: --shrink {}: want the name of a scene, FILE.toml", command.shrink));
}

// Why there are no waves; empty: there are, or nobody asked.
std::string write_waves(const VerifyCommand& command, const hwmodel::VerifyReport& report) {
  if (command.vcd.empty()) return {};
  if (report.waves.empty())
    return fmt::format("--vcd {}: error: the run ended before cycle {}; nothing was written", command.vcd,
                       command.vcd_from.value_or(0));
  io::write_file(command.vcd, report.waves);
  return {};
}

int run_verify(VerifyCommand command) {
  split_sets(command);
  check_outputs(command);
  if (command.picture.machine) return run_machine(command);
  if (command.picture.asked) {
    if (command.plant_step) throw UsageError("error: --plant-step: a picture has no steps (--picture)");
    command.picture.plant = command.plant;
    return run_picture(command);
  }
  const hwmodel::FaultInfo* fault = hwmodel::find_fault(command.plant);
  if (!command.plant.empty() && (fault == nullptr || fault->fault == hwmodel::Fault::none))
    throw UsageError(
        fmt::format("error: --plant {}: unknown; `voxmelt list faults` names them", command.plant));
  if (command.plant_step && command.plant.empty())
    throw UsageError("error: --plant-step: there is no --plant whose step it would be");
  hwmodel::Preset preset = hwmodel::load_preset(find_preset(command.hw), command.hw_sets);
  if (!command.size_fifos.empty() && fault != nullptr)
    throw UsageError("error: --size-fifos: not with --plant; a fault may change the cycles");
  scene::Scene scene = load_beginning(command);
  check_tile(scene, preset.configuration);
  if (!command.size_fifos.empty() && preset.caster.dram && preset.configuration.coded &&
      scene.parameters.flow.law == rule::Law::viscous && scene.parameters.flow.viscous.substeps != 1)
    throw UsageError(
        "error: --size-fifos: not with hw.coded on hw.memory for a scene with sub-steps; what the memory "
        "moves would depend on the state between them");
  check_replay_place(command, scene);
  check_report_place(command.common, replay_place(command, scene).string());
  check_html_place(command.common, command.picture, replay_place(command, scene).string());
  check_place("--vcd", command.vcd, replay_place(command, scene).string());
  check_place("--shrink", command.shrink, replay_place(command, scene).string());
  check_place("--size-fifos", command.size_fifos, replay_place(command, scene).string());
  keep_inputs(scene, {{"--html", command.picture.html},
                      {"--vcd", command.vcd},
                      {"--shrink", command.shrink},
                      {"--size-fifos", command.size_fifos}});
  end_soon_at_interrupts();
  run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);

  const VerifiedStream stream{scene.parameters, ahead.volume(), ahead.step_number(), command.steps};
  check_channels(stream, preset);
  std::optional<std::int64_t> sized_cycles;
  if (!command.size_fifos.empty())
    sized_cycles = size_fifos(stream, command.common, command.size_fifos, preset);
  const hwmodel::Design design =
      hwmodel::design_of(scene.parameters, ahead.volume().grid, preset.configuration);
  std::optional<hwmodel::DramStreams> dram;
  if (preset.caster.dram)
    dram.emplace(design, preset.configuration.cascade, *preset.caster.dram, preset.caster.clock_mhz);
  hwmodel::VerifyOptions options;
  options.memory = dram ? &*dram : nullptr;
  options.steps = command.steps;
  options.every = command.every;
  options.configuration = preset.configuration;
  if (fault != nullptr) options.fault = fault->fault;
  options.fault_step = command.plant_step.value_or(ahead.step_number() + command.steps / 2);
  options.poll = stop_if_interrupted;
  options.waves = !command.vcd.empty();
  options.waves_from = command.vcd_from;
  options.timeline = !command.common.report.empty() || !command.picture.html.empty();
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  const step::Implementation& fast = find_implementation(command.common);
  hwmodel::VerifyReport report =
      hwmodel::verify(scene.parameters, ahead.volume(), ahead.step_number(), fast, tuning, options);
  if (preset.caster.dram) predict_on_memory(report, design, preset, ahead);

  const hwmodel::Verdict verdict = hwmodel::verdict_of(report, fault != nullptr);
  if (verdict == hwmodel::Verdict::never_struck)
    throw UsageError(fmt::format(
        "error: --plant {}: in these steps of this scene there is nothing that this fault could change",
        command.plant));
  print_result(command, scene, report, design, options.configuration, fast.name);
  const auto write = [&] {
    nlohmann::ordered_json json{{"scene", name_of(scene)}};
    json.update(hwmodel::json_of(report, design, preset.configuration));
    write_report(command.common, json.dump(2) + '\n');
    if (!command.picture.html.empty())
      io::write_file(command.picture.html,
                     hwmodel::pipeline_page(json, fmt::format("{}, {} steps from step {}", name_of(scene),
                                                              report.steps, report.first_step)));
  };
  if (verdict == hwmodel::Verdict::good) {
    write();
    const std::string no_waves = write_waves(command, report);
    if (!no_waves.empty()) throw UsageError(no_waves);
    if (!command.shrink.empty() && !command.common.quiet)
      fmt::print("--shrink: there is no difference to make small\n");
    return !sized_cycles || check_sized(*sized_cycles, report.cycles) ? kDone : kCheckFailed;
  }
  try_writing(write);
  try_writing([&] {
    const std::string no_waves = write_waves(command, report);
    if (!no_waves.empty()) say(no_waves);
  });
  if (report.mismatch == nullptr) return kCheckFailed;
  try_writing([&] { write_replay(command, scene, report); });
  if (command.shrink.empty()) return kCheckFailed;
  options.memory = nullptr;  // what is cut has other streams
  try_writing([&] {
    const std::string small =
        shrink({command.shrink, kShrinkSeconds, command.common, scene, options, command.plant}, report);
    if (!command.common.quiet) fmt::print("{}", small);
  });
  return kCheckFailed;
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
  command
      ->add_option("--from", options->from_text,
                   "steps that the software runs first (mid-melt), or a checkpoint of the scene")
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
  command->add_option("--shrink", options->shrink,
                      "make what fails small (grid, steps, machine, matter): a scene FILE.toml");
  command->add_option("--vcd", options->vcd,
                      "write the waves of the 64 cycles around the first difference, for a waveform viewer");
  command
      ->add_option("--vcd-from", options->vcd_from, "with --vcd: the 64 cycles from this cycle of the run on")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", options->out,
                      "folder for the replay of a mismatch (default: out/verify_SCENE)");
  command
      ->add_option("--size-fifos", options->size_fifos,
                   "first find the smallest depth of each channel that loses no cycle; write it to this file")
      ->type_name("FILE.toml");
  add_picture_choice(*command, options->picture);
  add_common(*command, options->common);
  add_visibility(*command, options->common);
  command->footer(
      "--set also takes hw.lanes (1, 2, 4 .. 32), hw.cascade (1 .. 16), hw.substeps (1 .. 64), "
      "hw.fifo_depth (1 .. 1024), hw.stall_seed (0: none), hw.overlap (0, 1), hw.tile (0: none), "
      "hw.coded (0, 1), hw.memory (ddr4-2400), hw.clock_mhz; the ray caster's keys are in "
      "docs/hardware-picture.md.");
  command->callback([options, &chosen] { chosen = [options] { return run_verify(*options); }; });
}

}  // namespace voxmelt::app
