// voxmelt run: the main job. Steps, frames, a contact sheet, a film, a report.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/visibility.h"
#include "app/watch.h"
#include "kernel/run/io/output_folder.h"
#include "render/image/png.h"

namespace voxmelt::app {
namespace {

struct RunOptions {
  Common common;
  std::optional<std::uint32_t> steps, frame_every;
  std::string out;
  std::optional<std::string> size;
};

// The first frame, every so many steps another, and the last one.
std::size_t frame_count(std::uint32_t steps, std::uint32_t every) {
  if (every == 0) return 1;
  return std::size_t{1} + steps / every + (steps % every != 0 ? 1 : 0);
}

// Does `work`; returns why the disk took no more, or nothing.
template <class Work>
std::string until_full(Work&& work) {
  const auto full = [](const auto& error) {
    if (!error.out_of_space()) throw error;
    return std::string(error.what());
  };
  try {
    work();
    return {};
  } catch (const io::OutputError& error) {
    return full(error);
  } catch (const render::ImageError& error) {
    return full(error);
  }
}

void print_outputs(const Film& film, const std::string& video_note, const std::string& place) {
  fmt::print("{} frames      {}/frames/\ncontact sheet  {}/contact_sheet.png\n", film.frame_count(), place,
             place);
  fmt::print("film           {}\n", video_note.empty() ? place + "/film.mp4" : video_note);
  fmt::print("report         {}/report.json\n", place);
}

int run_scene(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const Common& common = options.common;
  scene::Scene scene = load_scene(common);
  const std::uint32_t steps = options.steps.value_or(scene.steps);
  const std::uint32_t every = options.frame_every.value_or(scene.frame_every);
  if (options.size) set_size(scene.camera, *options.size);
  const std::string place_wanted = options.out.empty() ? "out/" + scene.name : options.out;
  keep_inputs(scene, {{"--out", place_wanted}, {"--report", common.report}});
  check_report_place(common, place_wanted);
  io::OutputFolder out(place_wanted);

  catch_interrupts();  // they end the run early; what was made until then is kept

  run::Simulation simulation = make_simulation(scene, common);
  std::optional<Film> film(std::in_place, scene, out.partial(), frame_count(steps, every),
                           thread_count(common));
  Watch watch;
  const auto show = [&](std::uint32_t step) {
    film->add_frame(simulation.volume(), step);
    watch.look(simulation.volume(), step);
  };
  std::string video_note;
  const std::string full = until_full([&] {
    show(0);
    Progress progress(steps, common.quiet);
    while (simulation.steps_done() < steps && !interrupted()) {
      simulation.step();
      film->check();
      const std::uint32_t done = simulation.steps_done();
      if (every > 0 && (done % every == 0 || done == steps)) show(done);
      progress.show(done, simulation.volume());
    }
    video_note = film->finish();
  });
  watch.look(simulation.volume(), simulation.steps_done());
  warn(scene, common, watch.warnings(simulation));

  const bool complete = full.empty() && simulation.steps_done() == steps;
  RunSeconds seconds = full.empty() ? film->seconds() : RunSeconds{};
  seconds.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::string report = report_json(scene, common, simulation, seconds, complete);
  if (!full.empty()) {
    film.reset();  // nothing is written beside what follows
    out.release_reserve();
    io::write_file(out.partial() / "report.json", report);
    const std::string kept = std::filesystem::proximate(out.keep_incomplete()).string();
    say(fmt::format("{}; the run ended after step {} of {}, and what was made is kept in {}/", full,
                    simulation.steps_done(), steps, kept));
    return kOutOfResources;
  }
  io::write_file(out.partial() / "report.json", report);
  write_report(common, report);
  out.commit();

  if (!common.quiet) {
    print_outputs(*film, video_note, std::filesystem::proximate(out.place()).string());
    if (const std::string limit = limit_text(simulation.ledger().limit); !limit.empty())
      fmt::print("note           {}\n", limit);
  }
  const std::string drift = drift_text(simulation.drift());
  if (!drift.empty()) {
    say("error: the ledgers do not balance: " + drift);
    return kCheckFailed;
  }
  if (complete) return kDone;
  say(fmt::format("interrupted after step {} of {}; what was made is kept", simulation.steps_done(), steps));
  return kInterrupted;
}

}  // namespace

void add_run(CLI::App& program, Chosen& chosen) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand(
      "run", "Melt a scene: frames (PNG), contact sheet, film (with ffmpeg) and report.json");
  add_scene(*command, options->common);
  command->add_option("--steps", options->steps, "steps to run (default: the scene's)");
  command->add_option("--frame-every", options->frame_every, "steps between frames; 0: the first only");
  command->add_option("--out", options->out, "folder to write (default: out/SCENE)");
  command->add_option("--size", options->size, "size of a frame in pixels, e.g. 640x480");
  add_common(*command, options->common);
  add_visibility(*command, options->common);
  command->callback([options, &chosen] { chosen = [options] { return run_scene(*options); }; });
}

}  // namespace voxmelt::app
