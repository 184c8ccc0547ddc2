// Phase `gravity` of the paper's law (Eqs. 2-6, with excess in the same sweep) does one slice, ascending. It
// takes pairs of rows (y, y + 1), 64 cells at a time. It is free of kernel/automaton/rule on purpose:
// compared with it, not built from it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"
#include "kernel/engine/simd/mix.h"

namespace voxmelt::simd {

template <class Arch, GravityFeatures kFeatures>
class Gravity {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  using M = typename L::M;

 public:
  [[gnu::always_inline]] Gravity(const View& view, const Step& step, int z, Books& books)
      : v_(view),
        fall_(step.parameters->flow.fall),
        law_(step.parameters->flow.paper),
        z_(z),
        books_(books),
        mix_(step.dither) {}

  [[gnu::always_inline]] void run(int r, TileRow tiles, TileRow& follow, TileRow* changed) {
    TileRow moved = follow;  // tiles that the last pair of rows changed, so that those above may follow
    int rows = 0;
    const int end = v_.tile_end(r) < v_.ny ? v_.tile_end(r) : v_.ny - 1;
    Row row = row_of(v_.tile_begin(r));
    for (; row.y < end; row.climb(v_)) {
      TileRow work = tiles | moved;
      moved = 0;
      for (; work != 0; work &= work - 1) {
        const int w = __builtin_ctzll(work);
        const std::uint64_t liquid = row.liquid[w] | row.upper_liquid[w];
        if (liquid == 0) continue;
        const std::uint64_t open = liquid & ~(row.walls[w] | row.upper_walls[w]);
        if (open == 0) continue;
        if (pair(w, row, open)) moved |= TileRow{1} << w;
      }
      if (moved == 0) continue;
      changed[r] |= moved;
      changed[(row.y + 1) >> v_.tile_shift] |= moved;
      if ((++rows & 31) == 0) flush();  // sums hold 32,768 vectors, a row has at most 512
    }
    follow = moved;
    if ((rows & 31) != 0) flush();
  }

 private:
  // Is a pair of rows: the begin of the lower one, and the masks of both.
  struct Row {
    int y;
    std::size_t cell;
    std::uint64_t *liquid, *upper_liquid;
    const std::uint64_t *walls, *upper_walls;
    [[gnu::always_inline]] void climb(const View& v) {
      ++y;
      cell += v.row;
      liquid = upper_liquid;
      upper_liquid += v.words;
      walls = upper_walls;
      upper_walls += v.words + 2;
    }
  };
  [[gnu::always_inline]] Row row_of(int y) const {
    std::uint64_t* liquid = v_.liquid + v_.word(0, y, z_);
    const std::uint64_t* walls = v_.walls_at(y, z_);
    return {y, v_.cell(0, y, z_), liquid, liquid + v_.words, walls, walls + v_.words + 2};
  }

  [[gnu::always_inline]] bool pair(int w, const Row& row, std::uint64_t open) {
    const std::size_t low = row.cell + 64 * static_cast<std::size_t>(w), high = low + v_.row;
    prefetch_word(v_.amount + high + 3 * v_.row);
    prefetch_word(v_.energy + high + 3 * v_.row);
    Around around{};
    if constexpr (kFeatures.guided) around = surroundings(w, row.y + 1);
    std::uint64_t &low_liquid = row.liquid[w], &high_liquid = row.upper_liquid[w];
    Wet wet{low_liquid, high_liquid};
    const Fields lower = fields_at(low), upper = fields_at(high);
    const std::uint64_t walls = row.walls[w] | row.upper_walls[w];
    bool moved = false;
    cpu::unrolled<L::kParts>([&](auto part) VOXMELT_LAMBDA {
      if (!L::in_part(open, part)) return;
      moved |= vectors(lower + part * L::kCount, upper + part * L::kCount, walls, around, part, wet);
    });
    if (!moved) return false;
    low_liquid = wet.low & ~row.walls[w];
    high_liquid = wet.high & ~row.upper_walls[w];
    return true;
  }

  // Points to the fields of a row from some cell on.
  struct Fields {
    std::uint16_t *amount, *energy, *heat;
    [[gnu::always_inline]] Fields operator+(int cells) const {
      return {amount + cells, energy + cells, heat + cells};
    }
  };
  [[gnu::always_inline]] Fields fields_at(std::size_t cell) const {
    return {cpu::settled(v_.amount + cell), cpu::settled(v_.energy + cell),
            kFeatures.hot ? cpu::settled(v_.heat + cell) : nullptr};
  }

  struct Wet {  // cells of two words that hold something; blocked cells may be among them
    std::uint64_t low, high;
  };
  struct Around {
    std::uint64_t wall, overhang, clings;  // clings: cells that are set, and touch something
  };
  // Tells for the cells of word w in row y if a side was blocked before melt, and if there is something to
  // hang from.
  [[gnu::always_inline]] Around surroundings(int w, int y) const {
    const std::uint64_t* row = v_.sides_at(y, z_);
    const std::uint64_t wall = cpu::from_right(row[w], row[w + 1]) | cpu::from_left(row[w], row[w - 1]) |
                               v_.sides_at(y, z_ - 1)[w] | v_.sides_at(y, z_ + 1)[w];
    const std::uint64_t touches = wall | v_.blocked(w, y + 1, z_);
    return {wall, touches, touches & v_.set_cells(w, y, z_)};
  }

