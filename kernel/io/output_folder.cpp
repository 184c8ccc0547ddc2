#include "kernel/io/output_folder.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = ".voxmelt-output";

[[noreturn]] void fail(const fs::path& path, const std::string& what, int error) {
  throw OutputError(path.string() + ": error: " + what + ": " + std::strerror(error),
                    error == ENOSPC || error == EDQUOT);
}

std::string beside(const fs::path& place) {
  return place.string() + ".partial-" + std::to_string(::getpid());
}

}  // namespace

OutputFolder::OutputFolder(fs::path place) : place_(fs::absolute(std::move(place)).lexically_normal()) {
  if (!place_.has_filename()) place_ = place_.parent_path();
  partial_ = beside(place_);
  std::error_code error;
  if (fs::exists(place_, error)) {
    if (!fs::is_directory(place_, error))
      throw OutputError(place_.string() + ": error: is a file, not a folder to write into", false);
    if (!fs::is_empty(place_, error) && !fs::exists(place_ / kMarker, error))
      throw OutputError(
          place_.string() +
              ": error: the folder holds files that voxmelt did not write; choose another --out",
          false);
  }
  first_new_ = partial_;
  while (first_new_.has_relative_path() && !fs::exists(first_new_.parent_path(), error))
    first_new_ = first_new_.parent_path();
  fs::create_directories(partial_, error);
  if (error) fail(place_, "cannot create the output folder", error.value());
  write_file(partial_ / kMarker, "Written by voxmelt; replaced whole by the next run into this folder.\n");
}

OutputFolder::~OutputFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  // Folders made for nothing go too; fs::remove leaves those that are not empty.
  for (fs::path folder = partial_; folder != first_new_;) {
    folder = folder.parent_path();
    fs::remove(folder, ignored);
  }
}

void OutputFolder::commit() {
  std::error_code error;
  const fs::path old = beside(place_) + ".old";
  const bool replace = fs::exists(place_, error);
  if (replace) fs::rename(place_, old, error);
  if (error) fail(place_, "cannot replace the folder", error.value());
  fs::rename(partial_, place_, error);
  if (error) {
    const int why = error.value();
    if (replace) fs::rename(old, place_, error);
    fail(place_, "cannot move the finished folder into place", why);
  }
  committed_ = true;
  if (replace) fs::remove_all(old, error);
}

void write_file(const fs::path& place, const std::string& bytes) {
  // A device or a pipe (/dev/stdout) is written as it is; a file is replaced whole.
  std::error_code ignored;
  const bool replace = !fs::exists(place, ignored) || fs::is_regular_file(place, ignored);
  const fs::path partial = replace ? fs::path(beside(place)) : place;
  std::FILE* file = std::fopen(partial.c_str(), "wb");
  if (file == nullptr) fail(place, "cannot write", errno);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  int error = written ? 0 : errno;
  if (std::fclose(file) != 0 && error == 0) error = errno;
  if (error == 0 && replace && std::rename(partial.c_str(), place.c_str()) != 0) error = errno;
  if (error == 0) return;
  if (replace) std::remove(partial.c_str());
  fail(place, "cannot write", error);
}

}  // namespace voxmelt::io
