#include "kernel/run/io/output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "kernel/run/io/checkpoint_files.h"
#include "kernel/run/io/exchange.h"

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kReserve = ".voxmelt-reserve";  // room for report and marker when the disk is full
constexpr std::size_t kReserved = std::size_t{256} << 10;

[[noreturn]] void refuse(const fs::path& place, const std::string& why) {
  throw OutputError(place.string() + ": error: " + why, false);
}

// Lists the files of a folder, as paths within it. commit() writes them into the marker, one per line.
std::set<std::string> files_within(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory() || entry.is_symlink())
      files.insert(entry.path().lexically_relative(folder).string());
  return files;
}

// Tells if a desktop made the file. Desktops put such files into every folder that somebody looks at.
bool made_by_desktops(const std::string& name) {
  return name == ".DS_Store" || name == "Thumbs.db" || name == "desktop.ini" || name == ".directory";
}

// Refuses a folder with foreign files. An old output is replaced whole, so it must hold nothing that voxmelt
// did not write.
void check_replaceable(const fs::path& place) {
  std::error_code error;
  if (!fs::exists(place, error)) {
    if (fs::is_symlink(place, error)) refuse(place, "is a link to nowhere");
    return;
  }
  if (!fs::is_directory(place, error)) refuse(place, "is a file, not a folder to write into");
  const fs::path here = fs::current_path(error), inside = here.lexically_relative(place);
  if (!inside.empty() && *inside.begin() != "..")
    refuse(place, "is the current folder or one above it; choose a folder inside");
  std::ifstream marker(place / kMarker);
  std::set<std::string> written{kMarker};
  for (const CheckpointFile& one : marker ? checkpoints_in(place) : std::vector<CheckpointFile>{})
    written.insert(one.file.lexically_relative(place).string());
  for (std::string line; std::getline(marker, line);) written.insert(line);
  for (const std::string& file : files_within(place))
    if (!is_beside_contents(place, fs::path(file).begin()->string()) && !written.contains(file) &&
        !made_by_desktops(fs::path(file).filename().string()))
      refuse(place, "holds '" + file + "', which voxmelt did not write; choose another folder");
}

mode_t with_umask(mode_t mode) {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return mode & ~mask;
}

// Keeps room for a report. If the room cannot be had, nothing is lost, but a full disk then leaves no report.
void reserve(const fs::path& folder) {
  std::FILE* file = std::fopen((folder / kReserve).c_str(), "wb");
  if (file == nullptr) return;
  const std::string bytes(kReserved, '\1');
  (void)std::fwrite(bytes.data(), 1, bytes.size(), file);
  (void)std::fclose(file);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& place, bool goes_on)
    : place_(fs::weakly_canonical(fs::absolute(place))) {
  if (!place_.has_filename()) place_ = place_.parent_path();
  check_replaceable(place_);

  // A fresh folder is made beside the place, and the folders above it that are missing.
  std::error_code error;
  for (fs::path above = place_.parent_path(); !fs::exists(above, error); above = above.parent_path())
    first_new_ = above;
  fs::create_directories(place_.parent_path(), error);
  const auto refuse_to_create = [&](int why) {
    partial_ = place_;
    remove_new_folders();
    fail_output(place_, "cannot create the output folder", why);
  };
  if (error) refuse_to_create(error.value());
  const FileLock above = FileLock::wait(place_.parent_path());
  if (clear_leavings(place_, true))
    refuse(place_, "another run is writing there; wait for it, or choose another");
  if (!goes_on) {
    if (holds_work(place_))
      refuse(place_, "holds a run that was stopped, with a checkpoint of step " +
                         std::to_string(checkpoints_in(place_).front().step) + "; `voxmelt run --resume " +
                         place.string() + "` goes on with it, and who removes its checkpoints begins anew");
    for (const fs::path& left : leavings_of(place_))
      if (holds_work(left))
        refuse(place_, "a run that died left a checkpoint of step " +
                           std::to_string(checkpoints_in(left).front().step) + " in " +
                           left.filename().string() + "; `voxmelt run --resume " + place.string() +
                           "` goes on with it, and who removes it begins anew");
    clear_leavings(place_);
  }
  const auto held = changing_places();
  within_ = must_stay(place_);
  std::string partial =
      within_ ? (place_ / (std::string(kPartialWithin) + "XXXXXX")).string() : beside(place_);
  if (::mkdtemp(partial.data()) == nullptr) refuse_to_create(errno);
  partial_ = partial;
  unfinished_.begin([this] { discard(); });
  lock_ = FileLock::attempt(partial_);
  ::chmod(partial.c_str(), with_umask(0777));
  reserve(partial_);
}

OutputFolder::~OutputFolder() {
  const auto held = changing_places();
  discard();
}

void OutputFolder::discard() {
  if (settled_ || holds_work(partial_)) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  remove_new_folders();
}

// Removes folders that were made in vain. fs::remove leaves those that are not empty.
void OutputFolder::remove_new_folders() {
  std::error_code ignored;
  for (fs::path folder = partial_; !first_new_.empty() && folder != first_new_;) {
    folder = folder.parent_path();
    fs::remove(folder, ignored);
  }
}

bool is_unfinished(const fs::path& partial) {
  std::error_code ignored;
  return fs::exists(partial / kReserve, ignored);
}

void OutputFolder::release_reserve() {
  std::error_code ignored;
  fs::remove(partial_ / kReserve, ignored);
}

void OutputFolder::move_to(const fs::path& place) {
  release_reserve();
  check_replaceable(place);  // once more: somebody may have put a file there meanwhile
  std::string files;         // checkpoints are known by their names: they go when the run is complete
  for (const std::string& file : files_within(partial_))
    if (!file.starts_with("checkpoints/")) files += file + "\n";
  write_file(partial_ / kMarker, files);
  flush_folder(partial_);

  auto held = changing_places();
  const int why = exchange(partial_, place);
  if (why != 0) fail_output(place, "cannot move the finished folder into place", why);
  settled_ = true;
  unfinished_.complete();
  held.unlock();
  flush_entry(place);
  std::error_code ignored;
  if (fs::exists(partial_, ignored)) remove_output(partial_);  // the former contents
}

void OutputFolder::commit() { move_to(place_); }

fs::path incomplete_place(const fs::path& place, bool within) {
  return within ? place / kIncompleteWithin : fs::path(place.string() + ".incomplete");
}

fs::path OutputFolder::keep_incomplete() {
  const fs::path place = incomplete_place(place_, within_);
  try {
    move_to(place);
    return place;
  } catch (const OutputError&) {
  } catch (const fs::filesystem_error&) {
  }
  // It cannot be moved, or its marker has no room. It stays where it is.
  const auto held = changing_places();
  settled_ = true;
  unfinished_.complete();
  return partial_;
}

}  // namespace voxmelt::io
