#include "app/resume.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <system_error>
#include <utility>
#include <vector>

#include "app/interrupt.h"
#include "app/link_or_copy.h"
#include "app/message.h"
#include "app/written_states.h"
#include "kernel/run/checkpoint/blocks.h"
#include "kernel/run/io/checkpoint_files.h"
#include "kernel/run/io/exchange.h"
#include "kernel/run/io/file_lock.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIncomplete = ".incomplete";
constexpr std::size_t kRandom = 6;  // letters that mkdtemp chooses

// Returns the output's place, even if a folder beside it was given.
fs::path place_named(const fs::path& given) {
  fs::path place = fs::weakly_canonical(fs::absolute(given));
  if (!place.has_filename()) place = place.parent_path();
  std::string name = place.filename().string();
  const std::string within = io::kPartialWithin;
  if (name.starts_with(within) && name.size() == within.size() + kRandom) return place.parent_path();
  if (io::is_beside_contents(place.parent_path(), name)) return place.parent_path();
  const std::size_t partial = name.rfind(".partial-");
  if (name.ends_with(kIncomplete))
    name.resize(name.size() - std::string(kIncomplete).size());
  else if (partial != std::string::npos && partial + 9 + kRandom == name.size())
    name.resize(partial);
  return place.parent_path() / name;
}

struct Candidate {
  fs::path folder, file;
  std::uint32_t step = 0;
};

// A process may have died while it moved a finished output to its place.
void complete_moves(const fs::path& place) {
  for (const fs::path& left : io::leavings_of(place)) {
    const io::FileLock lock = io::FileLock::attempt(left);
    if (lock && io::is_half_moved(left) && io::move_entries(left, place) == 0) io::remove_output(left);
  }
}

// Lists checkpoints, the newest of a folder first. The folder that was last written to comes first. A
// complete output needs no more work, so its checkpoints do not count.
std::vector<Candidate> candidates_of(const fs::path& place) {
  std::vector<fs::path> folders = io::leavings_of(place);
  for (const bool within : {false, true}) folders.push_back(io::incomplete_place(place, within));
  if (!says_complete(place)) folders.push_back(place);
  struct Series {
    fs::file_time_type last;
    std::vector<Candidate> candidates;
  };
  std::vector<Series> all;
  for (const fs::path& folder : folders) {
    Series series{fs::file_time_type::min(), {}};
    for (const io::CheckpointFile& one : io::checkpoints_in(folder)) {
      std::error_code ignored;
      series.last = std::max(series.last, fs::last_write_time(one.file, ignored));
      series.candidates.push_back({folder, one.file, one.step});
    }
    all.push_back(std::move(series));
  }
  std::ranges::stable_sort(all, std::greater(), &Series::last);
  std::vector<Candidate> found;
  for (const Series& series : all)
    found.insert(found.end(), series.candidates.begin(), series.candidates.end());
  return found;
}

// Returns ", OUTPUT" for a checkpoint that lies in the folder where runs write it, else nothing.
std::string outputs_folder(const fs::path& file) {
  const fs::path folder = fs::absolute(file).lexically_normal().parent_path();
  if (file.extension() != ".vxc" || folder.filename() != "checkpoints") return {};
  return ", " + seen_from_here(place_named(folder.parent_path()));
}

// Tells if another run is at work in the folder.
bool is_alive(const fs::path& folder) { return io::FileLock::attempt(folder).held_by_another(); }

// Checks that the frames are those that the checkpoint names.
void check_frames(const Candidate& candidate, const RunRecord& record) {
  for (const checkpoint::FileState& frame : record.frames)
    if (fs::path(frame.name).has_parent_path() ||
        checkpoint::state_of(candidate.folder / "frames" / frame.name, frame.name) != frame)
      checkpoint::fail(candidate.folder / "frames" / frame.name,
                       fmt::format("is not the frame that {} names", candidate.file.filename().string()));
}

Resumption load(const Candidate& candidate) {
  checkpoint::Checkpoint checkpoint = checkpoint::read(candidate.file);
  Resumption run;
  run.record = run_record_of(checkpoint.head.command, candidate.file);
  run.text = checkpoint.head.scene;
  const std::uint32_t done = checkpoint.head.run.steps_done;
  const std::size_t before = frames_due_before(run.record, done);
  const std::size_t now = before + (frame_is_due(run.record, done) ? 1 : 0);
  if (done != candidate.step || done > run.record.steps || run.record.frames.size() < before ||
      run.record.frames.size() > now)
    checkpoint::fail(candidate.file, "its head: the steps done are not those of its name and its frames");
  check_frames(candidate, run.record);
  run.scene = run::scene_of(std::move(checkpoint), candidate.file);
  return run;
}

// A complete run has its last state beside its frames.
std::vector<Candidate> last_state_of(const fs::path& place, const std::string& shown) {
  const fs::path file = place / io::kLastState;
  std::error_code ignored;
  if (!fs::is_regular_file(file, ignored))
    throw UsageError(
        fmt::format("--resume {}: error: the run is complete, and its last state is not there", shown));
  return {{place, file, checkpoint::read_head(file).run.steps_done}};
}

// Gives the run another last step. The frame of its former last step stays if it is due without being the
// last.
void go_on(Resumption& run, const StepsWanted& steps) {
  const std::uint32_t done = run.scene.mid_run->steps_done;
  const std::uint64_t last = (steps.further ? std::uint64_t{done} : 0) + steps.count;
  if (last < done)
    throw UsageError(fmt::format(
        "--steps {}: error: step {} of this run is done already; +N means further ones", steps.count, done));
  if (last > UINT32_MAX - run.scene.first_step)
    throw UsageError(fmt::format("--steps +{}: error: step numbers end at {}", steps.count, UINT32_MAX));
  run.record.steps = static_cast<std::uint32_t>(last);
  std::vector<std::uint32_t>& frames = run.record.frame_steps;
  if (!frames.empty() && !frame_is_due(run.record, frames.back())) {
    frames.pop_back();
    run.record.frames.pop_back();
  }
}

