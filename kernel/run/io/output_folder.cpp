#include "kernel/run/io/output_folder.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>
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

[[noreturn]] void refuse(const fs::path& place, const std::string& why) {
  throw OutputError(place.string() + ": error: " + why, false);
}

// The files of a folder, as paths within it, one per line: what commit() writes into the marker.
std::set<std::string> files_within(const fs::path& folder) {
  std::set<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory() || entry.is_symlink())
      files.insert(entry.path().lexically_relative(folder).string());
  return files;
}

// An old output is replaced whole, so it must hold nothing that voxmelt did not write.
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
  for (std::string line; std::getline(marker, line);) written.insert(line);
  for (const std::string& file : files_within(place))
    if (!written.contains(file))
      refuse(place, "holds '" + file + "', which voxmelt did not write; choose another folder");
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& place) : place_(fs::weakly_canonical(fs::absolute(place))) {
  if (!place_.has_filename()) place_ = place_.parent_path();
  check_replaceable(place_);

  // A fresh folder beside the place, and the folders above it that are missing.
  std::error_code error;
  for (fs::path above = place_.parent_path(); !fs::exists(above, error); above = above.parent_path())
    first_new_ = above;
  fs::create_directories(place_.parent_path(), error);
  std::string partial = place_.string() + ".partial-XXXXXX";
  if (error || ::mkdtemp(partial.data()) == nullptr)
    fail(place_, "cannot create the output folder", error ? error.value() : errno);
  partial_ = partial;
  const mode_t mask = ::umask(0);
  ::umask(mask);
  ::chmod(partial.c_str(), 0777 & ~mask);
}

OutputFolder::~OutputFolder() {
  if (committed_) return;
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  // Folders that were made in vain are removed too; fs::remove leaves those that are not empty.
  for (fs::path folder = partial_; !first_new_.empty() && folder != first_new_;) {
    folder = folder.parent_path();
    fs::remove(folder, ignored);
  }
}

void OutputFolder::commit() {
  std::string files;
  for (const std::string& file : files_within(partial_)) files += file + "\n";
  write_file(partial_ / kMarker, files);

  std::error_code error;
  const fs::path old = partial_.string() + ".old";
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
  // A device, a pipe or a link (/dev/stdout) is written as it is; a file is replaced whole.
  std::error_code ignored;
  const bool replace =
      !fs::is_symlink(place, ignored) && (!fs::exists(place, ignored) || fs::is_regular_file(place, ignored));
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
