#include "app/runs/sweep_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "app/message.h"
#include "app/options.h"
#include "app/report.h"
#include "kernel/run/checkpoint/checkpoint.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;
using json = nlohmann::ordered_json;

constexpr const char* kHead = "sweep.json";
constexpr std::chrono::milliseconds kPatience{2000}, kBetweenAttempts{20};

std::string text_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator(stream), {}};
}

// Returns the words of [keep], as options of `voxmelt run`.
std::vector<std::string> words_of(const Keep& keep) {
  std::vector<std::string> words;
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  const auto number = [](const std::optional<std::int64_t>& value) {
    return value ? std::to_string(*value) : std::string();
  };
  add("--steps", number(keep.steps));
  add("--frame-every", number(keep.frame_every));
  add("--size", keep.size);
  add("--setting", keep.setting);
  add("--write", keep.write);
  add("--write-every", number(keep.write_every));
  add("--keep", keep.kept);
  return words;
}

}  // namespace

SweepFolder::SweepFolder(fs::path place, const Plan& plan)
    : place_(std::move(place)), plan_(plan), scene_name_(fs::path(plan.scene).stem().string() + ".toml") {}

std::string SweepFolder::head_text(const scene::Scene& scene) const {
  json files = json::array();
  for (const fs::path& file : scene.files) {
    if (file == scene.file) continue;  // its text stands in the folder
    const checkpoint::FileState state = checkpoint::state_of(file, file.filename().string());
    files.push_back({{"file", state.name}, {"bytes", state.bytes}, {"xxh3", state.digest}});
  }
  const json head{
      {"sweep", 1}, {"scene", scene_name_}, {"options", app::words_of(plan_.keep)}, {"files", files}};
  return head.dump(2) + "\n";
}

bool SweepFolder::has_room(const scene::Scene& scene) const {
  std::error_code none;
  if (!fs::is_directory(place_, none)) return false;
  return std::ranges::all_of(fs::directory_iterator(place_, none), [&](const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    if (name == scene_name_) return text_in(entry.path()) == scene.text;
    return name.starts_with(scene_name_ + ".partial-") || name.starts_with(std::string(kHead) + ".partial-");
  });
}

void SweepFolder::expand(const scene::Scene& scene) {
  const std::string shown = seen_from_here(place_), head = head_text(scene);
  std::error_code ignored;
  if (fs::exists(place_ / kHead, ignored)) {
    if (text_in(place_ / kHead) != head || text_in(place_ / scene_name_) != scene.text)
      throw UsageError(
          fmt::format("{}: error: it holds runs of another scene, or with another [keep]; --out says "
                      "where these go",
                      shown));
  } else {
    if (fs::exists(place_, ignored) && !has_room(scene))
      throw UsageError(fmt::format("{}: error: is there already, and no sweep; --out says another", shown));
    io::make_folder(place_);
    io::write_file(place_ / scene_name_, scene.text);
    io::write_file(place_ / kHead, head);
  }
  for (const char* name : {"runs", "logs"}) io::make_folder(place_ / name);
}

void SweepFolder::check_expanded() const {
  std::error_code ignored;
  if (!fs::exists(place_ / kHead, ignored))
    throw UsageError(fmt::format("{}: error: there is no sweep to gather", seen_from_here(place_)));
}

void SweepFolder::lock() {
  // A sweep that was killed just now may have a child that holds the lock until its own program begins.
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while ((lock_ = io::FileLock::attempt(place_)).held_by_another() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(kBetweenAttempts);
  if (lock_.held_by_another())
    throw UsageError(fmt::format("{}: error: another sweep is at work there; --gather looks at what it has",
                                 seen_from_here(place_)));
}

std::vector<std::string> SweepFolder::words_of(const PlannedRun& run,
                                               const std::vector<std::string>& more) const {
  std::vector<std::string> words{"run", scene_name_};
  for (std::size_t i = 0; i < plan_.axes.size(); ++i)
    words.insert(words.end(), {"--set", set_of(plan_.axes[i], run.values[i])});
  const std::vector<std::string> kept = app::words_of(plan_.keep);
  words.insert(words.end(), kept.begin(), kept.end());
  words.insert(words.end(), {"--checkpoint-every", plan_.keep.checkpoint_every});
  words.insert(words.end(), more.begin(), more.end());
  words.insert(words.end(), {"--out", "runs/" + run.name, "--continue", "--quiet"});
  return words;
}

bool SweepFolder::is_complete(const PlannedRun& run) const { return says_complete(run_place(run)); }

bool SweepFolder::is_at_work(const PlannedRun& run) const {
  return std::ranges::any_of(io::leavings_of(run_place(run)), [](const fs::path& left) {
    return io::FileLock::attempt(left).held_by_another();
  });
}

fs::path voxmelt_program() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path() / "voxmelt";
  if (!fs::exists(program, error))
    throw UsageError(fmt::format("error: {} is not there; it makes the runs", program.string()));
  return program;
}

}  // namespace voxmelt::app
