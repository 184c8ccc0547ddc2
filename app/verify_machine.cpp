// The command `voxmelt verify --machine` runs the pipeline and the ray caster on one memory, in lock-step
// with the software.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <string_view>

#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/print.h"
#include "app/run_ahead.h"
#include "app/verify_command.h"
#include "app/verify_picture.h"
#include "app/verify_report.h"
#include "app/visibility.h"
#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/machine/machine.h"
#include "hwmodel/machine/presets/presets.h"
#include "hwmodel/machine/report_machine.h"
#include "hwmodel/pipeline/faults/faults.h"
#include "kernel/run/io/output_folder.h"
#include "measure/paper.h"
#include "render/image/png.h"
#include "render/packet/picture.h"

namespace voxmelt::app {
namespace {

// Holds the software's time for the same steps and pictures. It is in seconds of one thread of this processor
// for all of them, in the best of several runs.
struct Software {
  double steps = 0, update = 0, draw = 0;
  double total() const { return steps + update + draw; }
};

Software measure_software(const scene::Scene& scene, const scene::Camera& camera, render::Setting setting,
                          const run::Simulation& ahead, const step::Implementation& implementation,
                          std::uint32_t steps, std::uint32_t between) {
  constexpr int kRuns = 3;
  Software best;
  for (int round = 0; round < kRuns; ++round) {
    step::Tuning tuning;
    tuning.threads = 1;
    run::Simulation simulation(scene.parameters, ahead.volume(), implementation, tuning);
    simulation.begin_at(ahead.step_number());
    render::Picture picture;
    Software took;
    const auto time = [](double& sum, const auto& work) {
      const std::clock_t begin = std::clock();  // processor time, as the machine may have other work
      work();
      sum += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, 1);
    for (std::uint32_t done = 0; done < steps; done += between) {
      time(took.steps, [&] {
        for (std::uint32_t i = 0; i < between; ++i) simulation.step();
      });
      time(took.update,
           [&] { picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, 1); });
      time(took.draw, [&] { static_cast<void>(picture.draw(camera, setting, 1)); });
      stop_if_interrupted();
    }
    if (round == 0) best = took;
    best.steps = std::min(best.steps, took.steps);
    best.update = std::min(best.update, took.update);
    best.draw = std::min(best.draw, took.draw);
  }
  return best;
}

// Returns the paper's row of a scene, or of its sister under the viscous law. It is null if there is none.
const measure::PaperRow* paper_row(std::string_view scene) {
  for (const measure::PaperRow& row : measure::kPaperTable)
    if (scene == row.scene || scene == std::string(row.scene) + "_viscous") return &row;
  return nullptr;
}

// Begins with the machine that differs, if only one does.
std::string verdict_of(const hwmodel::MachineReport& report) {
  const std::string pictures = hwmodel::raycast::verdict_text(report.pictures);
  if (report.steps.mismatch != nullptr) return hwmodel::text_of(*report.steps.mismatch) + pictures;
  if (report.steps.steps == 0) return pictures;
  const std::string steps =
      fmt::format("{} cells compared behind the stages of the pipeline: no difference; digest {:016x}{}\n",
                  report.steps.compared_cells, report.steps.digest,
                  report.steps.strike ? "; the planted fault was NOT FOUND" : "");
  return report.pictures.good() && !report.pictures.strike ? steps + pictures : pictures + steps;
}

// Chooses the planted fault, of either machine.
void plant(hwmodel::MachineOptions& options, const VerifyCommand& command, std::uint32_t first_step) {
  if (command.plant.empty()) return;
  const hwmodel::FaultInfo* stream = hwmodel::find_fault(command.plant);
  const hwmodel::raycast::FaultInfo* caster = hwmodel::raycast::find_fault(command.plant);
  if (stream == nullptr && caster == nullptr)
    throw UsageError(
        fmt::format("error: --plant {}: unknown; `voxmelt list faults` names them", command.plant));
  if (caster != nullptr && command.plant_step)
    throw UsageError("error: --plant-step: a picture has no steps");
  if (stream != nullptr) options.steps.fault = stream->fault;
  if (caster != nullptr) options.picture.fault = caster->fault;
  options.steps.fault_step = plant_step(command, first_step);
}

hwmodel::MachineOptions options_of(const VerifyCommand& command, const hwmodel::Preset& preset,
                                   std::uint32_t first_step) {
  const PictureChoice& choice = command.picture;
  hwmodel::MachineOptions options;
  options.steps.steps = command.steps;
  options.steps.every = command.every;
  options.steps.configuration = preset.configuration;
  options.steps.poll = options.picture.poll = stop_if_interrupted;
  options.picture.configuration = preset.caster;
  options.picture.compare = choice.compare;
  options.picture.frames = choice.frames;
  plant(options, command, first_step);
  return options;
}

void print_machine(const VerifyCommand& command, const scene::Scene& scene, const scene::Camera& camera,
                   const hwmodel::MachineReport& report, const hwmodel::Preset& preset) {
  const hwmodel::Configuration& p = preset.configuration;
  const hwmodel::raycast::Configuration& c = preset.caster;
  if (command.common.quiet)
    return print("{}: {} cycles, overlapped\n", scene.name, report.sum().overlapped());
  print("{}: pipeline: lanes {}, cascade {}; ray caster: pipes {}; fifo depth {}, stall seed {}\n",
        scene.name, p.lanes, p.cascade, c.pipes, c.fifo_depth, c.stall_seed);
  print("{} x {}, {}; memory: {}\n", camera.width, camera.height, command.picture.setting,
        c.dram ? c.dram->name : fmt::format("latency {}, {} bytes a cycle", c.latency, c.bus_bytes));
}

// Measures the software beside it, for the report and for people.
SoftwareRates beside_software(const VerifyCommand& command, const scene::Scene& scene,
                              const scene::Camera& camera, const run::Simulation& ahead,
                              const hwmodel::MachineReport& report, const hwmodel::MachineOptions& options) {
  const step::Implementation& fast = find_phased_implementation(command.common);
  const std::uint32_t steps = command.steps, frames = command.picture.frames;
  const Software here = measure_software(scene, camera, setting_of(command.picture.setting), ahead, fast,
                                         steps, steps / frames);
  const double n = frames;
  if (!command.common.quiet) {
    print("{}", hwmodel::table_of(report, options));
    print(
        "the software here, one thread, {}: {:.1f} steps, {:.1f} updates, {:.1f} pictures a second; "
        "{:.1f} frames\n",
        fast.name, steps / here.steps, n / here.update, n / here.draw, n / here.total());
    if (const measure::PaperRow* row = paper_row(scene.name))
      print("the paper, 2003, {}: gravity {:.1f} ms, spreading {:.1f}, update {:.1f}: {:.1f} frames\n",
            row->as, row->gravity, row->spreading, row->update, row->frames());
  }
  return {fast.name, steps / here.steps, n / here.update, n / here.draw, n / here.total()};
}

bool struck(const hwmodel::MachineReport& report) { return report.steps.strike || report.pictures.strike; }

// Simulates, prints, and writes the results.
hwmodel::MachineReport run_machine(const VerifyCommand& command, const scene::Scene& scene,
                                   const run::Simulation& ahead, const hwmodel::Preset& preset) {
  const PictureChoice& choice = command.picture;
  const scene::Camera camera = camera_of(choice, scene);
  const hwmodel::MachineOptions options = options_of(command, preset, ahead.step_number());
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  hwmodel::MachineReport report = hwmodel::verify_machine(
      {scene.parameters,
       ahead.step_number(),
       find_phased_implementation(command.common),
       tuning,
       {ahead.volume(), scene.look, scene.light, scene.terrain, camera, setting_of(choice.setting)}},
      options);
  if (!command.plant.empty() && report.good() && !struck(report))
    throw UsageError(fmt::format(
        "error: --plant {}: in these steps and pictures there is nothing that this fault could change",
        command.plant));
  print_machine(command, scene, camera, report, preset);
  std::optional<SoftwareRates> software;
  if (report.good()) software = beside_software(command, scene, camera, ahead, report, options);
  print("{}", command.common.quiet ? first_line(verdict_of(report)) : verdict_of(report));
  if (report.steps.strike && !command.common.quiet) print_plant(report.steps);
  write_machine_report({command.common, choice.html}, {scene.name, camera.width, camera.height}, report,
                       options, software);
  if (!choice.png.empty()) render::write_png(choice.png, report.pictures.image);
  return report;
}

}  // namespace

int verify_whole_machine(VerifyCommand command) {
  const PictureChoice& choice = command.picture;
  if (command.steps % choice.frames != 0)
    throw UsageError(fmt::format("error: --frames {}: --steps {} is no multiple of it (--machine)",
                                 choice.frames, command.steps));
  const hwmodel::Preset preset =
      hwmodel::load_preset(find_preset(command.hw), command.hw_sets, hwmodel::Runs::machine);
  scene::Scene scene = load_beginning(command);
  check_pipeline(scene, preset.configuration);
  check_replay_place(command, scene);
  check_report_place(command.common, replay_place(command, scene).string());
  check_html_place(command.common, choice, replay_place(command, scene).string());
  end_soon_at_interrupts();
  const run::Simulation ahead = run_ahead(scene, command.common, command.from, command.steps);
  const hwmodel::MachineReport report = run_machine(command, scene, ahead, preset);
  if (report.steps.mismatch != nullptr) try_writing([&] { write_replay(command, scene, report.steps); });
  return report.good() && !struck(report) ? kDone : kCheckFailed;
}

}  // namespace voxmelt::app
