// A worker needs memory in which the layers that it is given relax (simd::RelaxMemory).
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/pages.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

class LayerMemory {
 public:
  LayerMemory() = default;
  explicit LayerMemory(const simd::View& view) {
    const std::size_t cells = view.row * view.nz, layer = cells + 2 * view.row + 128;
    const std::size_t items = cells / 8;  // no vector has fewer lanes
    pages_ = state::Pages((8 * layer + 2 * cells) * sizeof(std::uint16_t) + 2 * cells * sizeof(std::int32_t) +
                          items * sizeof(simd::RelaxMemory::Item));
    std::byte* next = pages_.data();
    for (auto& leveling : memory_.leveling) leveling = take<std::uint16_t>(next, layer) + 64;
    for (auto& low : memory_.low) low = take<std::uint16_t>(next, layer) + 64;
    for (auto& high : memory_.high) high = take<std::uint16_t>(next, layer) + 64;
    memory_.head = take<std::uint16_t>(next, cells);
    memory_.head_high = take<std::uint16_t>(next, cells);
    memory_.impetus = take<std::int32_t>(next, cells);
    memory_.change = take<std::int32_t>(next, cells);
    memory_.items = take<simd::RelaxMemory::Item>(next, items);
  }
  const simd::RelaxMemory& memory() const { return memory_; }

 private:
  template <class T>
  static T* take(std::byte*& next, std::size_t count) {
    T* const taken = static_cast<T*>(static_cast<void*>(next));
    next += count * sizeof(T);
    return taken;
  }

  state::Pages pages_;
  simd::RelaxMemory memory_;
};

}  // namespace voxmelt::parallel
