// A packet sees the ground by the first crossing, its face, the normal and the paint (rule/ground.h,
// rule/rock.h).
//
// Places on rays are in parts of steps. The function fits_lanes makes sure that they and the ranges below are
// exact.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/packet/rays.h"
#include "render/rule/ground.h"
#include "render/rule/rock.h"

namespace voxmelt::render {

template <class Arch>
struct GroundPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::F;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Row = typename Rays<Arch>::Row;

  static constexpr picture::Vector kLow{};
  static constexpr float kMore = 1.0f / (1 << 20);

  struct Hits {
    V found;   // mask
    V inside;  // part in the ground
    V before;  // part outside of it, before; the crossing lies between the two
  };

  struct Place {
    V cell, weight;
  };
  // Returns the place of a position in a table with 2^fineness entries a cell, by picture::place_of.
  VOXMELT_WORDS Place place(V position, int fineness) {
    const V shifted = position + static_cast<std::int32_t>(picture::kToPlace >> fineness);
    return {shifted >> (20 - fineness), (shifted >> (12 - fineness)) & 255};
  }
  VOXMELT_WORDS V blended(V below, V above, V weight) {
    return ((below << 8) + (above - below) * weight + 128) >> 8;
  }

  VOXMELT_WORDS V height(const GroundData& ground, const std::int32_t* heights, V x, V z) {
    const Place px = place(x, 0), pz = place(z, 0);
    const V at = pz.cell * ground.row + px.cell;
    const V back =
        blended(L::template gather<4>(heights, at), L::template gather<4>(heights + 1, at), px.weight);
    const V front = blended(L::template gather<4>(heights + ground.row, at),
                            L::template gather<4>(heights + ground.row + 1, at), px.weight);
    return blended(back, front, pz.weight);
  }
  VOXMELT_WORDS V above(const GroundData& ground, Triple p) {
    return (p.y >> (picture::kPositionBits - picture::kHeightBits)) - height(ground, ground.drawn, p.x, p.z);
  }

  // Holds the state of a packet on its way.
  struct Walk {
    V first, last, part, active;
    F nearer, per_sample;  // 2^-32 cells that the ground may come nearer at each sample
    Hits hits;
  };
  VOXMELT_WORDS Walk walk(const PictureData& data, const Row& row) {
    const GroundData& ground = data.ground;
    const std::int64_t top = std::int64_t{ground.highest} << (picture::kPositionBits - picture::kHeightBits);
    const auto range = Rays<Arch>::parts_in(
        row, kLow, {ground.cells.x * picture::kCell, top, ground.cells.z * picture::kCell});
    Walk result;
    result.first = range.first;
    result.last = range.last;
    result.active = range.first <= range.last;
    result.hits = {V{}, V{}, V{}};
    if (!L::any(result.active)) return result;
    result.part = result.active ? range.first : V{};
    // The numbers are those of GroundMap::find. All floats are rounded so that less is left out.
    const F aside = L::to_float(P::magnitude(row.step.x)) * static_cast<float>(ground.slopes.x) +
                    L::to_float(P::magnitude(row.step.z)) * static_cast<float>(ground.slopes.z);
    const F fall = L::to_float(row.step.y) * static_cast<float>(-picture::kHeight);
    result.nearer = aside + fall + (aside + L::max(fall, -fall)) * kMore;
    result.per_sample = result.nearer > 0.0f ? (1 - kMore * 4) / result.nearer : L::set_float(1.0f);
    return result;
  }
  VOXMELT_WORDS V over(const PictureData& data, const Row& row, Triple start, const Walk& walk) {
    const Triple p = P::select(walk.active, Rays<Arch>::at_part(row, start, walk.part), Triple{});
    return walk.active ? above(data.ground, p) : V{};
  }
  VOXMELT_WORDS void go(const PictureData& data, Walk& walk, V over) {
    const V hit = walk.active & (over < 0);
    walk.hits.found = walk.hits.found | hit;
    walk.hits.inside = hit ? walk.part : walk.hits.inside;
    walk.active = walk.active & ~hit & (walk.part < walk.last);
    V next = (walk.part >> picture::kPartBits) + 1;
    if (data.skip) {
      const picture::Vector slopes = data.ground.slopes;
      const float margin = static_cast<float>(slopes.x + slopes.z) * 8193.0f + (9 << 20);
      const F gap = L::to_float(over) * static_cast<float>(1 << picture::kPositionBits) - margin;
      const F leap =
          gap > 0.0f ? (walk.nearer > 0.0f ? gap * walk.per_sample : L::set_float(1e6f)) : L::set_float(0);
      next = next + L::to_int(L::min(leap, L::set_float(1e6f)));
    }
    walk.part =
        walk.active
            ? L::min(L::min(next, (walk.last >> picture::kPartBits) + 1) << picture::kPartBits, walk.last)
            : walk.part;
  }
  VOXMELT_WORDS Hits hits_of(const Walk& walk) {
    Hits hits = walk.hits;
    const V sample = (hits.inside - 1) & -picture::kParts;
    hits.before = hits.inside == walk.first ? hits.inside - 1 : L::max(walk.first, sample);
    return hits;
  }

