// voxmelt run: the main job. Steps, frames, a contact sheet, a film, a report.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "app/checkpoints.h"
#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/resume.h"
#include "app/run_record.h"
#include "app/shell_word.h"
#include "app/visibility.h"
#include "app/watch.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/run/io/checkpoint_files.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "render/image/png.h"

namespace voxmelt::app {
namespace {

struct RunOptions {
  Common common;
  std::optional<std::uint32_t> steps, frame_every;
  std::string out;
  std::optional<std::string> size;
  std::optional<std::string> checkpoint_every;
  std::string resume;           // folder; empty for a run from the scene's beginning
  std::set<std::string> given;  // options on the command line, of those that a resumed run may change
};

// A run that can begin, or go on.
struct Prepared {
  scene::Scene scene;
  checkpoint::SceneText text;
  RunRecord record;
  std::unique_ptr<io::OutputFolder> out;
};

std::string by_chance() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

Prepared prepare(const RunOptions& options) {
  const Common& common = options.common;
  Prepared run{load_scene(common), {}, {}, nullptr};
  scene::Scene& scene = run.scene;
  if (scene.mid_run)
    throw UsageError(fmt::format(
        "error: {} is a checkpoint; `voxmelt run --resume FOLDER` goes on with a run", common.scene));
  run.text = run::scene_text(scene, scene.initial.grid);
  RunRecord& record = run.record;
  record.common = common;
  if (!common.report.empty()) record.common.report = std::filesystem::absolute(common.report).string();
  record.steps = options.steps.value_or(scene.steps);
  record.frame_every = options.frame_every.value_or(scene.frame_every);
  record.size = options.size.value_or("");
  if (options.size) set_size(scene.camera, *options.size);
  record.checkpoint_every = options.checkpoint_every.value_or("");
  record.id = by_chance();
  const std::string place = options.out.empty() ? "out/" + scene.name : options.out;
  keep_inputs(scene, {{"--out", place}, {"--report", common.report}});
  check_report_place(common, place);
  run.out = std::make_unique<io::OutputFolder>(place);
  return run;
}

// Nothing where the run is complete already.
std::optional<Prepared> prepare_to_resume(const RunOptions& options) {
  std::optional<Resumption> found = find_run(options.resume);
  if (!found) return std::nullopt;
  Prepared run{std::move(found->scene), std::move(found->text), std::move(found->record),
               std::move(found->folder)};
  RunRecord& record = run.record;
  if (!record.size.empty()) set_size(run.scene.camera, record.size);
  Common& common = record.common;
  const auto given = [&](const char* option) { return options.given.contains(option); };
  if (given("--implementation")) common.implementation = options.common.implementation;
  if (given("--visibility")) common.visibility = options.common.visibility;
  if (given("--threads")) common.threads = options.common.threads;
  if (given("--report")) common.report = std::filesystem::absolute(options.common.report).string();
  if (given("--quiet")) common.quiet = true;
  if (options.checkpoint_every) record.checkpoint_every = *options.checkpoint_every;
  find_implementation(common);
  check_report_place(common, found->place.string());
  if (!found->note.empty()) say("warning: " + found->note);
  return run;
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

RunSeconds sum_of(const RunSeconds& a, const RunSeconds& b) {
  return {a.update + b.update, a.render + b.render, a.encode + b.encode, a.wait + b.wait, a.total + b.total};
}

// A run from where it is to its end.
int run_on(Prepared run, std::chrono::steady_clock::time_point start) {
  scene::Scene& scene = run.scene;
  const RunRecord& record = run.record;
  const Common& common = record.common;
  io::OutputFolder& out = *run.out;
  const std::uint32_t steps = record.steps;
  const std::optional<Interval> interval = interval_of(record.checkpoint_every);
  catch_interrupts();  // they end the run early; what was made until then is kept

  const std::uint32_t begun_at = scene.mid_run ? scene.mid_run->steps_done : 0;
  run::Simulation simulation = make_simulation(scene, common);
  const std::size_t planned = frames_due_before(record, steps) + (frame_is_due(record, steps) ? 1 : 0);
  std::optional<Film> film(std::in_place, scene, out.partial(), planned, thread_count(common));
  film->keep(record.frame_steps);
  Checkpoints checkpoints(out.partial(), scene, std::move(run.text), thread_count(common));
  Watch watch(record.seen);
  const auto seconds_now = [&] {
    RunSeconds now = film->seconds();
    now.total = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return sum_of(record.seconds, now);
  };
  const auto checkpoint = [&] {
    film->settle();  // what threads have timed is known then
    return checkpoints.write(record, *film, simulation, watch.seen(), seconds_now());
  };
  const auto show = [&](std::uint32_t step) {
    if (film->is_slow() && checkpoints.affordable())
      checkpoint();  // an interrupt may lose this frame: then the run goes on from here
    film->add_frame(simulation.volume(), step);
    watch.look(simulation.volume(), step);
  };
  std::string video_note;
  bool resumable = true;
  std::string full = until_full([&] {
    if (interval && begun_at == 0) checkpoint();
    if (frame_is_due(record, begun_at) && record.frame_steps.size() == frames_due_before(record, begun_at))
      show(begun_at);
    Progress progress(steps, common.quiet, begun_at);
    while (simulation.steps_done() < steps && !interrupted()) {
      simulation.step();
      film->check();
      const std::uint32_t done = simulation.steps_done();
      if (done < steps && checkpoints.due(interval, done)) checkpoint();
      if (frame_is_due(record, done)) show(done);
      progress.show(done, simulation.volume());
    }
    if (simulation.steps_done() < steps) resumable = checkpoint() || io::holds_work(out.partial());
    video_note = film->finish();
  });
  const bool complete = full.empty() && simulation.steps_done() == steps;
  watch.look(simulation.volume(), simulation.steps_done());
  std::vector<std::string> warnings = watch.warnings(simulation);
  if (complete && steps > 0 && state::digest(simulation.volume()) == scene.initial_digest)
    warnings.push_back(
        fmt::format("nothing has changed in {} step{}: no liquid can move, and no heat comes to a solid",
                    steps, steps == 1 ? "" : "s"));
  warn(scene, common, warnings);

  const std::string place = seen_from_here(out.place());
  if (full.empty()) {
    full = until_full([&] {
      const std::string report = report_json(scene, common, simulation, seconds_now(), complete);
      io::write_file(out.partial() / "report.json", report);
      write_report(common, report);
      out.commit();
    });
  }
  if (!full.empty()) {
    film.reset();  // nothing is written beside what follows
    out.release_reserve();
    io::write_file(out.partial() / "report.json",
                   report_json(scene, common, simulation, RunSeconds{}, false));
    const bool goes_on = io::holds_work(out.partial());
    const std::string kept = seen_from_here(out.keep_incomplete());
    say(fmt::format(
        "{}; the run ended after step {} of {}, and what was made is kept in {}/{}", full,
        simulation.steps_done(), steps, kept,
        goes_on ? "; with more room, `voxmelt run --resume " + shell_word(place) + "` goes on" : ""));
    return kOutOfResources;
  }
  if (complete) clear_after(out.place(), record.id);

  if (!common.quiet) {
    print_outputs(*film, video_note, place);
    if (const std::string limit = limit_text(simulation.ledger().limit); !limit.empty())
      fmt::print("note           {}\n", limit);
  }
  const std::string drift = drift_text(simulation.drift());
  if (!drift.empty()) {
    say("error: the ledgers do not balance: " + drift);
    return kCheckFailed;
  }
  if (complete) return kDone;
  say(fmt::format("interrupted after step {} of {}; what was made is kept{}", simulation.steps_done(), steps,
                  resumable ? "; `voxmelt run --resume " + shell_word(place) + "` goes on" : ""));
  return kInterrupted;
}

int run_scene(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (options.resume.empty()) return run_on(prepare(options), start);
  std::optional<Prepared> run = prepare_to_resume(options);
  if (run) return run_on(std::move(*run), start);
  if (!options.common.quiet) fmt::print("the run in {} is complete\n", options.resume);
  return kDone;
}

}  // namespace

void add_run(CLI::App& program, Chosen& chosen) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* command = program.add_subcommand(
      "run", "Melt a scene: frames (PNG), contact sheet, film (with ffmpeg) and report.json");
  add_scene(*command, options->common);
  CLI::Option* scene = command->get_option("scene")->required(false);
  CLI::Option* resume =
      command->add_option("--resume", options->resume,
                          "go on with the run of this folder, which was interrupted, killed or out of room");
  resume->excludes(scene);
  const auto begins = [&](CLI::Option* option) { option->excludes(resume); };
  begins(command->add_option("--steps", options->steps, "steps to run (default: the scene's)"));
  begins(
      command->add_option("--frame-every", options->frame_every, "steps between frames; 0: the first only"));
  begins(command->add_option("--out", options->out, "folder to write (default: out/SCENE)"));
  begins(command->add_option("--size", options->size, "size of a frame in pixels, e.g. 640x480"));
  command->add_option("--checkpoint-every", options->checkpoint_every,
                      "write a checkpoint after every N steps, or every N seconds (60s)");
  add_common(*command, options->common);
  add_visibility(*command, options->common);
  for (const char* option : {"--seed", "--set"}) begins(command->get_option(option));
  command->callback([options, command, &chosen] {
    if (options->resume.empty() && options->common.scene.empty())
      throw CLI::RequiredError("a scene, or --resume FOLDER,");
    if (options->checkpoint_every && !interval_of(*options->checkpoint_every))
      throw UsageError("--checkpoint-every: error: want a number of steps, or of seconds as in 60s");
    for (const CLI::Option* option : command->get_options())
      if (option->count() > 0) options->given.insert(option->get_name());
    chosen = [options] { return run_scene(*options); };
  });
}

}  // namespace voxmelt::app
