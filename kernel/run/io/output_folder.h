// Output that is never half-written: a folder is filled beside its final place and renamed when complete.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace voxmelt::io {

// Output cannot be written (exit code 2), or the disk is full (exit code 3).
class OutputError : public std::runtime_error {
 public:
  OutputError(const std::string& message, bool out_of_space)
      : std::runtime_error(message), out_of_space_(out_of_space) {}
  bool out_of_space() const { return out_of_space_; }

 private:
  bool out_of_space_;
};

class OutputFolder {
 public:
  // Prepares a fresh "<place>.partial-..." beside `place`; fails at once if that cannot be done. `place` must
  // not exist, or hold nothing but what an earlier commit() wrote there (it is then replaced whole).
  explicit OutputFolder(const std::filesystem::path& place);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();  // removes the partial folder unless committed

  const std::filesystem::path& partial() const { return partial_; }  // write here
  const std::filesystem::path& place() const { return place_; }      // it ends up here
  void commit();

 private:
  std::filesystem::path place_, partial_;
  std::filesystem::path
      first_new_;  // the uppermost folder above `partial_` that had to be made; empty for none
  bool committed_ = false;
};

// Writes a file beside its place and renames it; a device or pipe is written directly.
void write_file(const std::filesystem::path& place, const std::string& bytes);

}  // namespace voxmelt::io
