// Walls limit the neighbours that a cell may give to in phase `spread` of the paper's law (docs/automaton.md,
// section 2). The code treats the two vectors of an item.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

template <class Arch, int kDirections>
class Openness {
  using L = cpu::Lanes<Arch>;
  using Bytes = typename L::Bytes;
  using Twin = typename L::Twin;

 public:
  static constexpr int kCells = 2 * L::kCount;

  [[gnu::always_inline]] explicit Openness(const View& view)
      : words_(view.words),
        slice_(static_cast<std::ptrdiff_t>(view.ny + 2) * (view.words + 2)),
        last_word_(view.last_word),
        last_lane_((view.nx - 1) / kCells * kCells),
        west_(directions(0, kWest)),
        east_(directions((view.nx - 1) % kCells, kEast)) {}

  // Returns the cells of word w that have a wall beside them or across a diagonal. The walls of the row begin
  // at `row`. The border in x is left out, since every row has it.
  [[gnu::always_inline]] std::uint64_t beside_walls(int w, const std::uint64_t* row) const {
    const std::uint64_t *own = row + w, *front = own + slice_, *back = own - slice_;
    std::uint64_t here = own[0] | front[0] | back[0];
    std::uint64_t left = own[-1] | front[-1] | back[-1], right = own[1] | front[1] | back[1];
    if (w == 0) left = 0;
    if (w == words_ - 1) {
      right = 0;
      here &= last_word_;
    }
    return here | cpu::from_left(here, left) | cpu::from_right(here, right);
  }

  // Removes directions that leave the grid along x, for the cells from `lane` on.
  [[gnu::always_inline]] Bytes inside(int lane, Bytes available) const {
    if (lane == 0) available = L::without(available, west_);
    if (lane == last_lane_) available = L::without(available, east_);
    return available;
  }

  // Removes directions whose neighbour is blocked or, across a diagonal, behind two blocked cells.
  [[gnu::always_inline]] Bytes past_walls(int lane, const std::uint64_t* row, Bytes available) const {
    const std::uint64_t *own = row + lane / 64, *front = own + slice_, *back = own - slice_;
    Bytes closed = L::none();
    const auto push = [&](int d, std::uint64_t blocked) VOXMELT_LAMBDA {
      closed = L::push(closed, L::where(static_cast<Twin>(blocked >> (lane % 64))), d);
    };
    const std::uint64_t right = cpu::from_right(own[0], own[1]), left = cpu::from_left(own[0], own[-1]);
    if constexpr (kDirections == 8) {
      push(7, cpu::from_left(back[0], back[-1]) | (left & back[0]));
      push(6, cpu::from_left(front[0], front[-1]) | (left & front[0]));
      push(5, cpu::from_right(back[0], back[1]) | (right & back[0]));
      push(4, cpu::from_right(front[0], front[1]) | (right & front[0]));
    }
    push(3, back[0]);
    push(2, front[0]);
    push(1, left);
    push(0, right);
    return L::without(available, closed);
  }

 private:
  static constexpr int kEast = 0b00110001, kWest = 0b11000010;  // directions to the next and the previous x
  [[gnu::always_inline]] static Bytes directions(int cell, int bits) {
    return L::both(L::fill(L::none(), L::where(static_cast<Twin>(Twin{1} << cell))), L::bytes(bits));
  }

  const int words_;
  const std::ptrdiff_t slice_;
  const std::uint64_t last_word_;
  const int last_lane_;
  const Bytes west_, east_;
};

}  // namespace voxmelt::simd