  // Returns the lanes whose bounds are not yet neighbouring parts.
  VOXMELT_WORDS V open(const Hits& hits) { return hits.found & (hits.inside - hits.before > 1); }
  VOXMELT_WORDS void halve(const GroundData& ground, const Row& row, Triple start, V open, Hits& hits) {
    const V middle = (hits.inside + hits.before) >> 1;
    const Triple p = P::select(open, Rays<Arch>::at_part(row, start, middle), Triple{});
    const V in = above(ground, p) < 0;
    hits.inside = (open & in) ? middle : hits.inside;
    hits.before = (open & ~in) ? middle : hits.before;
  }

  VOXMELT_WORDS void finish(const PictureData& data, const Row& row, Triple start, Walk& walk) {
    while (L::any(walk.active)) go(data, walk, over(data, row, start, walk));
  }
  // Returns the place at or before which the ground is entered, to a sample.
  VOXMELT_WORDS Hits march(const PictureData& data, const Row& row, Triple start) {
    Walk the_walk = walk(data, row);
    finish(data, row, start, the_walk);
    return hits_of(the_walk);
  }
  // Does the same for two packets at once, and bisects, too. While one waits for memory, the other goes on.
  template <class Approach>
  VOXMELT_WORDS void march(const PictureData& data, Approach& one, Approach& other) {
    Walk a = walk(data, one.row), b = walk(data, other.row);
    while (L::any(a.active) && L::any(b.active)) {
      const V over_a = over(data, one.row, one.start, a), over_b = over(data, other.row, other.start, b);
      go(data, a, over_a);
      go(data, b, over_b);
    }
    finish(data, one.row, one.start, a);
    finish(data, other.row, other.start, b);
    one.ground = hits_of(a);
    other.ground = hits_of(b);
    for (;;) {
      const V open_a = open(one.ground), open_b = open(other.ground);
      if (!L::any(open_a | open_b)) return;
      halve(data.ground, one.row, one.start, open_a, one.ground);
      halve(data.ground, other.row, other.start, open_b, other.ground);
    }
  }

  VOXMELT_WORDS void bisect(const GroundData& ground, const Row& row, Triple start, Hits& hits) {
    for (V still = open(hits); L::any(still); still = open(hits)) halve(ground, row, start, still, hits);
  }

  // Returns the numbers of picture::Face.
  VOXMELT_WORDS V face_of(const GroundData& ground, V found, V inside, Triple outside) {
    const auto face = [](picture::Face the_face) { return L::set(static_cast<std::int32_t>(the_face)); };
    const auto end = [](std::int64_t cells) { return static_cast<std::int32_t>(cells * picture::kCell - 1); };
    using picture::Face;
    V vector = outside.y < static_cast<std::int32_t>(kLow.y) ? face(Face::under) : face(Face::top);
    vector = outside.z > end(ground.cells.z) ? face(Face::high_z) : vector;
    vector = outside.z < 0 ? face(Face::low_z) : vector;
    vector = outside.x > end(ground.cells.x) ? face(Face::high_x) : vector;
    vector = outside.x < 0 ? face(Face::low_x) : vector;
    return (found & (inside != 0)) ? vector : V{};
  }

  struct Painted {
    Triple normal;
    V color[3];
  };

  // Paints places of the ground. These are the lanes of `found`, and the others may hold anything.
  VOXMELT_WORDS Painted painted(const PictureData& data, V found, V face, Triple position, Triple to_eye) {
    const GroundData& ground = data.ground;
    const auto is = [&](picture::Face the_face) { return face == static_cast<std::int32_t>(the_face); };
    using picture::Face;
    const V top = found & is(Face::top);
    Painted result;
    result.normal = to_eye;
    if (L::any(top)) {
      result = painted_top(data, P::select(top, position, Triple{}));
      if (!L::any(found & ~top)) return result;
      result.normal = P::select(top, result.normal, to_eye);
    }

    constexpr std::int32_t kOne = picture::kLength;
    const V x = is(Face::high_x) & kOne, low_x = is(Face::low_x) & kOne, z = is(Face::high_z) & kOne,
            low_z = is(Face::low_z) & kOne, under = is(Face::under) & kOne;
    const V side = (x | low_x | z | low_z) != 0;
    result.normal = P::select(side | (under != 0), Triple{x - low_x, -under, z - low_z}, result.normal);
    V band{};
    if (ground.bands != nullptr && L::any(side)) {
      const Triple p = P::select(side, position, Triple{});
      const auto along_x = static_cast<std::int32_t>(ground.cells.x - 1),
                 along_z = static_cast<std::int32_t>(ground.cells.z - 1);
      V bend = entry(ground.bends[0], along_z, p.z, 0);
      bend = x != 0 ? entry(ground.bends[1], along_z, p.z, 0) : bend;
      bend = low_z != 0 ? entry(ground.bends[2], along_x, p.x, 0) : bend;
      bend = z != 0 ? entry(ground.bends[3], along_x, p.x, 0) : bend;
      band = side ? entry(ground.bands, ground.band_count - 1, p.y + bend, picture::kBandFineness) : V{};
    }
    const V share = 2540 + ((41 * band) >> 8);
    for (std::size_t c = 0; c < 3; ++c)
      result.color[c] = top ? result.color[c] : (ground.color[c] * share) >> 12;
    return result;
  }

