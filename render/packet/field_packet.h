// A packet sees the field by samples, the march to the surface, the crossing and the normal.
//
// Positions are in the lattice. They are place_of(position) plus the border, so that cell and weight are
// plain bits.
#pragma once

#include <cstdint>

#include "render/packet/rays.h"
#include "render/rule/crossing.h"
#include "render/rule/sample.h"

namespace voxmelt::render {

template <class Arch>
struct FieldPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::F;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Row = typename Rays<Arch>::Row;

  static constexpr std::int32_t kBias =
      static_cast<std::int32_t>(picture::kToPlace + 2 * picture::kCell);  // kLatticeBorder
  static constexpr std::int32_t kSlice = 121, kRow = 11, kVolume = 1331;  // strides of a brick's places
  static constexpr std::int32_t kOne = kSlice + kRow + 1;                 // one place along each axis

  // Returns the index of the lowest of the eight places around a lattice position, less one place along each
  // axis.
  VOXMELT_WORDS V corner(const FieldData& field, Triple q) {
    const V brick = ((q.z >> 23) * field.bricks_y + (q.y >> 23)) * field.bricks_x + (q.x >> 23);
    const V slot = L::template gather<4>(field.slots, brick);
    return slot * kVolume + in_brick(q);
  }
  VOXMELT_WORDS V in_brick(Triple q) {
    return ((q.z >> 20) & 7) * kSlice + ((q.y >> 20) & 7) * kRow + ((q.x >> 20) & 7);
  }
  // Returns (256 - w) and w as a pair of 16 bits.
  VOXMELT_WORDS V weights(V q) {
    const V w = (q >> 12) & 255;
    return (256 - w) | (w << 16);
  }
  VOXMELT_WORDS V blended(V pair, V weight) { return (L::pair_products(pair, weight) + 128) >> 8; }
  VOXMELT_WORDS V pair(V below, V above) { return (below & 0xFFFF) | (above << 16); }

  VOXMELT_WORDS V sample(const FieldData& field, Triple q) { return sample_in(field, q, corner(field, q)); }
  VOXMELT_WORDS V sample_in(const FieldData& field, Triple q, V at) {
    const V wx = weights(q.x), wy = weights(q.y), wz = weights(q.z);
    const auto along_x = [&](std::int32_t offset) {
      return blended(L::template gather<2>(field.levels + kOne + offset, at), wx);
    };
    const V back = blended(pair(along_x(0), along_x(kRow)), wy);
    const V front = blended(pair(along_x(kSlice), along_x(kSlice + kRow)), wy);
    return blended(pair(back, front), wz);
  }

  struct Hits {
    V found;    // mask
    V sample;   // first sample in matter
    V level;    // level of that sample
    Triple at;  // lattice position of that sample
  };

  // Holds the state of a packet on its way.
  struct Walk {
    V last, sample, active;
    Triple at;                 // lattice position of the sample
    V back_x, back_y, back_z;  // -1 if towards lower places
    Hits hits;
  };
  VOXMELT_WORDS Walk walk(const PictureData& data, const Row& row, V most) {
    return walk(data, row, L::set(-1), V{}, most);
  }
  // Starts the walk of some rays, from sample `from` on.
  VOXMELT_WORDS Walk walk(const PictureData& data, const Row& row, V rays, V from, V most) {
    Walk result;
    auto range = Rays<Arch>::in_box(row, data.field.low, data.field.high);
    result.last = L::min(range.last, most);
    result.sample = L::max(range.first, from);
    result.active = rays & (result.sample <= result.last);
    result.at = P::select(result.active, Rays<Arch>::at(row, result.sample, kBias), Triple{});
    result.back_x = row.step.x < 0;
    result.back_y = row.step.y < 0;
    result.back_z = row.step.z < 0;
    result.hits.found = result.hits.sample = result.hits.level = result.hits.at.x = result.hits.at.y =
        result.hits.at.z = V{};
    return result;
  }

  static constexpr float kLess = 1 - 1.0f / (1 << 18);
  static constexpr int kBlockBits = 22;

  struct Block {
    V record, occupied;  // see FieldBricks::records
    V advance;           // samples until the ray leaves the block, or the empty cube around it
  };
  VOXMELT_WORDS Block block(const PictureData& data, const Row& row, const Walk& walk) {
    const FieldData& field = data.field;
    const Triple at = walk.at >> kBlockBits;
    const V index = (at.z * field.blocks_y + at.y) * field.blocks_x + at.x;
    Block found;
    found.record = L::template gather<4>(field.records, index);
    const V air = found.record < 0;
    found.occupied = walk.active & ~air;
    found.advance = L::set(1);
    if (data.skip) {
      const V reach = (air ? found.record & 255 : L::set(1)) << kBlockBits;
      const auto axis = [&](V place, V back, F inverse) {
        const V way = reach + back - ((place ^ back) & ((1 << kBlockBits) - 1));
        return L::to_float(way) * inverse;
      };
      const F leave = L::min(
          L::min(axis(walk.at.x, walk.back_x, row.inverse_x), axis(walk.at.y, walk.back_y, row.inverse_y)),
          axis(walk.at.z, walk.back_z, row.inverse_z));
      found.advance = L::to_int(L::min(leave * kLess, L::set_float(1e8f))) + 1;
    }
    return found;
  }

