#include "kernel/run/io/exchange.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>
#include <vector>

#include "kernel/run/io/declined.h"

namespace voxmelt::io {
namespace {

namespace fs = std::filesystem;

constexpr const char* kOld = ".voxmelt-old";        // former contents, within the fresh folder
constexpr const char* kMoving = ".voxmelt-moving";  // all former contents are there; fresh ones follow

bool is_there(const fs::path& path) {
  struct stat info {};
  return ::lstat(path.c_str(), &info) == 0;
}

int rename_entry(const fs::path& from, const fs::path& to) {
  return std::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) entries.push_back(entry.path());
  return entries;
}

int put_old_aside(const fs::path& fresh, const fs::path& place) {
  const fs::path old = fresh / kOld;
  if (::mkdir(old.c_str(), 0777) != 0 && errno != EEXIST) return errno;
  for (const fs::path& entry : entries_of(place)) {
    const fs::path name = entry.filename();
    if (is_beside_contents(place, name.string())) continue;
    if (const int why = rename_entry(entry, old / name); why != 0) return why;
  }
  const int done = ::open((fresh / kMoving).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
  if (done < 0) return errno;
  ::close(done);
  return 0;
}

// Puts back what put_old_aside() has moved.
void put_old_back(const fs::path& fresh, const fs::path& place) {
  for (const fs::path& entry : entries_of(fresh / kOld)) (void)rename_entry(entry, place / entry.filename());
  std::error_code ignored;
  fs::remove(fresh / kOld, ignored);
}

}  // namespace

bool must_stay(const fs::path& place) {
  std::error_code ignored;
  if (!fs::is_directory(place, ignored)) return false;
  const fs::path above = place.parent_path();
  struct statx its {};
  const bool known = ::statx(AT_FDCWD, place.c_str(), 0, STATX_BASIC_STATS, &its) == 0;
  if (known && (its.stx_attributes & its.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) != 0) return true;
  struct stat here {
  }, there{};
  if (::stat(place.c_str(), &here) == 0 && ::stat(above.c_str(), &there) == 0 && here.st_dev != there.st_dev)
    return true;
  return ::access(above.c_str(), W_OK | X_OK) != 0;
}

bool is_beside_contents(const fs::path& place, const std::string& name) {
  return name.starts_with(kPartialWithin) ||
         (name == kIncompleteWithin && is_there(place / kIncompleteWithin / kMarker));
}

int exchange(const fs::path& fresh, const fs::path& place) {
  if (!is_there(place)) return rename_entry(fresh, place);
  if (fresh.parent_path() != place &&
      ::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, place.c_str(), RENAME_EXCHANGE) == 0)
    return 0;
  if (fresh.parent_path() != place && !is_declined(errno) && errno != EBUSY && errno != EXDEV) return errno;
  return move_entries(fresh, place);
}

bool is_half_moved(const fs::path& fresh) { return is_there(fresh / kOld); }

int move_entries(const fs::path& fresh, const fs::path& place) {
  if (::mkdir(place.c_str(), 0777) != 0 && errno != EEXIST) return errno;
  if (!is_there(fresh / kMoving))
    if (const int why = put_old_aside(fresh, place); why != 0) {
      put_old_back(fresh, place);
      return why;
    }
  // The marker comes last: it says that all is there.
  for (const bool marker : {false, true})
    for (const fs::path& entry : entries_of(fresh)) {
      const std::string name = entry.filename().string();
      if (name == kOld || name == kMoving || (name == kMarker) != marker) continue;
      if (const int why = rename_entry(entry, place / name); why != 0) return why;
    }
  return 0;
}

}  // namespace voxmelt::io
