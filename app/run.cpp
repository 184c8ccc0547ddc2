// The command `voxmelt run` does the main job: steps, frames, a contact sheet, a film, a report.
#include <fmt/format.h>

#include <array>
#include <charconv>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "app/beginning.h"
#include "app/checkpoints.h"
#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/report.h"
#include "app/resume.h"
#include "app/run_journal.h"
#include "app/run_record.h"
#include "app/run_to_end.h"
#include "app/visibility.h"
#include "app/written_states.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "kernel/scene/model_scene.h"

namespace voxmelt::app {
namespace {

struct RunOptions {
  Common common;
  std::optional<std::string> steps;
  std::optional<std::uint32_t> frame_every;
  std::string out;
  std::optional<std::string> size;
  std::string setting = "normal";
  std::optional<int> fps;
  std::optional<std::string> film;
  std::optional<std::string> checkpoint_every, wall_clock;
  std::string write;  // names of formats, separated by commas
  std::string surface;
  std::optional<std::uint32_t> write_every;
  std::string journal;  // file; empty for none
  std::string resume;   // folder; empty for a run from the scene's beginning
  bool go_on = false;   // --continue
  std::optional<std::string> keep;
  std::set<std::string> given;  // given options, among those that a resumed run may change
};

// Reads "3h55m", "90s", "45m" or "2h": hours, minutes and seconds, each once at most. Throws UsageError.
std::chrono::seconds duration_of(const std::string& text) {
  const auto wrong = [&] {
    return UsageError(fmt::format("--wall-clock {}: error: want a time, as in 3h55m, 45m or 90s", text));
  };
  constexpr std::string_view kUnits = "hms";
  constexpr std::array kSeconds{3600, 60, 1};
  std::chrono::seconds sum{0};
  std::size_t next = 0;  // unit that may come
  for (std::string_view left = text; !left.empty();) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(left.data(), left.data() + left.size(), number);
    const bool named = error == std::errc() && end != left.data() + left.size() && number <= 10'000'000;
    const std::size_t unit = named ? kUnits.find(*end, next) : std::string_view::npos;
    if (unit == std::string_view::npos) throw wrong();
    sum += std::chrono::seconds(std::int64_t{number} * kSeconds[unit]);
    next = unit + 1;
    left.remove_prefix(end + 1 - left.data());
  }
  if (sum.count() == 0) throw wrong();
  return sum;
}

// Reads "2000", or "+2000" for further steps. Throws UsageError.
StepsWanted steps_wanted(const std::string& text) {
  StepsWanted steps{.further = text.starts_with('+')};
  const char *begin = text.data() + (steps.further ? 1 : 0), *end = text.data() + text.size();
  const auto [last, error] = std::from_chars(begin, end, steps.count);
  if (begin == end || last != end || error != std::errc())
    throw UsageError(
        fmt::format("--steps {}: error: want a number of steps up to {}, or +N for further ones of --resume",
                    text, UINT32_MAX));
  return steps;
}

std::string by_chance() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

// Writes the scene that was assumed of a model, to be changed. One that was changed is not replaced.
void write_assumed_scene(const scene::Scene& scene, const io::OutputFolder& out) {
  if (scene.assumed_text.empty()) return;
  const std::filesystem::path old = out.place() / "scene.toml";
  std::ifstream stream(old, std::ios::binary);
  const std::string text{std::istreambuf_iterator(stream), {}};
  if (stream && text != scene.assumed_text)
    throw UsageError(
        fmt::format("{}: error: it is another one than is assumed of {}; run it, or take it away",
                    seen_from_here(old), scene.file.string()));
  io::write_file(out.partial() / "scene.toml", scene.assumed_text);
}

// Models that differ in their formats alone have places of their own.
std::string place_of(const RunOptions& options) {
  if (!options.out.empty()) return options.out;
  const std::filesystem::path scene = find_scene(options.common.scene);
  return "out/" + (scene::is_model_file(scene) ? scene.filename() : scene.stem()).string();
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
  const StepsWanted steps = options.steps ? steps_wanted(*options.steps) : StepsWanted{scene.steps};
  if (steps.further)
    throw UsageError(fmt::format(
        "--steps {}: error: +N means steps further than the run of --resume has made", *options.steps));
  record.steps = steps.count;
  check_steps(scene, record.steps);
  record.frame_every = options.frame_every.value_or(scene.frame_every);
  record.size = options.size.value_or("");
  if (options.size) set_size(scene.camera, *options.size);
  record.setting = options.setting;
  record.checkpoint_every = options.checkpoint_every.value_or("");
  record.frames_per_second = options.fps.value_or(record.frames_per_second);
  if (options.film) record.film = film_named(*options.film);
  record.write = formats_named(options.write);
  record.write_every = options.write_every.value_or(record.frame_every);
  record.surface = surface_named(options.surface, record.write);
  if (options.write_every && record.write.empty())
    throw UsageError(
        fmt::format("--write-every {}: error: --write says what is written", *options.write_every));
  record.id = by_chance();
  record.journal = journal_text(options.journal);
  record.journal_name = options.journal;
  record.left_out = left_out_of(options.keep);
  const std::string place = place_of(options);
  if (!options.journal.empty()) scene.files.emplace_back(options.journal);
  keep_inputs(scene, {{"--out", place}, {"--report", common.report}});
  check_report_place(common, place);
  catch_interrupts();  // from the folder on they end the run early, and what was made until then is kept
  run.out = std::make_unique<io::OutputFolder>(place);
  write_assumed_scene(scene, *run.out);
  return run;
}

// Returns nothing if the run is complete already.
std::optional<PreparedRun> prepare_to_resume(const RunOptions& options) {
  std::optional<StepsWanted> steps;
  if (options.steps) steps = steps_wanted(*options.steps);
  std::optional<Resumption> found = find_run(options.resume, steps);
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
  if (options.film) record.film = film_named(*options.film);
  find_implementation(common);
  check_report_place(common, found->place.string());
  if (!found->note.empty()) say("warning: " + found->note);
  return run;
}

// Begins the run of --out, or goes on with it. A run that was told something else is not gone on with.
std::optional<PreparedRun> prepare_to_continue(RunOptions options) {
  options.resume = place_of(options);
  const auto check = [&](const std::vector<std::string>& sets, std::optional<std::uint64_t> seed) {
    if (sets != options.common.sets || (options.common.seed && seed != options.common.seed))
      throw UsageError(
          fmt::format("--continue: error: {} holds a run with another --set or --seed", options.resume));
  };
  if (const std::optional<Told> told = told_to(options.resume)) {
    check(told->sets, told->seed);
    if (options.steps && steps_wanted(*options.steps).count <= told->steps) options.steps.reset();
  } else if (checkpoints_left(options.resume).empty()) {
    return prepare(options);
  }
  std::optional<PreparedRun> run = prepare_to_resume(options);
  if (run) check(run->record.common.sets, run->record.common.seed);
  return run;
}

int run_scene(RunOptions options) {
  const auto start = std::chrono::steady_clock::now();
  if (options.resume.empty() && options.common.scene.empty())
    throw UsageError("error: a scene, or --resume FOLDER, is required; --help says more");
  if (options.checkpoint_every && !interval_of(*options.checkpoint_every))
    throw UsageError("--checkpoint-every: error: want a number of steps, or of seconds as in 60s");
  std::optional<std::chrono::seconds> wall_clock;
  if (options.wall_clock) wall_clock = duration_of(*options.wall_clock);
  if (options.go_on && options.steps && steps_wanted(*options.steps).further)
    throw UsageError(fmt::format("--steps {}: error: --continue wants steps in all", *options.steps));
  std::optional<PreparedRun> run;
  if (options.go_on) {
    run = prepare_to_continue(options);
    options.resume = place_of(options);
  } else {
    run = options.resume.empty() ? prepare(options) : prepare_to_resume(options);
  }
  if (run) run->wall_clock = wall_clock;
  if (run) return run_to_end(std::move(*run), start);
  if (!options.common.quiet) print("the run in {} is complete; --steps +N goes on\n", options.resume);
  return kDone;
}

}  // namespace

