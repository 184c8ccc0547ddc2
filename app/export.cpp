// The command `voxmelt export` writes the state after N steps, for other programs.
#include "kernel/run/io/export.h"

#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/drawn_surface.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/moment.h"
#include "app/options.h"
#include "app/print.h"
#include "app/report.h"
#include "app/run_journal.h"
#include "app/visibility.h"
#include "app/written_states.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

struct ExportOptions {
  Common common;
  std::uint32_t steps = 0;
  std::string out, format{io::formats().front().name}, surface;
};

// The keys of the scene, after --set. In the format npy the state beside it is its start.
std::string scene_toml(const scene::Scene& scene, const std::string& format, std::uint32_t step) {
  std::string text = fmt::format("# The keys of {}, at step {}; its shapes are in the fields.\n{}",
                                 scene.name, step, scene.settings);
  if (format == "npy") text += fmt::format("\n[start]\nfields = \".\"\nstep = {}\n", step);
  return text;
}

int run_export(const ExportOptions& options) {
  surface_named(options.surface, {options.format});
  check_format(options.format, "--format");
  scene::Scene scene = load_scene(options.common);
  keep_inputs(scene, {{"--out", options.out}, {"--report", options.common.report}});
  check_report_place(options.common, options.out);
  check_steps(scene, options.steps);
  end_soon_at_interrupts();
  io::OutputFolder out(options.out);
  run::Simulation simulation = make_simulation(scene, options.common);
  RunJournal journal(scene, simulation);
  while (simulation.steps_done() < options.steps) {
    journal.apply();
    simulation.step();
    stop_if_interrupted();
  }
  warn_of_limit(scene, options.common, simulation);

  const state::Volume& volume = simulation.volume();
  DrawnSurface surface;
  io::Moment moment = moment_of(simulation, scene);
  if (io::find_format(options.format)->of_surface && options.surface != "cells")
    moment.surface = surface.of(volume, scene, thread_count(options.common));
  io::find_format(options.format)->write(moment, out.partial(), stop_if_interrupted);
  io::write_file(out.partial() / "parameters.json",
                 io::parameters_json(simulation.parameters(), volume.grid, simulation.step_number()));
  io::write_file(out.partial() / "fields.json", io::fields_json(volume));
  scene.settings = journal.settings();
  io::write_file(out.partial() / "scene.toml", scene_toml(scene, options.format, simulation.step_number()));
  write_report(options.common, report_json(scene, options.common, simulation, {}));
  out.commit();
  if (!options.common.quiet)
    print("step {} written to {}\n", simulation.step_number(), seen_from_here(out.place()));
  return kDone;
}

}  // namespace

void add_export(CommandLine& program) {
  auto options = std::make_shared<ExportOptions>();
  const Command command = program.add("export",
                                      "Write the state after N steps (one file per field), its units and "
                                      "parameters, and a scene to go on from");
  add_scene(command, options->common);
  command.option("--steps", options->steps, "steps to run first").shows_default();
  command.option("--out", options->out, "folder to write").required();
  std::vector<std::string> names;
  std::string help;
  for (const io::Format& format : io::formats()) {
    names.emplace_back(format.name);
    help += fmt::format("{}{}: {}", help.empty() ? "" : "; ", format.name, format.description);
  }
  command.option("--format", options->format, help).one_of(names).shows_default();
  add_surface(command, options->surface);
  add_common(command, options->common);
  add_visibility(command, options->common);
  command.runs([options] { return run_export(*options); });
}

}  // namespace voxmelt::app
