// Each kind of heat source has a struct here (docs/automaton.md, section 5). It tells where the rays of a
// face end, their weights, and the irradiance of a cell. A new kind is a row of kSourceKinds, a struct here,
// and its place in `SourceKinds`.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/ray_geometry.h"
#include "kernel/automaton/rule/visibility.h"

namespace voxmelt::rule {

// Holds a ray's end and weight. A ray with a weight of 0 is not cast.
struct SightRay {
  std::int64_t weight = 0;
  Position end;
};

// Holds the data on which the rays of a cell to a source depend.
struct Sight {
  const RaySetting& setting;
  const SourceKey& source;
  Triple middle{}, delta{};  // the cell's middle; vector from there to `at` of the source
  DiscAxes axes{};           // set if the kind prepares them
  Face face{};
  std::uint64_t word = 0;  // the random word of cell and face, for kinds whose rays are turned

  constexpr std::size_t next() const { return (face.axis + 1) % 3; }
  constexpr std::size_t last() const { return (face.axis + 2) % 3; }

  // Makes a ray to an end beyond the plane of the face. Any other end gives no ray.
  constexpr SightRay to(const Position& end) const {
    const std::int64_t weight = face.side * (triple(end)[face.axis] - middle[face.axis]);
    if (weight <= kPositionUnit / 2) return {};
    return {weight, end};
  }
};

// Tells if an end at most `reach` before `at` may lie beyond the plane of the face.
VOXMELT_RULE bool may_reach(const SourceKey& source, const Face& face, int coordinate, std::int64_t reach) {
  const std::int64_t delta = triple(source.at)[face.axis] - (kPositionUnit * coordinate + kPositionUnit / 2);
  return face.side * delta + reach > kPositionUnit / 2;
}

// Returns floor(power by / under).
VOXMELT_RULE std::uint64_t quotient(std::uint64_t power, std::uint64_t by, std::uint64_t under) {
  __extension__ using Wide = unsigned __int128;
  return static_cast<std::uint64_t>(Wide{power} * by / under);
}
inline constexpr std::uint64_t kOneCell = kPositionUnit * kPositionUnit;  // squared distance of one cell

// Each kind has:
//   kTurns      its rays are turned by random bits
//   may_look    a ray of this face may be cast, by the cell's coordinate along its axis alone; true wherever
//               one is cast
//   prepare     once for a cell
//   ray         ray n of the face, from `start`
//   receives    the cell's irradiance; the rays that see the source weigh `sum` > 0 together

struct PointSource {
  static constexpr bool kTurns = false;
  VOXMELT_RULE static bool may_look(const SourceKey& source, const Face& face, int coordinate) {
    return may_reach(source, face, coordinate, 0);
  }
  VOXMELT_RULE static void prepare(Sight&) {}
  VOXMELT_RULE static SightRay ray(const Sight& sight, int, const Position&) {
    return sight.to(sight.source.at);
  }
  VOXMELT_RULE static std::uint64_t receives(const Sight& sight, std::int64_t sum) {
    return irradiance(sight.source.power, sum, sight.setting.rays(), squared(sight.delta));
  }
};

struct SphereSource {
  static constexpr bool kTurns = true;
  // By rounding, a place on the sphere's disc may be a little farther out than its radius (docs/proofs.md).
  VOXMELT_RULE static std::int64_t reach(const SourceKey& source) {
    return source.radius + source.radius / 8 + 1;
  }
  VOXMELT_RULE static bool may_look(const SourceKey& source, const Face& face, int coordinate) {
    return may_reach(source, face, coordinate, reach(source));
  }
  VOXMELT_RULE static void prepare(Sight& sight) {
    if (squared(sight.delta) > 0) sight.axes = disc_axes(sight.delta);
  }
  VOXMELT_RULE static SightRay ray(const Sight& sight, int n, const Position&) {
    if (squared(sight.delta) == 0) return {};
    const DiscPlace place = disc_place(sight.word, n, sight.setting.rays());
    Triple end = triple(sight.source.at);
    for (std::size_t a = 0; a < 3; ++a)
      end[a] += (sight.source.radius * (place.p * sight.axes.g[a] + place.q * sight.axes.v[a])) >> 28;
    return sight.to(position(end));
  }
  VOXMELT_RULE static std::uint64_t receives(const Sight& sight, std::int64_t sum) {
    const std::uint64_t radius = sight.source.radius;
    return irradiance(sight.source.power, sum, sight.setting.rays(),
                      std::max(squared(sight.delta), radius * radius));
  }
};

struct DirectionalSource {
  static constexpr bool kTurns = false;
  VOXMELT_RULE static bool may_look(const SourceKey& source, const Face& face, int) {
    return face.side * triple(source.direction)[face.axis] > 0;
  }
  VOXMELT_RULE static void prepare(Sight&) {}
  VOXMELT_RULE static SightRay ray(const Sight& sight, int, const Position& start) {
    const Triple way = triple(sight.source.direction);
    const std::int64_t weight = sight.face.side * way[sight.face.axis];
    if (weight <= 0) return {};
    return {weight, leaving(triple(start), way, sight.setting.grid)};
  }
  VOXMELT_RULE static std::uint64_t receives(const Sight& sight, std::int64_t sum) {
    const std::uint64_t length = square_root(squared(triple(sight.source.direction)) << 12);
    return quotient(sight.source.power, std::uint64_t{64} * sum, kOneCell * sight.setting.rays() * length);
  }
};

struct SkySource {
  static constexpr bool kTurns = true;
  VOXMELT_RULE static bool may_look(const SourceKey&, const Face& face, int) {
    return face.axis != 1 || face.side > 0;
  }
  VOXMELT_RULE static void prepare(Sight&) {}
  VOXMELT_RULE static SightRay ray(const Sight& sight, int n, const Position& start) {
    const DiscPlace place = disc_place(sight.word, n, sight.setting.rays());
    const std::int64_t height = square_root((std::uint64_t{1} << 28) - (place.rho * place.rho));
    Triple way{};
    way[sight.face.axis] = sight.face.side * height;
    way[sight.next()] = place.p;
    way[sight.last()] = place.q;
    if (way[1] <= 0) return {};
    return {1, leaving(triple(start), way, sight.setting.grid)};
  }
  VOXMELT_RULE static std::uint64_t receives(const Sight& sight, std::int64_t sum) {
    return quotient(sight.source.power, sum, kOneCell * sight.setting.rays());
  }
};

// The kinds are in the order of SourceKind.
using SourceKinds = std::tuple<PointSource, SphereSource, DirectionalSource, SkySource>;
static_assert(std::tuple_size_v<SourceKinds> == kSourceKinds.size(), "a kind without rays, or without a row");
static_assert(
    [] {
      for (std::size_t i = 0; i < kSourceKinds.size(); ++i)
        if (index_of(kSourceKinds[i].kind) != i) return false;
      return true;
    }(),
    "the rows are in the order of SourceKind");

// Calls visit(kind) with the struct of a kind.
template <std::size_t i = 0, class Visit>
[[gnu::always_inline]] constexpr auto with_kind(SourceKind kind, const Visit& visit) {
  if constexpr (i + 1 < std::tuple_size_v<SourceKinds>) {
    if (index_of(kind) != i) return with_kind<i + 1>(kind, visit);
  }
  return visit(std::tuple_element_t<i, SourceKinds>{});
}

}  // namespace voxmelt::rule
