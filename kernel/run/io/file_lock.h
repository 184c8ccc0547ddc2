// A lock shows that a process is alive and at work on a file or folder. If something is not locked, a dead
// process left it behind.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace voxmelt::io {

// Goes with its process, however that ends (flock(2)). It locks no reader or writer out.
class FileLock {
 public:
  FileLock() = default;
  FileLock(FileLock&& other) noexcept
      : descriptor_(std::exchange(other.descriptor_, -1)), held_by_another_(other.held_by_another_) {}
  FileLock& operator=(FileLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(held_by_another_, other.held_by_another_);
    return *this;
  }
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  // These lock a file or folder that exists. `wait` waits for another holder, and `attempt` gives up at once.
  // If the file system has no such locks, nobody holds one.
  static FileLock wait(const std::filesystem::path& path);
  static FileLock attempt(const std::filesystem::path& path);
  explicit operator bool() const { return descriptor_ >= 0; }
  bool held_by_another() const { return held_by_another_; }

 private:
  int descriptor_ = -1;
  bool held_by_another_ = false;
};

// Lists "<place>.partial-*", whoever made them, and partial outputs within the place.
std::vector<std::filesystem::path> leavings_of(const std::filesystem::path& place);

// Removes the leavings of processes that have ended, or only those without checkpoints (checkpoint_files.h).
// Those that were moved to their place in part are moved on first (exchange.h).
// It returns true if a living process is at work on `place`. No new leavings may appear meanwhile, so hold a
// lock of the folder above.
bool clear_leavings(const std::filesystem::path& place, bool keep_checkpoints = false);

// Flushes one file to the disk before it returns. It throws OutputError, as do the functions below, unless
// the file system declines.
void flush_file(const std::filesystem::path& file);
// Flushes everything in the folder to the disk before it returns. It throws OutputError.
void flush_folder(const std::filesystem::path& folder);
// Flushes the entry of a file or folder in the folder above it.
void flush_entry(const std::filesystem::path& path);

}  // namespace voxmelt::io
