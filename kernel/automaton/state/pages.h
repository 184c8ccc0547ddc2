// Zeroed memory is taken only where something is written. Every cell has address space, and only pages that
// are not empty have memory. Copies are as sparse as their originals.
#pragma once

#include <cstddef>
#include <utility>

namespace voxmelt::state {

class Pages {
 public:
  Pages() = default;
  explicit Pages(std::size_t bytes);  // throws std::bad_alloc
  Pages(const Pages& other);
  Pages(Pages&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  Pages& operator=(const Pages& other);
  Pages& operator=(Pages&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  ~Pages();

  std::byte* data() { return data_; }
  const std::byte* data() const { return data_; }
  std::size_t size() const { return bytes_; }

  void clear();  // all zero again; gives the memory back

  friend bool operator==(const Pages& a, const Pages& b);

 private:
  std::byte* data_ = nullptr;  // aligned to a page
  std::size_t bytes_ = 0;
};

}  // namespace voxmelt::state
