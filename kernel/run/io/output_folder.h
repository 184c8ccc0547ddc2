// Output that is never half-written: a folder is filled beside its final place, flushed, and exchanged with
// what stood there when it is complete.
#pragma once

#include <filesystem>

#include "kernel/run/io/file_lock.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/unfinished.h"

namespace voxmelt::io {

class OutputFolder {
 public:
  // Prepares a fresh "<place>.partial-..." beside `place`; fails at once if that cannot be done. `place` must
  // not exist, or hold nothing but what an earlier commit() wrote there (it is then replaced whole). What
  // dead processes left beside it is removed; while a living one is at work on it, this throws. It throws,
  // too, where a dead one left checkpoints, unless somebody goes on with them: then these stay.
  explicit OutputFolder(const std::filesystem::path& place, bool goes_on = false);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();  // removes the partial folder unless committed, or checkpoints are in it

  const std::filesystem::path& partial() const { return partial_; }  // write here
  const std::filesystem::path& place() const { return place_; }      // it ends up here
  // At every moment either what stood at `place` stands there, or what was made.
  void commit();

  // After the disk was full: gives the room back that was kept for this, so that a few small files can still
  // be written.
  void release_reserve();
  // What was made so far goes to "<place>.incomplete", what stands at `place` stays. Returns where it is.
  std::filesystem::path keep_incomplete();

 private:
  void move_to(const std::filesystem::path& place);
  void discard();
  void remove_new_folders();

  std::filesystem::path place_, partial_;
  std::filesystem::path
      first_new_;  // the uppermost folder above `partial_` that had to be made; empty for none
  FileLock lock_;  // of `partial_`
  bool committed_ = false;
  Unfinished unfinished_;
};

// Does this partial folder hold a run that was not complete yet? Else it is what stood at the place before.
bool is_unfinished(const std::filesystem::path& partial);

}  // namespace voxmelt::io
