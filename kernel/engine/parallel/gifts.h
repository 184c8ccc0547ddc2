// Gifts are what the cells of some rows of a slice give in the paper law's spread. Their memory is here.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/pages.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

class SliceGifts {
 public:
  // Makes memory for `rows` rows. `flows` is the number of arrays that differ: 1, 2 (axes, diagonals) or 4
  // (by direction).
  SliceGifts(const simd::View& view, int rows, int flows)
      : patterns_(array_cells(view, rows)),
        giving_(sizeof(simd::TileRow) * count(rows) * (view.words + 4)),
        fields_(sizeof(std::uint16_t) * (array_cells(view, rows) * (2 * flows + 1))) {
    gifts_.rows = rows;
    gifts_.pattern = reinterpret_cast<std::uint8_t*>(patterns_.data()) + kGuard;
    gifts_.giving = reinterpret_cast<simd::TileRow*>(giving_.data());
    gifts_.giving_tiles = gifts_.giving + rows;
    gifts_.givers = gifts_.giving_tiles + rows;
    auto* field = reinterpret_cast<std::uint16_t*>(fields_.data()) + kGuard;
    const auto array = [&](int i) { return field + array_cells(view, rows) * count(i); };
    for (int d = 0; d < 8; ++d) {
      const int which = flows == 4 ? d & 3 : flows == 2 ? d / 4 : 0;
      gifts_.flow[d] = array(which);
      gifts_.energy[d] = array(flows + which);
    }
    gifts_.heat = array(2 * flows);
  }

  simd::Gifts& gifts() { return gifts_; }
  const simd::Gifts& gifts() const { return gifts_; }
  bool empty() const {  // no cell gives
    const int tiles = gifts_.rows;
    return std::all_of(gifts_.giving_tiles, gifts_.giving_tiles + tiles,
                       [](simd::TileRow row) { return row == 0; });
  }

 private:
  static constexpr std::size_t kGuard = 64;
  static std::size_t count(int n) { return n; }
  static std::size_t array_cells(const simd::View& view, int rows) {
    return view.row * count(rows) + 2 * kGuard;
  }

  state::Pages patterns_, giving_, fields_;
  simd::Gifts gifts_;
};

}  // namespace voxmelt::parallel