 private:
  VOXMELT_WORDS V entry(const std::int32_t* table, std::int32_t last, V position, int fineness) {
    const Place at = place(position, fineness);
    return blended(L::template gather<4>(table, L::clamp(at.cell, 0, last)),
                   L::template gather<4>(table, L::clamp(at.cell + 1, 0, last)), at.weight);
  }

  VOXMELT_WORDS V rim(V position, std::int64_t cells) {
    constexpr auto kHalf = static_cast<std::int32_t>(picture::kCell / 2);
    const auto near = [](V distance) { return L::max(kHalf - distance, V{}) >> 7; };
    return near(static_cast<std::int32_t>(cells * picture::kCell) - position) - near(position);
  }

  VOXMELT_WORDS Triple top_normal(const PictureData& data, Triple p) {
    const GroundData& ground = data.ground;
    V fall_x = rim(p.x, ground.cells.x), fall_z = rim(p.z, ground.cells.z);
    if (!ground.flat) {
      constexpr auto kHalf = static_cast<std::int32_t>(picture::kCell / 2);
      const auto at = [&](V x, V z) { return height(ground, ground.bare, x, z); };
      fall_x = fall_x + at(p.x - kHalf, p.z) - at(p.x + kHalf, p.z);
      fall_z = fall_z + at(p.x, p.z - kHalf) - at(p.x, p.z + kHalf);
    }
    const Triple a{fall_x, L::set(picture::kHeight), fall_z};
    // Falls take 24 bits at most.
    V more = L::max(L::bits_of(P::largest(a)) - 14, V{});
    Triple b = a;
    for (; L::any(more > 0); more = more - 1) b = P::select(more > 0, b >> 1, b);
    return P::unit(b, data.inverse_root);
  }

  VOXMELT_WORDS Painted painted_top(const PictureData& data, Triple p) {
    const GroundData& ground = data.ground;
    Painted painted;
    painted.normal = top_normal(data, p);
    for (std::size_t c = 0; c < 3; ++c) painted.color[c] = L::set(ground.color[c]);
    if (ground.texels == nullptr) return painted;

    const auto columns = static_cast<std::int32_t>(ground.cells.x << ground.fineness),
               rows = static_cast<std::int32_t>(ground.cells.z << ground.fineness);
    const Place x = place(p.x, ground.fineness), z = place(p.z, ground.fineness);
    const V left = L::clamp(x.cell, 0, columns - 1), right = L::clamp(x.cell + 1, 0, columns - 1);
    const V back = L::clamp(z.cell, 0, rows - 1) * columns,
            front = L::clamp(z.cell + 1, 0, rows - 1) * columns;
    const V at[4] = {back + left, back + right, front + left, front + right};
    V first[4], second[4];
    for (int i = 0; i < 4; ++i) {
      first[i] = L::template gather<8>(ground.texels, at[i]);
      second[i] = L::template gather<8>(ground.texels + 1, at[i]);
    }
    const auto between = [&](const V(&of_four)[4], const auto& part) {
      return blended(blended(part(of_four[0]), part(of_four[1]), x.weight),
                     blended(part(of_four[2]), part(of_four[3]), x.weight), z.weight);
    };
    const auto low = [](V word) { return word & 0xFFFF; };
    painted.color[0] = between(first, low);
    painted.color[1] = between(first, [](V word) { return (word >> 16) & 0xFFFF; });
    painted.color[2] = between(second, low);
    // Bumps are 2^-8, and normals 2^-14.
    const V bump_x = between(second, [](V word) { return ((word << 8) >> 24) << 6; });
    const V bump_z = between(second, [](V word) { return (word >> 24) << 6; });
    painted.normal =
        P::unit({painted.normal.x + bump_x, painted.normal.y, painted.normal.z + bump_z}, data.inverse_root);
    return painted;
  }
};

}  // namespace voxmelt::render
