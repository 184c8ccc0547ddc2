// Memory for what the cells of one slice give in the paper law's spread.
#pragma once

#include "kernel/simd/kernels.h"
#include "kernel/state/pages.h"

namespace voxmelt::parallel {

class SliceGifts {
 public:
  // `flows`: arrays that differ: 1, 2 (axes, diagonals) or 4 (by direction).
  SliceGifts(const simd::View& view, int flows)
      : planes_(sizeof(std::uint64_t) * plane_words(view)),
        giving_(4 * sizeof(simd::TileRow) * static_cast<std::size_t>(view.ny)),
        fields_(sizeof(std::uint16_t) * (cells(view) * static_cast<std::size_t>(2 * flows + 1))) {
    gifts_.planes = reinterpret_cast<std::uint64_t*>(planes_.data());
    gifts_.giving = reinterpret_cast<simd::TileRow*>(giving_.data());
    gifts_.giving_left = gifts_.giving + view.ny;
    gifts_.giving_right = gifts_.giving_left + view.ny;
    gifts_.giving_tiles = gifts_.giving_right + view.ny;
    auto* field = reinterpret_cast<std::uint16_t*>(fields_.data()) + kGuard;
    const auto array = [&](int i) { return field + cells(view) * static_cast<std::size_t>(i); };
    for (int d = 0; d < 8; ++d) {
      const int which = flows == 4 ? d & 3 : flows == 2 ? d / 4 : 0;
      gifts_.flow[d] = array(which);
      gifts_.energy[d] = array(flows + which);
    }
    gifts_.heat = array(2 * flows);
  }

  simd::Gifts& gifts() { return gifts_; }
  const simd::Gifts& gifts() const { return gifts_; }

  // False: nothing gives, no kernel need look.
  bool written() const { return written_; }
  void set_written(bool written) { written_ = written; }

 private:
  static constexpr std::size_t kGuard = 64;
  static std::size_t cells(const simd::View& view) {
    return view.row * static_cast<std::size_t>(view.ny) + 2 * kGuard;
  }
  static std::size_t plane_words(const simd::View& view) {
    return 8 * static_cast<std::size_t>(view.ny) * static_cast<std::size_t>(view.words + 2);
  }

  state::Pages planes_, giving_, fields_;
  simd::Gifts gifts_;
  bool written_ = false;
};

}  // namespace voxmelt::parallel