void add_run(CommandLine& program) {
  auto options = std::make_shared<RunOptions>();
  const Command command =
      program.add("run", "Melt a scene: frames (PNG), contact sheet, film (MP4 or WebP) and report.json");
  add_scene(command, options->common);
  const Option scene = command.find("scene").required(false).described_as(
      "scene file (TOML), a name of `voxmelt list scenes`, or a model; --resume goes on from a checkpoint");
  const Option resume = command.option(
      "--resume", options->resume,
      "go on with the run of this folder: interrupted, killed, out of room, or with more --steps");
  resume.excludes(scene);
  const auto begins = [&](Option option) { option.excludes(resume); };
  begins(command.flag("--continue", options->go_on,
                      "go on with the run that is in --out, if one is, and do nothing if it is complete"));
  command.option("--steps", options->steps,
                 "steps to run (default: the scene's); with --resume in all, or +N more");
  begins(command.option("--frame-every", options->frame_every, "steps between frames; 0: the first only"));
  begins(command.option("--out", options->out, "folder to write (default: out/SCENE)"));
  begins(command.option("--size", options->size, "size of a frame in pixels, e.g. 640x480"));
  begins(add_setting(command, options->setting, "of a frame, "));
  command.option("--fps", options->fps, "frames of the film in a second (default: 12)")
      .within(1, kMostFramesPerSecond);
  command
      .option(
          "--film", options->film,
          "mp4 by ffmpeg, webp or webp-lossless; auto is mp4, and webp where ffmpeg fails (default: auto)")
      .one_of({render::kFilmNames.begin(), render::kFilmNames.end()});
  command.option("--checkpoint-every", options->checkpoint_every,
                 "write a checkpoint after every N steps, or every N seconds (60s)");
  begins(command.option(
      "--write", options->write,
      "write states, too, in these formats: " + format_list() + "; more than one as in csv,npz"));
  begins(add_surface(command, options->surface));
  begins(command.option("--write-every", options->write_every,
                        "steps between states (default: between frames); 0: the first and the last only"));
  command.option("--wall-clock", options->wall_clock,
                 "end after this time (3h55m, 90s) as at a signal: with a checkpoint, and exit code 4");
  begins(command.option("--keep", options->keep,
                        "of frames, sheet, film, state those that a complete run keeps beside its report; "
                        "as in sheet,film (default: all)"));
  begins(add_journal(command, options->journal));
  add_common(command, options->common);
  add_visibility(command, options->common);
  for (const char* option : {"--seed", "--set"}) begins(command.find(option));
  command.runs([options, command] {
    options->given = command.given();
    return run_scene(*options);
  });
}

}  // namespace voxmelt::app
