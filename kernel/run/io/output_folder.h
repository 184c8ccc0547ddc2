// An output folder is never half-written. It is filled beside its final place, flushed, and exchanged with
// the old contents when it is complete. A place that must stay where it is (exchange.h) has it within.
#pragma once

#include <filesystem>

#include "kernel/run/io/file_lock.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/run/io/unfinished.h"

namespace voxmelt::io {

class OutputFolder {
 public:
  // Prepares a fresh "<place>.partial-..." beside `place`, and fails at once if that cannot be done. `place`
  // must not exist, or hold nothing but the files of an earlier commit() (it is then replaced whole).
  // Leavings of dead processes beside it are removed. It throws if a living process is at work on `place`. It
  // also throws if a dead one left checkpoints, unless somebody goes on with them. Then these stay.
  explicit OutputFolder(const std::filesystem::path& place, bool goes_on = false);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();  // removes the partial folder unless committed, or checkpoints are in it

  const std::filesystem::path& partial() const { return partial_; }  // write here
  const std::filesystem::path& place() const { return place_; }      // it ends up here
  // Puts the new folder into place. At every moment either the old contents stand at `place`, or the new
  // ones, unless entries are moved one by one.
  void commit();

  // Gives back the reserved room after the disk was full, so that a few small files can still be written.
  void release_reserve();
  // Moves the output so far to "<place>.incomplete", and leaves the contents of `place` alone. If it cannot
  // be moved, it stays where it is. The call returns where that is, and throws nothing.
  std::filesystem::path keep_incomplete();

 private:
  void move_to(const std::filesystem::path& place);
  void discard();
  void remove_new_folders();

  std::filesystem::path place_, partial_;
  std::filesystem::path first_new_;  // uppermost folder above `partial_` that was made; empty for none
  FileLock lock_;                    // locks `partial_`
  bool within_ = false;              // `partial_` is made within the place, which must stay where it is
  bool settled_ = false;             // it stands where it stays
  Unfinished unfinished_;
};

// Names where an incomplete output is kept: beside its place, or within it.
std::filesystem::path incomplete_place(const std::filesystem::path& place, bool within);

// Tells if this partial folder holds a run that was not complete yet. If not, it has the former contents of
// the place.
bool is_unfinished(const std::filesystem::path& partial);

}  // namespace voxmelt::io