  VOXMELT_WORDS void meet(const PictureData& data, Walk& walk, Block& in, V level) {
    const V matter = in.occupied & (level >= 0);
    walk.hits.found = walk.hits.found | matter;
    walk.hits.sample = matter ? walk.sample : walk.hits.sample;
    walk.hits.level = matter ? level : walk.hits.level;
    walk.hits.at = P::select(matter, walk.at, walk.hits.at);
    walk.active = walk.active & ~matter;
    if (data.skip) {
      // The level rises no faster than the block's slope allows. Weights and blends are rounded.
      const F rise_unit = L::set_float(1.0f / static_cast<float>(kSlopeUnit >> data.spacing));
      const V slope = in.record & 255;
      const F steps = L::to_float(-level - 4 - 3 * slope) / L::to_float(L::max(slope, L::set(1))) * rise_unit;
      const V safe = L::to_int(L::max(steps * kLess, L::set_float(0))) + 1;
      in.advance = in.occupied ? L::min(in.advance, safe) : in.advance;
    }
  }
  VOXMELT_WORDS void go(const Row& row, Walk& walk, V advance) {
    walk.sample = walk.sample + advance;
    walk.active = walk.active & (walk.sample <= walk.last);
    walk.at = P::select(walk.active, walk.at + row.step * advance, walk.at);
  }
  VOXMELT_WORDS V occupied_sample(const PictureData& data, const Walk& walk, const Block& in) {
    const V slot = in.occupied ? in.record >> 8 : V{};
    return sample_in(data.field, walk.at, slot * kVolume + in_brick(walk.at));
  }
  VOXMELT_WORDS void finish(const PictureData& data, const Row& row, Walk& walk) {
    while (L::any(walk.active)) {
      Block in = block(data, row, walk);
      if (L::any(in.occupied)) meet(data, walk, in, occupied_sample(data, walk, in));
      go(row, walk, in.advance);
    }
  }

  // Returns the first sample in matter of every ray, up to `most`.
  VOXMELT_WORDS Hits march(const PictureData& data, const Row& row, V most) {
    return march(data, row, L::set(-1), V{}, most);
  }
  // Does the same for some rays, from sample `from` on.
  VOXMELT_WORDS Hits march(const PictureData& data, const Row& row, V rays, V from, V most) {
    Walk the_walk = walk(data, row, rays, from, most);
    finish(data, row, the_walk);
    return the_walk.hits;
  }
  // Marches two packets at once. While one waits for memory, the other goes on. It reads approaches[i].row
  // and most, and writes hits.
  template <class Approach>
  VOXMELT_WORDS void march(const PictureData& data, Approach* first, Approach* end) {
    const auto next = [&](Walk& the_walk) -> Approach* {
      while (first != end) {
        Approach* const taken = first++;
        the_walk = walk(data, taken->row, taken->most);
        if (L::any(the_walk.active)) return taken;
        taken->hits = the_walk.hits;
      }
      return nullptr;
    };
    Walk a, b;
    Approach *of_a = next(a), *of_b = of_a == nullptr ? nullptr : next(b);
    while (of_b != nullptr) {
      Block in_a = block(data, of_a->row, a), in_b = block(data, of_b->row, b);
      if (L::any(in_a.occupied)) meet(data, a, in_a, occupied_sample(data, a, in_a));
      if (L::any(in_b.occupied)) meet(data, b, in_b, occupied_sample(data, b, in_b));
      go(of_a->row, a, in_a.advance);
      go(of_b->row, b, in_b.advance);
      if (!L::any(a.active)) {
        of_a->hits = a.hits;
        of_a = next(a);
        if (of_a == nullptr) {
          a = b;
          of_a = of_b;
          of_b = nullptr;
          break;
        }
      }
      if (!L::any(b.active)) {
        of_b->hits = b.hits;
        of_b = next(b);
      }
    }
    if (of_a == nullptr) return;
    finish(data, of_a->row, a);
    of_a->hits = a.hits;
  }

  struct Surface {
    V part;     // part of the step to the hit's sample, in picture::kPlaces
    Triple at;  // lattice position of the crossing
  };

  VOXMELT_WORDS Surface crossing(const FieldData& field, const Row& row, const Hits& hits) {
    const V from_start = hits.sample == 0;
    const Triple outside = P::select(hits.found & ~from_start, hits.at - row.step, hits.at);
    const Surface surface = crossing_between(field, outside, hits.at, hits.level);
    return {from_start ? L::set(picture::kPlaces) : surface.part, P::select(from_start, hits.at, surface.at)};
  }

