#include "kernel/automaton/state/pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace voxmelt::state {
namespace {

constexpr std::size_t kPage = 4096;

// Large pages spare the processor most of its address translation, which is a third of a dense 256-cubed
// step. But they are taken whole, and fields beyond these sizes belong to scenes that are mostly empty.
constexpr std::size_t kLeastLarge = std::size_t{2} << 20, kMostLarge = std::size_t{320} << 20;

bool all_zero(const std::byte* bytes, std::size_t size) {
  return bytes[0] == std::byte{0} && std::memcmp(bytes, bytes + 1, size - 1) == 0;
}

std::byte* reserve(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  void* address =
      ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (address == MAP_FAILED) throw std::bad_alloc();
  if (bytes >= kLeastLarge && bytes <= kMostLarge) ::madvise(address, bytes, MADV_HUGEPAGE);  // a hint
  return static_cast<std::byte*>(address);
}

// Copies only the pages that differ. So empty pages never take memory.
void copy(const std::byte* from, std::byte* to, std::size_t bytes, bool to_is_zero) {
  for (std::size_t at = 0; at < bytes; at += kPage) {
    const std::size_t size = std::min(kPage, bytes - at);
    if (to_is_zero && all_zero(from + at, size)) continue;
    if (!to_is_zero && std::memcmp(from + at, to + at, size) == 0) continue;
    std::memcpy(to + at, from + at, size);
  }
}

}  // namespace

Pages::Pages(std::size_t bytes) : data_(reserve(bytes)), bytes_(bytes) {}

Pages::Pages(const Pages& other) : Pages(other.bytes_) { copy(other.data_, data_, bytes_, true); }

Pages& Pages::operator=(const Pages& other) {
  if (this == &other) return *this;
  if (bytes_ != other.bytes_) return *this = Pages(other);
  copy(other.data_, data_, bytes_, false);
  return *this;
}

Pages::~Pages() {
  if (data_ != nullptr) ::munmap(data_, bytes_);
}

void Pages::clear() {
  if (data_ == nullptr || ::madvise(data_, bytes_, MADV_DONTNEED) == 0) return;
  std::memset(data_, 0, bytes_);
}

bool operator==(const Pages& a, const Pages& b) {
  return a.bytes_ == b.bytes_ && (a.bytes_ == 0 || std::memcmp(a.data_, b.data_, a.bytes_) == 0);
}

}  // namespace voxmelt::state
