// Says that a process is alive and at work on a file or folder: what is not locked was left behind by a dead
// one.
#pragma once

#include <filesystem>
#include <utility>
#include <vector>

namespace voxmelt::io {

// A lock goes with its process, however that ends (flock(2)). It locks no reader or writer out.
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

  // Of a file or folder that exists; waits for another holder, or gives up at once. Where the file system has
  // no such locks, nobody holds one.
  static FileLock wait(const std::filesystem::path& path);
  static FileLock attempt(const std::filesystem::path& path);
  explicit operator bool() const { return descriptor_ >= 0; }
  bool held_by_another() const { return held_by_another_; }

 private:
  int descriptor_ = -1;
  bool held_by_another_ = false;
};

// "<place>.partial-*", whoever made them.
std::vector<std::filesystem::path> leavings_of(const std::filesystem::path& place);

// Removes those of processes that are no more, or only those without checkpoints (checkpoint_files.h). Tells
// whether a living one is at work on `place`. Nothing new of this kind may come to be meanwhile: hold a lock
// of the folder above.
bool clear_leavings(const std::filesystem::path& place, bool keep_checkpoints = false);

// One file is on the disk when this returns. Throws OutputError, as those below.
void flush_file(const std::filesystem::path& file);
// Everything in the folder is on the disk when this returns. Throws OutputError.
void flush_folder(const std::filesystem::path& folder);
// The entry of a file or folder in the folder above it is on the disk.
void flush_entry(const std::filesystem::path& path);

}  // namespace voxmelt::io
