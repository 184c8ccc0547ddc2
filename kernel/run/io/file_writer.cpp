#include "kernel/run/io/file_writer.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "kernel/run/io/declined.h"
#include "kernel/run/io/file_lock.h"

namespace voxmelt::io {

namespace fs = std::filesystem;

void fail_output(const fs::path& path, const std::string& what, int error) {
  throw OutputError(path.string() + ": error: " + what + ": " + std::strerror(error),
                    error == ENOSPC || error == EDQUOT);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) fail_output(folder, "cannot be made", error.value());
}

std::string beside(const fs::path& place) { return place.string() + ".partial-XXXXXX"; }

FileWriter::FileWriter(const fs::path& place) : place_(place), partial_(place.string()) {
  std::error_code ignored;
  replace_ =
      !fs::is_symlink(place, ignored) && (!fs::exists(place, ignored) || fs::is_regular_file(place, ignored));
  int descriptor = -1;
  if (replace_) {
    // Within a partial folder of ours this lock is taken, and nothing was left over.
    const FileLock above = FileLock::attempt(fs::absolute(place).parent_path());
    if (above) clear_leavings(fs::absolute(place));
    const auto held = changing_places();
    partial_ = beside(place);
    descriptor = ::mkostemp(partial_.data(), O_CLOEXEC);
    if (descriptor >= 0) unfinished_.begin([this] { std::remove(partial_.c_str()); });
    if (descriptor >= 0) (void)::flock(descriptor, LOCK_EX | LOCK_NB);
  } else {
    descriptor = ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  }
  file_ = descriptor < 0 ? nullptr : ::fdopen(descriptor, "wb");
  if (file_ == nullptr) fail_output(place_, "cannot write", errno);
}

FileWriter::~FileWriter() {
  if (file_ == nullptr) return;
  (void)std::fclose(file_);
  if (replace_) std::remove(partial_.c_str());
}

void FileWriter::write(std::string_view bytes) {
  if (bytes.empty()) return;  // they may have no address, which fwrite must not be given
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size())
    fail_output(place_, "cannot write", errno);
}

void FileWriter::commit() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  const int descriptor = ::fileno(file_);
  int error = std::fflush(file_) == 0 ? 0 : errno;
  // Where modes and flushes are declined, the file is as good without.
  if (replace_ && error == 0) (void)::fchmod(descriptor, 0666 & ~mask);
  if (replace_ && error == 0 && ::fsync(descriptor) != 0 && !is_declined(errno)) error = errno;
  if (std::fclose(std::exchange(file_, nullptr)) != 0 && error == 0) error = errno;
  const auto held = changing_places();
  if (error == 0 && replace_ && std::rename(partial_.c_str(), place_.c_str()) != 0) error = errno;
  if (error == 0) return unfinished_.complete();
  if (replace_) std::remove(partial_.c_str());
  fail_output(place_, "cannot write", error);
}

void write_file(const fs::path& place, const std::string& bytes) {
  FileWriter file(place);
  file.write(bytes);
  file.commit();
}

}  // namespace voxmelt::io
