#include "kernel/engine/simd/source.h"

#include <algorithm>
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
      const std::int64_t had = v_.amount[i], taken = std::min<std::int64_t>(drain.rate, had);
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
    });
  }

 private:
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

void run_sources(const View& view, const Step& step, TileRow* changed, std::ptrdiff_t stride, Books& books) {
  Sources sources(view, step, changed, stride, books);
  for (const rule::Vent& vent : step.parameters->vents)
    if (vent.from <= step.number && step.number < vent.until) sources.vent(vent);
  for (const rule::Drain& drain : step.parameters->drains)
    if (drain.from <= step.number && step.number < drain.until) sources.drain(drain);
}

}  // namespace voxmelt::simd
