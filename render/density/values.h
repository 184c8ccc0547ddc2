// There is one value per cell of a grid, in the order of Grid::index. All begin as zero, and values that were
// never written take no memory. Up to kBeyond values may be read past the end, and they are zero.
#pragma once

#include <cstddef>
#include <type_traits>

#include "kernel/automaton/state/pages.h"

namespace voxmelt::render {

template <class T>
class Values {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  using value_type = T;
  static constexpr std::size_t kBeyond = 48;

  Values() = default;
  explicit Values(std::size_t size) : size_(size), pages_((size + kBeyond) * sizeof(T)) {}

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return reinterpret_cast<T*>(pages_.data()); }
  const T* data() const { return reinterpret_cast<const T*>(pages_.data()); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size(); }

  friend bool operator==(const Values&, const Values&) = default;

 private:
  std::size_t size_ = 0;
  state::Pages pages_;
};

}  // namespace voxmelt::render
