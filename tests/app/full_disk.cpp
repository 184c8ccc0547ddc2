// The library makes a disk with little room, for tests (LD_PRELOAD): FULL_DISK_BYTES bytes can be written to
// files, and no more. Removing the reserve of an output folder gives its room back.
#include <dlfcn.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace {

std::atomic<long> room{[] {
  const char* bytes = std::getenv("FULL_DISK_BYTES");
  return bytes != nullptr ? std::atol(bytes) : 0;
}()};

// The disk says this, as errno; without FULL_DISK_ERROR that it has no space.
const int error = [] {
  const char* number = std::getenv("FULL_DISK_ERROR");
  return number != nullptr ? std::atoi(number) : ENOSPC;
}();

template <class Function>
Function* original(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" std::size_t fwrite(const void* from, std::size_t size, std::size_t count, std::FILE* to) {
  static const auto real = original<std::size_t(const void*, std::size_t, std::size_t, std::FILE*)>("fwrite");
  if (to != stdout && to != stderr && (room -= static_cast<long>(size * count)) < 0) {
    room += static_cast<long>(size * count);
    errno = error;
    return 0;
  }
  return real(from, size, count, to);
}

extern "C" int remove(const char* path) noexcept {
  static const auto real = original<int(const char*)>("remove");
  if (std::string_view(path).ends_with("/.voxmelt-reserve")) room += 256 << 10;
  return real(path);
}
