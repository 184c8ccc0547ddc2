// The command `voxmelt run` does the main job: steps, frames, a contact sheet, a film, a report.
#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>

#include "app/checkpoints.h"
#include "app/commands.h"
#include "app/film.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/resume.h"
#include "app/run_record.h"
#include "app/run_to_end.h"
#include "app/visibility.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"

namespace voxmelt::app {
namespace {

struct RunOptions {
  Common common;
  std::optional<std::uint32_t> steps, frame_every;
  std::string out;
  std::optional<std::string> size;
  std::optional<int> fps;
  std::optional<std::string> checkpoint_every;
  std::string resume;           // folder; empty for a run from the scene's beginning
  std::set<std::string> given;  // given options, among those that a resumed run may change
};

std::string by_chance() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

PreparedRun prepare(const RunOptions& options) {
  const Common& common = options.common;
  PreparedRun run{load_scene(common), {}, {}, nullptr};
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
  record.frames_per_second = options.fps.value_or(record.frames_per_second);
  record.id = by_chance();
  const std::string place = options.out.empty() ? "out/" + scene.name : options.out;
  keep_inputs(scene, {{"--out", place}, {"--report", common.report}});
  check_report_place(common, place);
  run.out = std::make_unique<io::OutputFolder>(place);
  return run;
}

// Returns nothing if the run is complete already.
std::optional<PreparedRun> prepare_to_resume(const RunOptions& options) {
  std::optional<Resumption> found = find_run(options.resume);
  if (!found) return std::nullopt;
  PreparedRun run{std::move(found->scene), std::move(found->text), std::move(found->record),
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
  if (options.fps) record.frames_per_second = *options.fps;
  find_implementation(common);
  check_report_place(common, found->place.string());
  if (!found->note.empty()) say("warning: " + found->note);
  return run;
}

int run_scene(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  if (options.resume.empty() && options.common.scene.empty())
    throw UsageError("error: a scene, or --resume FOLDER, is required; --help says more");
  if (options.checkpoint_every && !interval_of(*options.checkpoint_every))
    throw UsageError("--checkpoint-every: error: want a number of steps, or of seconds as in 60s");
  if (options.resume.empty()) return run_to_end(prepare(options), start);
  std::optional<PreparedRun> run = prepare_to_resume(options);
  if (run) return run_to_end(std::move(*run), start);
  if (!options.common.quiet) print("the run in {} is complete\n", options.resume);
  return kDone;
}

}  // namespace

void add_run(CommandLine& program) {
  auto options = std::make_shared<RunOptions>();
  const Command command =
      program.add("run", "Melt a scene: frames (PNG), contact sheet, film (with ffmpeg) and report.json");
  add_scene(command, options->common);
  const Option scene = command.find("scene").required(false);
  const Option resume =
      command.option("--resume", options->resume,
                     "go on with the run of this folder, which was interrupted, killed or out of room");
  resume.excludes(scene);
  const auto begins = [&](Option option) { option.excludes(resume); };
  begins(command.option("--steps", options->steps, "steps to run (default: the scene's)"));
  begins(command.option("--frame-every", options->frame_every, "steps between frames; 0: the first only"));
  begins(command.option("--out", options->out, "folder to write (default: out/SCENE)"));
  begins(command.option("--size", options->size, "size of a frame in pixels, e.g. 640x480"));
  command.option("--fps", options->fps, "frames of the film in a second (default: 12)")
      .within(1, kMostFramesPerSecond);
  command.option("--checkpoint-every", options->checkpoint_every,
                 "write a checkpoint after every N steps, or every N seconds (60s)");
  add_common(command, options->common);
  add_visibility(command, options->common);
  for (const char* option : {"--seed", "--set"}) begins(command.find(option));
  command.runs([options, command] {
    options->given = command.given();
    return run_scene(*options);
  });
}

}  // namespace voxmelt::app
