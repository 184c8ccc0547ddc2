#include "app/checkpoints.h"

#include <fmt/format.h>

#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>

#include "app/version.h"
#include "kernel/run/io/checkpoint_files.h"
#include "kernel/run/io/file_lock.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"

namespace voxmelt::app {

std::optional<Interval> interval_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  std::string_view number = text;
  const bool seconds = number.ends_with('s');
  if (seconds) number.remove_suffix(1);
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || value == 0)
    throw UsageError(fmt::format(
        "--checkpoint-every {}: error: want a number of steps from 1 on, or of seconds as in 60s", text));
  return seconds ? Interval{0, static_cast<double>(value)} : Interval{value, 0};
}

Checkpoints::Checkpoints(std::filesystem::path folder, const scene::Scene& scene, checkpoint::SceneText text,
                         int threads)
    : folder_(std::move(folder)), scene_(scene), text_(std::move(text)), threads_(threads) {}

void Checkpoints::change_settings(std::string settings, state::Grid grid) {
  std::vector<checkpoint::FileState> files = std::move(text_.files);
  text_ = run::scene_text(scene_, grid);
  text_.files = std::move(files);
  text_.settings = std::move(settings);
}

bool Checkpoints::due(const std::optional<Interval>& interval, std::uint32_t steps_done) const {
  if (!interval) return false;
  if (interval->steps > 0) return steps_done % interval->steps == 0;
  return std::chrono::duration<double>(Clock::now() - last_).count() >= interval->seconds;
}

bool Checkpoints::write(RunRecord record, Film& film, const run::Simulation& simulation,
                        const Watch::Seen& seen, const RunSeconds& seconds) {
  record.frame_steps = film.settle();
  const Clock::time_point begin = Clock::now();
  if (record.frame_steps.size() < frames_due_before(record, simulation.steps_done())) return false;
  std::error_code error;
  std::filesystem::create_directories(folder_ / "checkpoints", error);
  if (error)
    throw io::OutputError(
        fmt::format("{}: error: cannot be made: {}", (folder_ / "checkpoints").string(), error.message()),
        error == std::errc::no_space_on_device);
  write_to(io::checkpoint_place(folder_, simulation.steps_done()), std::move(record), simulation, seen,
           seconds);
  io::keep_two_checkpoints(folder_);
  last_ = Clock::now();
  cost_ = last_ - begin;
  return true;
}

void Checkpoints::write_last(RunRecord record, Film& film, const run::Simulation& simulation,
                             const Watch::Seen& seen, const RunSeconds& seconds) {
  record.frame_steps = film.settle();
  write_to(folder_ / io::kLastState, std::move(record), simulation, seen, seconds);
}

void Checkpoints::write_to(const std::filesystem::path& file, RunRecord record,
                           const run::Simulation& simulation, const Watch::Seen& seen,
                           const RunSeconds& seconds) {
  const std::filesystem::path frames = folder_ / "frames";
  bool more = false;
  for (std::size_t i = frames_.size(); i < record.frame_steps.size(); ++i, more = true) {
    const std::string name = render::Frames::file_name(i);
    io::flush_file(frames / name);
    frames_.push_back(checkpoint::state_of(frames / name, name));
  }
  if (more) io::flush_entry(frames / "any");
  record.frames = frames_;
  record.seen = seen;
  record.seconds = seconds;
  checkpoint::Head head = run::head_of(version_number(), text_, scene_, simulation);
  head.command = json_of(record);
  checkpoint::write(file, std::move(head), simulation.volume(), simulation.irradiance(), threads_);
}

}  // namespace voxmelt::app
