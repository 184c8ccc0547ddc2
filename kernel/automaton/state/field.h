// A field has one number per cell, laid out for SIMD: [z][y][x], x fastest. Every row begins at a multiple of
// 64 cells and 64 bytes. A slice has one spare row. Without it, the slices of a power-of-two grid would share
// the same sets of a cache. Padding is 0 and stays 0. A row may be read up to 64 cells beyond both ends.
#pragma once

#include <cstddef>
#include <span>

#include "kernel/automaton/state/grid.h"
#include "kernel/automaton/state/pages.h"

namespace voxmelt::state {

// Tells where a cell is stored in a field. Only Layout makes it, so it is not mistaken for Grid::index.
struct Slot {
  std::size_t offset = 0;
  friend Slot operator+(Slot slot, std::size_t cells) { return {slot.offset + cells}; }
  friend bool operator==(const Slot&, const Slot&) = default;
};

class Layout {
 public:
  Layout() = default;
  explicit Layout(Grid grid)
      : row_(words_for(grid.x) * 64), slice_(row_ * grid.y + 64), cells_(slice_ * grid.z) {}

  Slot at(int x, int y, int z) const { return {z * slice_ + y * row_ + x}; }
  std::size_t row() const { return row_; }      // cells from (x, y, z) to (x, y + 1, z)
  std::size_t slice() const { return slice_; }  // cells from (x, y, z) to (x, y, z + 1)
  std::size_t cells() const { return cells_; }  // with padding

 private:
  std::size_t row_ = 0, slice_ = 0, cells_ = 0;
};

template <class T>
class Field {
 public:
  Field() = default;
  explicit Field(Grid grid) : layout_(grid), pages_((layout_.cells() + 2 * kGuard) * sizeof(T)) {}

  bool empty() const { return layout_.cells() == 0; }
  const Layout& layout() const { return layout_; }

  T& operator[](Slot slot) { return data()[slot.offset]; }
  const T& operator[](Slot slot) const { return data()[slot.offset]; }
  T* data() { return reinterpret_cast<T*>(pages_.data()) + kGuard; }
  const T* data() const { return reinterpret_cast<const T*>(pages_.data()) + kGuard; }
  T* row(int y, int z) { return data() + layout_.at(0, y, z).offset; }
  const T* row(int y, int z) const { return data() + layout_.at(0, y, z).offset; }

  // Returns all stored values, including the padding (0) between rows.
  std::span<const T> stored() const { return {data(), layout_.cells()}; }

  void clear() { pages_.clear(); }

  friend bool operator==(const Field& a, const Field& b) { return a.pages_ == b.pages_; }

 private:
  static constexpr std::size_t kGuard = 64;
  Layout layout_;
  Pages pages_;
};

}  // namespace voxmelt::state