// Takes over frames and then checkpoints: a folder that has checkpoints has their frames. Files are replaced
// whole, never changed, so that two folders can share them.
void take_over(const Candidate& from, const RunRecord& record, const fs::path& folder) {
  fs::create_directories(folder / "frames");
  for (const checkpoint::FileState& frame : record.frames)
    link_or_copy(from.folder / "frames" / frame.name, folder / "frames" / frame.name);
  io::flush_folder(folder);
  take_over_written(from.folder, folder, record, from.step);
  std::error_code ignored;
  if (const fs::path scene = from.folder / "scene.toml"; fs::exists(scene, ignored))
    link_or_copy(scene, folder / scene.filename());  // of a model
  fs::create_directories(folder / "checkpoints");
  for (const io::CheckpointFile& one : io::checkpoints_in(from.folder))
    if (one.step <= from.step) link_or_copy(one.file, folder / "checkpoints" / one.file.filename());
  io::flush_folder(folder);
}

// Tells if a checkpoint is known to be of this run.
bool is_of(const fs::path& file, const std::string& id) {
  try {
    return run_record_of(checkpoint::read_head(file).command, file).id == id;
  } catch (const checkpoint::Error&) {
    return false;
  }
}

// Lists input files that have changed since the run began. The run does not read them again.
std::string changed_files(const checkpoint::SceneText& text) {
  std::string changed;
  for (const checkpoint::FileState& file : text.files) {
    std::error_code ignored;
    const bool same =
        fs::is_regular_file(file.name, ignored) && checkpoint::state_of(file.name, file.name) == file;
    if (!same) changed += (changed.empty() ? "" : ", ") + file.name;
  }
  if (changed.empty()) return {};
  return changed + (changed.find(", ") == std::string::npos ? " is" : " are") +
         " no longer what this run has read; it goes on as it began";
}

}  // namespace

std::vector<fs::path> checkpoints_left(const fs::path& given) {
  std::vector<fs::path> files;
  std::error_code impossible;  // as a name, because it is too long
  (void)fs::status(given, impossible);
  if (impossible && impossible != std::errc::no_such_file_or_directory) return files;
  for (const Candidate& candidate : candidates_of(place_named(given))) files.push_back(candidate.file);
  return files;
}

std::optional<Resumption> find_run(const fs::path& given, const std::optional<StepsWanted>& steps) {
  const fs::path place = place_named(given);
  const std::string shown = given.string();
  std::error_code ignored;
  if (fs::is_regular_file(given, ignored))
    throw UsageError(fmt::format("--resume {}: error: is a file; give the folder of the run's output{}",
                                 shown, outputs_folder(given)));
  complete_moves(place);
  std::vector<Candidate> candidates = candidates_of(place);
  if (steps && candidates.empty() && says_complete(place)) candidates = last_state_of(place, shown);
  const std::vector<fs::path> leavings = io::leavings_of(place);
  if (std::ranges::any_of(leavings, is_alive))
    throw UsageError(fmt::format("--resume {}: error: a run is at work there", shown));
  if (candidates.empty() && says_complete(place) && std::ranges::none_of(leavings, io::is_unfinished)) {
    // The run may have died just before it cleared up.
    fs::remove_all(place / "checkpoints", ignored);
    io::clear_leavings(place);
    return std::nullopt;
  }
  if (candidates.empty())
    throw UsageError(fmt::format(
        "--resume {}: error: there is no checkpoint in it, nor in {}.partial-* or {}.incomplete beside it",
        shown, place.filename().string(), place.filename().string()));

  std::string note;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    if (is_alive(candidate.folder))
      throw UsageError(fmt::format("--resume {}: error: a run is at work in {}", shown,
                                   candidate.folder.filename().string()));
    try {
      Resumption run = load(candidate);
      if (steps) go_on(run, *steps);
      if (note.empty()) note = changed_files(run.text);
      run.note = note;
      run.place = place;
      catch_interrupts();  // from the folder on they end the run early, with what is taken over
      run.folder = std::make_unique<io::OutputFolder>(place, true);
      take_over(candidate, run.record, run.folder->partial());
      for (const fs::path& left : io::leavings_of(place))  // all their files are taken over
        if (left != run.folder->partial() && !is_alive(left)) io::remove_output(left);
      return run;
    } catch (const checkpoint::Error& error) {
      if (i + 1 == candidates.size()) throw;
      if (note.empty()) note = std::string(error.what()) + "; an older checkpoint will do";
    }
  }
  return std::nullopt;  // not reached: the last one throws or returns
}

void clear_after(const fs::path& place, const std::string& id) {
  std::error_code ignored;
  fs::remove_all(place / "checkpoints", ignored);
  for (const bool within : {false, true}) {
    const fs::path incomplete = io::incomplete_place(place, within);
    const std::vector<io::CheckpointFile> kept = io::checkpoints_in(incomplete);
    if (std::ranges::none_of(kept, [&](const io::CheckpointFile& one) { return is_of(one.file, id); }))
      continue;
    // If the process dies after the rename, the next run removes the rest.
    const fs::path aside = within ? place / (std::string(io::kPartialWithin) + "remove")
                                  : fs::path(place.string() + ".partial-remove");
    io::remove_output(aside);
    fs::rename(incomplete, aside, ignored);
    io::remove_output(aside);
  }
}

}  // namespace voxmelt::app