  // Finds the crossing between two lattice positions. `outside` is in air, and `inside` in matter of the
  // level `high`.
  VOXMELT_WORDS Surface crossing_between(const FieldData& field, Triple outside, Triple inside, V high) {
    V low = sample(field, outside), part{};
    for (int i = 0; i < picture::kBisections; ++i) {
      const Triple middle = outside + ((inside - outside) >> 1);
      const V level = sample(field, middle), air = level < 0;
      part = part + part - air;
      outside = P::select(air, middle, outside);
      low = air ? level : low;
      inside = P::select(air, inside, middle);
      high = air ? high : level;
    }
    const V rise = high - low;
    const V last = L::to_int(L::to_float(-low * picture::kParts) / L::to_float(rise == 0 ? L::set(1) : rise));
    return {part * picture::kParts + last, outside + (((inside - outside) * last) >> 8)};
  }

  // Holds weights of the quadratic B-spline (rule/normal.h). The first two are a pair of 16 bits, and the
  // third stands alone.
  struct Spline {
    V further;  // cells from the corner's to the middle one
    V value01, value2, slope01, slope2;
  };
  VOXMELT_WORDS Spline spline(V q) {
    const V middle = q + static_cast<std::int32_t>(picture::kCell / 2);
    const V u = (middle >> 12) & 255, before = 256 - u;
    const V low = (before * before) >> 9, high = (u * u) >> 9;
    return {(middle >> 20) - (q >> 20), pair(low, 256 - low - high), high, pair(-before, before - u), u};
  }
  template <int kBits>
  VOXMELT_WORDS V splined(V first_two, V third, V weight01, V weight2) {
    return (L::pair_products(first_two, weight01) + L::pair_products(third & 0xFFFF, weight2) +
            (1 << (kBits - 1))) >>
           kBits;
  }
  template <int kBits>
  VOXMELT_WORDS V splined(V a, V b, V c, V weight01, V weight2) {
    return splined<kBits>(pair(a, b), c, weight01, weight2);
  }

  VOXMELT_WORDS Triple normal(const PictureData& data, Triple q) {
    const Spline x = spline(q.x), y = spline(q.y), z = spline(q.z);
    const V at = corner(data.field, q) + x.further + y.further * kRow + z.further * kSlice;
    V slope_x[3], slope_y[3], value[3];
    for (int k = 0; k < 3; ++k) {
      V slopes[3], values[3];
      for (int j = 0; j < 3; ++j) {
        const std::int16_t* row = data.field.levels + k * kSlice + j * kRow;
        const V two = L::template gather<2>(row, at), third = L::template gather<2>(row + 2, at);
        slopes[j] = splined<9>(two, third, x.slope01, x.slope2);
        values[j] = splined<8>(two, third, x.value01, x.value2);
      }
      slope_x[k] = splined<8>(slopes[0], slopes[1], slopes[2], y.value01, y.value2);
      slope_y[k] = splined<9>(values[0], values[1], values[2], y.slope01, y.slope2);
      value[k] = splined<8>(values[0], values[1], values[2], y.value01, y.value2);
    }
    const Triple slope{splined<8>(slope_x[0], slope_x[1], slope_x[2], z.value01, z.value2),
                       splined<8>(slope_y[0], slope_y[1], slope_y[2], z.value01, z.value2),
                       splined<9>(value[0], value[1], value[2], z.slope01, z.slope2)};
    return P::unit(Triple{} - slope, data.inverse_root);
  }

  // Blends the bytes of two words of four, lane by lane. Words are split into even and odd bytes.
  VOXMELT_WORDS V blend_bytes(V a, V b, V w) {
    constexpr std::uint32_t kEven = 0x00FF00FF;
    using U = typename L::U;
    const U by = L::as_unsigned(w), keep = 256 - by, first = L::as_unsigned(a), second = L::as_unsigned(b);
    const U even = (((first & kEven) * keep + (second & kEven) * by + 0x00800080) >> 8) & kEven;
    const U odd = (((first >> 8) & kEven) * keep + ((second >> 8) & kEven) * by + 0x00800080) & (kEven << 8);
    return L::as_signed(even | odd);
  }
  // Returns liquid, heat and obstacle as bytes of a lane, read among the centres of cells (rule/matter.h).
  VOXMELT_WORDS V matter(const FieldData& field, Triple q) {
    const auto among_centers = [](V place, std::int64_t cells) {
      constexpr auto kHalf = static_cast<std::int32_t>(picture::kCell / 2);
      return L::clamp(place, kBias + kHalf,
                      static_cast<std::int32_t>(cells * picture::kCell) + (kBias - kHalf));
    };
    q = {among_centers(q.x, field.cells.x), among_centers(q.y, field.cells.y),
         among_centers(q.z, field.cells.z)};
    const V at = corner(field, q);
    const V wx = (q.x >> 12) & 255, wy = (q.y >> 12) & 255, wz = (q.z >> 12) & 255;
    const auto along_x = [&](std::int32_t offset) {
      return blend_bytes(L::template gather<4>(field.matter + kOne + offset, at),
                         L::template gather<4>(field.matter + kOne + offset + 1, at), wx);
    };
    const V back = blend_bytes(along_x(0), along_x(kRow), wy);
    const V front = blend_bytes(along_x(kSlice), along_x(kSlice + kRow), wy);
    return blend_bytes(back, front, wz);
  }
};

}  // namespace voxmelt::render