  [[gnu::always_inline]] V ready(V upper, V lower, Around around, int part) const {
    if constexpr (!kFeatures.guided) {
      return upper;
    } else {
      const V part_free = part_of(upper, fall_.factor), part_wall = part_of(upper, fall_.wall_factor);
      const V part_given = L::select(L::from_bits(around.wall, part), part_wall, part_free);
      V given = L::min(upper, L::add_saturated(part_given, L::set(fall_.minimum)));
      if (around.clings != 0) given = L::keep(L::from_bits(~around.clings, part), given);
      if (fall_.hang == 0) return given;
      const V hangs = L::keep(L::from_bits(around.overhang, part), L::set(0xFFFF));
      const V none_below = L::keep(L::equal(lower, L::zero()), hangs);
      const V light = L::keep(L::less(upper, L::set(fall_.hang)), none_below);
      return L::select(L::equal(light, L::zero()), given, L::zero());
    }
  }
  [[gnu::always_inline]] static V part_of(V a, std::uint32_t factor) {  // factor 0..65536, in 1/65536
    return factor > 0xFFFF ? a : L::high(a, L::set(static_cast<int>(factor)));
  }

  // Returns true if anything moved.
  [[gnu::always_inline]] bool vectors(const Fields& low, const Fields& high, std::uint64_t walls,
                                      Around around, int part, Wet& wet) {
    const V one = L::set(4096);
    const V lower = L::load(low.amount), upper = L::load(high.amount);
    V down = L::min(ready(upper, lower, around, part), L::sub_saturated(one, lower));
    V up = L::min(L::sub_saturated(lower, one), ~upper);  // no more than fits
    if (L::in_part(walls, part)) {
      const M open = L::from_bits(~walls, part);
      down = L::keep(open, down);
      up = L::keep(open, up);
    }
    if (!L::nonzero(down + up)) return false;
    const V new_lower = lower + down - up, new_upper = upper - down + up;
    L::store(low.amount, new_lower);
    L::store(high.amount, new_upper);
    const auto filled = L::filled(new_lower, new_upper);
    const int shift = part * L::kCount;
    wet.low = (wet.low & ~(kAll << shift)) | (filled & kAll) << shift;
    wet.high = (wet.high & ~(kAll << shift)) | (std::uint64_t{filled} >> L::kCount) << shift;
    move_energy(low, high, down, up, new_lower, new_upper);
    if constexpr (kFeatures.hot) {
      // A cell either gives or takes through this face.
      const M no_rise = L::equal(up, L::zero());
      const M low_dry = L::equal(new_lower, L::zero()), high_dry = L::equal(new_upper, L::zero());
      const V low_heat = L::load(low.heat), high_heat = L::load(high.heat);
      const V taker_had = L::select(no_rise, lower, upper),
              taker_heat = L::select(no_rise, low_heat, high_heat);
      const V flow = down + up, giver_heat = L::select(no_rise, high_heat, low_heat);
      const V mixed = mix_.two(taker_had, taker_heat, flow, giver_heat);
      const M no_fall = L::equal(down, L::zero());
      L::store(low.heat, L::select(low_dry, L::zero(), L::select(no_fall, low_heat, mixed)));
      L::store(high.heat, L::select(high_dry, L::zero(), L::select(no_rise, high_heat, mixed)));
    }
    return true;
  }

  [[gnu::always_inline]] void move_energy(const Fields& low, const Fields& high, V down, V up, V new_lower,
                                          V new_upper) {
    const V lower = L::load(low.energy), upper = L::load(high.energy);
    V lost = L::min(upper, down), gained = lost;
    if constexpr (kFeatures.guided) {
      const V room = new_lower - lower;  // a receiver's room; if nothing falls, nothing is lost either
      const std::uint32_t beta = law_.beta;
      V accelerated = L::high(lost, L::set(static_cast<int>(beta & 0xFFFF)));
      for (std::uint32_t whole = beta >> 16; whole > 0; --whole) accelerated = accelerated + lost;
      gained = L::min(accelerated, room);
      if (law_.reading == rule::EnergyReading::printed) lost = gained = L::min(gained, upper);
      faster_.add(gained);
      slower_.add(lost);
    }
    const V climbs = L::min(lower, up);
    const V uncapped = upper - lost + climbs;
    const V capped = L::min(uncapped, new_upper);  // a cell that does not give holds no more before nor after
    capped_.add(uncapped - capped);
    L::store(low.energy, lower + gained - climbs);
    L::store(high.energy, capped);
  }

  [[gnu::always_inline]] void flush() {
    books_.energy.capped += capped_.total();
    capped_ = {};
    if constexpr (kFeatures.guided) {
      books_.energy.accelerated +=
          static_cast<std::int64_t>(faster_.total()) - static_cast<std::int64_t>(slower_.total());
      faster_ = slower_ = {};
    }
    if constexpr (kFeatures.hot) books_.heat.rounded += mix_.flush();
  }

  static constexpr std::uint64_t kAll =
      L::kCount == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << L::kCount) - 1;

  const View v_;
  const rule::Fall& fall_;
  const rule::PaperLaw& law_;
  const int z_;
  Books& books_;
  Mix<Arch> mix_;
  typename L::SmallSums faster_, slower_, capped_;  // sums of what moves down: at most ONE a cell
};

}  // namespace voxmelt::simd
