#include "kernel/engine/simd/source.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace voxmelt::simd {
namespace {

struct Range {
  int begin, end;
};
// Returns the interval of cells c whose centre, 16 c + 8, is at most `radius` from `at`. It may be slightly
// larger.
Range range(std::int64_t at, std::int64_t radius, int size) {
  const auto clamped = [&](std::int64_t c) { return static_cast<int>(std::clamp<std::int64_t>(c, 0, size)); };
  return {clamped(((at - radius) >> 4) - 1), clamped(((at + radius) >> 4) + 2)};
}

class Sources {
 public:
  Sources(const View& view, const Step& step, TileRow* changed, std::ptrdiff_t stride, Books& books)
      : v_(view),
        dither_(step.dither),
        paper_(step.parameters->flow.law == rule::Law::paper),
        hot_(step.parameters->heat.enabled),
        changed_(changed),
        stride_(stride),
        books_(books) {}

  void vent(const rule::Vent& vent) {
    for_cells(vent.region, [&](std::size_t i, std::uint64_t& wet, std::uint64_t bit) {
      const std::int64_t had = v_.amount[i], added = std::min<std::int64_t>(vent.rate, 65535 - had);
      if (added == 0) return false;
      v_.amount[i] = static_cast<std::uint16_t>(had + added);
      wet |= bit;
      books_.mass.added += added;
      if (paper_) {
        const std::int64_t energy = added * vent.energy / 4096;
        v_.energy[i] = static_cast<std::uint16_t>(v_.energy[i] + energy);
        books_.energy.added += energy;
      }
      if (hot_) {
        const std::int64_t now = had + added, brought = added * vent.temperature;
        const std::int64_t content = had * v_.heat[i] + brought;
        const std::int64_t mean = (content + now * dither_ / 65536) / now;
        v_.heat[i] = static_cast<std::uint16_t>(mean);
        books_.heat.added += brought;
        books_.heat.rounded += now * mean - content;
      }
      return true;
    });
  }

  void drain(const rule::Drain& drain) {
    for_cells(drain.region, [&](std::size_t i, std::uint64_t& wet, std::uint64_t bit) {
      return take(drain.rate, i, wet, bit);
    });
  }

  // Takes all liquid of the border. Where no tile of `moved` is, there was none, and none has come.
  void open_border(const TileRow* moved) {
    const TileRow ends = TileRow{1} | TileRow{1} << (v_.words - 1);
    for (int z = 0; z < v_.nz; ++z) {
      const bool whole = z == 0 || z == v_.nz - 1;
      for (int r = 0; r < v_.tile_rows(); ++r) {
        TileRow& changed = changed_[z * stride_ + r];
        TileRow awake = (moved[z * stride_ + r] | changed) & (whole ? ~TileRow{0} : ends);
        for (; awake != 0; awake &= awake - 1) {
          const int w = std::countr_zero(awake);
          if (empty_word(w, r, z, whole ? ~std::uint64_t{0} : border_of(w))) changed |= TileRow{1} << w;
        }
      }
    }
  }

 private:
  // Takes up to `rate` from a cell that is not blocked. It returns true if the cell changed.
  bool take(std::int64_t rate, std::size_t i, std::uint64_t& wet, std::uint64_t bit) {
    const std::int64_t had = v_.amount[i], taken = std::min<std::int64_t>(rate, had);
    if (taken == 0) return false;
    const std::int64_t left = had - taken, energy = std::min<std::int64_t>(v_.energy[i], left);
    books_.mass.removed += taken;
    books_.energy.removed += v_.energy[i] - energy;
    books_.heat.removed += taken * v_.heat[i];
    v_.amount[i] = static_cast<std::uint16_t>(left);
    v_.energy[i] = static_cast<std::uint16_t>(energy);
    if (left == 0) {
      wet &= ~bit;
      v_.heat[i] = 0;
    }
    return true;
  }

  // Returns the cells of a word of x that are the first or the last of their row.
  std::uint64_t border_of(int word) const {
    const std::uint64_t first = word == 0 ? 1 : 0;
    const std::uint64_t last = word == v_.words - 1 ? std::uint64_t{1} << ((v_.nx - 1) & 63) : 0;
    return first | last;
  }

  // Takes all liquid of the cells `which` of a tile. It returns true if there was any.
  bool empty_word(int word, int row, int z, std::uint64_t which) {
    bool any = false;
    for (int y = v_.tile_begin(row); y < v_.tile_end(row); ++y) {
      std::uint64_t& wet = v_.liquid[v_.word(word, y, z)];
      for (std::uint64_t left = wet & which; left != 0; left &= left - 1) {
        const int bit = std::countr_zero(left);
        any |= take(65535, v_.cell(0, y, z) + 64 * word + bit, wet, std::uint64_t{1} << bit);
      }
    }
    return any;
  }

  // Calls act(slot, liquid word, bit) for the cells of a region that are not blocked. act returns true if the
  // cell changed.
  template <class Act>
  void for_cells(const rule::Region& region, Act&& act) {
    const std::int64_t reach = region.radius * region.radius;
    const auto square = [](std::int64_t c, std::int64_t at) { return (16 * c + 8 - at) * (16 * c + 8 - at); };
    const Range xs = range(region.at.x, region.radius, v_.nx), ys = range(region.at.y, region.radius, v_.ny),
                zs = range(region.at.z, region.radius, v_.nz);
    for (int z = zs.begin; z < zs.end; ++z)
      for (int y = ys.begin; y < ys.end; ++y) {
        const std::int64_t left = reach - square(y, region.at.y) - square(z, region.at.z);
        if (left < 0) continue;
        TileRow* changed = changed_ + z * stride_ + (y >> v_.tile_shift);
        for (int x = xs.begin; x < xs.end; ++x) {
          const std::uint64_t bit = std::uint64_t{1} << (x & 63);
          const std::size_t mask = v_.word(x >> 6, y, z);
          if (square(x, region.at.x) > left || ((v_.solid[mask] | v_.inert[mask]) & bit) != 0) continue;
          const std::size_t slot = v_.cell(0, y, z) + x;
          if (act(slot, v_.liquid[mask], bit)) *changed |= TileRow{1} << (x >> 6);
        }
      }
  }

  const View v_;
  const std::int64_t dither_;
  const bool paper_, hot_;
  TileRow* const changed_;
  const std::ptrdiff_t stride_;
  Books& books_;
};

}  // namespace

void run_sources(const View& view, const Step& step, const TileRow* moved, TileRow* changed,
                 std::ptrdiff_t stride, Books& books) {
  Sources sources(view, step, changed, stride, books);
  for (const rule::Vent& vent : step.parameters->vents)
    if (vent.from <= step.number && step.number < vent.until) sources.vent(vent);
  for (const rule::Drain& drain : step.parameters->drains)
    if (drain.from <= step.number && step.number < drain.until) sources.drain(drain);
  if (step.parameters->open_border) sources.open_border(moved);
}

}  // namespace voxmelt::simd
