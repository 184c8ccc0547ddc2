#include "kernel/run/io/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "kernel/run/io/checkpoint_files.h"
#include "kernel/run/io/declined.h"
#include "kernel/run/io/exchange.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

// A process holds this lock for moments. One that was stopped does not stop others.
constexpr int kMostWaits = 500;
constexpr std::chrono::milliseconds kBetweenWaits{10};

int open_to_lock(const fs::path& path) { return ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK); }

// Throws only if bytes may be lost. A folder that cannot be opened or flushed is as good without.
void flush(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0 && errno == ELOOP) return;  // a link: its entry is flushed with its folder
  const bool done = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int why = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!done && !is_declined(why))
    throw OutputError(path.string() + ": error: cannot flush: " + std::strerror(why),
                      why == ENOSPC || why == EDQUOT);
}

}  // namespace

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FileLock FileLock::wait(const fs::path& path) {
  FileLock lock;
  lock.descriptor_ = open_to_lock(path);
  for (int i = 0; lock && i < kMostWaits && ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0; ++i) {
    if (errno != EINTR && errno != EWOULDBLOCK) break;
    std::this_thread::sleep_for(kBetweenWaits);
  }
  return lock;
}

FileLock FileLock::attempt(const fs::path& path) {
  FileLock lock;
  lock.descriptor_ = open_to_lock(path);
  if (!lock || ::flock(lock.descriptor_, LOCK_EX | LOCK_NB) == 0) return lock;
  FileLock none;
  none.held_by_another_ = errno == EWOULDBLOCK;
  return none;
}

std::vector<fs::path> leavings_of(const fs::path& place) {
  const std::string begin = place.filename().string() + ".partial-";
  std::error_code ignored;
  std::vector<fs::path> leavings;
  for (const auto& entry : fs::directory_iterator(place.parent_path(), ignored))
    if (entry.path().filename().string().starts_with(begin) && !fs::is_symlink(entry.path(), ignored))
      leavings.push_back(entry.path());
  if (!fs::is_directory(place, ignored)) return leavings;
  for (const auto& entry : fs::directory_iterator(place, ignored))
    if (entry.path().filename().string().starts_with(kPartialWithin)) leavings.push_back(entry.path());
  return leavings;
}

bool clear_leavings(const fs::path& place, bool keep_checkpoints) {
  bool alive = false;
  for (const fs::path& left : leavings_of(place)) {
    const FileLock lock = FileLock::attempt(left);
    if (lock && is_half_moved(left) && move_entries(left, place) != 0) continue;
    if (lock && !(keep_checkpoints && !checkpoints_in(left).empty())) remove_output(left);
    alive = alive || lock.held_by_another();
  }
  return alive;
}

void flush_file(const fs::path& file) { flush(file); }

void flush_folder(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_directory() || entry.is_regular_file()) flush(entry.path());
  flush(folder);
}

void flush_entry(const fs::path& path) { flush(path.has_parent_path() ? path.parent_path() : fs::path(".")); }

}  // namespace voxmelt::io
