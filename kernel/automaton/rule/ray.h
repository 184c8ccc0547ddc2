// Where the rays of a solid cell begin and end, and what they weigh, for each kind of source
// (docs/automaton.md, section 5).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/rule/visibility.h"

namespace voxmelt::rule {

using Triple = std::array<std::int64_t, 3>;
VOXMELT_RULE Triple triple(const Position& p) { return {p.x, p.y, p.z}; }
VOXMELT_RULE Position position(const Triple& t) { return {t[0], t[1], t[2]}; }
VOXMELT_RULE std::uint64_t squared(const Triple& t) {
  return static_cast<std::uint64_t>(t[0] * t[0] + t[1] * t[1] + t[2] * t[2]);
}

// +x, -x, +y, -y, +z, -z.
inline constexpr int kFaces = 6;
struct Face {
  std::size_t axis;
  std::int64_t side;  // 1 or -1
};
VOXMELT_RULE Face face_of(int number) {
  return {static_cast<std::size_t>(number) / 2, number % 2 == 0 ? 1 : -1};
}

// May a ray of this face be cast, by the cell's coordinate along its axis alone? True wherever one is.
VOXMELT_RULE bool may_look(SourceKind kind, const SourceKey& source, const Face& face, int coordinate) {
  if (kind == SourceKind::sky) return face.axis != 1 || face.side > 0;
  if (kind == SourceKind::directional) return face.side * triple(source.direction)[face.axis] > 0;
  const std::int64_t delta = triple(source.at)[face.axis] - (kPositionUnit * coordinate + kPositionUnit / 2);
  // A place on a sphere's disc is a little farther out than its radius, by rounding (docs/proofs.md).
  const std::int64_t reach = kind == SourceKind::sphere ? source.radius + source.radius / 8 + 1 : 0;
  return face.side * delta + reach > kPositionUnit / 2;
}

// floor(16384 cos((2c + 1) pi / 256))
inline constexpr std::array<std::int64_t, 64> kCosine{
    16382, 16372, 16353, 16323, 16284, 16234, 16175, 16107, 16028, 15940, 15842, 15735, 15618,
    15492, 15357, 15212, 15058, 14895, 14723, 14543, 14353, 14155, 13948, 13733, 13510, 13278,
    13038, 12791, 12536, 12273, 12003, 11726, 11442, 11150, 10853, 10548, 10237, 9920,  9597,
    9268,  8934,  8594,  8249,  7900,  7545,  7186,  6822,  6455,  6083,  5708,  5329,  4948,
    4563,  4175,  3785,  3393,  2998,  2602,  2204,  1805,  1405,  1004,  603,   201};

// A place on a disc of radius 16384: p, q, and its distance from the middle.
struct DiscPlace {
  std::int64_t rho, p, q;
};

// The places of the rays of a face are spread evenly, and turned by its random word.
VOXMELT_RULE DiscPlace disc_place(std::uint64_t word, int ray, int rays) {
  const auto n = static_cast<std::uint64_t>(ray);
  const std::uint64_t reversed = rays == 16  ? (n & 1) << 3 | (n & 2) << 1 | (n & 4) >> 1 | (n & 8) >> 3
                                 : rays == 4 ? (n & 1) << 1 | (n & 2) >> 1
                                             : n;
  const std::uint64_t each = 65536u / static_cast<std::uint64_t>(rays);
  const std::uint64_t u = (word + each * n) & 0xFFFF, v = ((word >> 16) + each * reversed) & 0xFFFF;
  const auto rho = static_cast<std::int64_t>(square_root((2 * v + 1) << 11));
  const std::size_t c = u >> 8 & 63;
  const std::int64_t p = 1 + ((rho * kCosine[c]) >> 14), q = 1 + ((rho * kCosine[63 - c]) >> 14);
  switch (u >> 14) {
    case 0:
      return {rho, p, q};
    case 1:
      return {rho, -q, p};
    case 2:
      return {rho, -p, -q};
    default:
      return {rho, q, -p};
  }
}

// Two vectors of length 16384, upright on each other and on `delta`, which is not 0.
struct DiscAxes {
  Triple g{}, v{};
};
VOXMELT_RULE Triple lengthened(const Triple& t) {
  const auto length = static_cast<std::int64_t>(square_root(squared(t) << 12));
  Triple result{};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t over = t[a] * (std::int64_t{1} << 20);
    result[a] = over / length - (over % length < 0 ? 1 : 0);
  }
  return result;
}
VOXMELT_RULE DiscAxes disc_axes(const Triple& delta) {
  const auto size = [&](std::size_t a) { return delta[a] < 0 ? -delta[a] : delta[a]; };
  std::size_t least = 0;
  for (std::size_t a = 1; a < 3; ++a)
    if (size(a) < size(least)) least = a;
  const std::size_t next = (least + 1) % 3, last = (least + 2) % 3;
  Triple across{};
  across[next] = delta[last];
  across[last] = -delta[next];
  DiscAxes axes{lengthened(across), {}};
  const Triple towards = lengthened(delta);
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    axes.v[a] = (towards[b] * axes.g[c] - towards[c] * axes.g[b]) >> 14;
  }
  return axes;
}

// The first of start + way, start + 2 way, ... that has left the grid. `way` leads out of the grid, or along
// its border, where `start` lies on the border.
VOXMELT_RULE Position leaving(const Triple& start, const Triple& way, const std::array<int, 3>& grid) {
  std::int64_t k = INT64_MAX;
  for (std::size_t a = 0; a < 3; ++a) {
    if (way[a] == 0) continue;
    const std::int64_t room = way[a] > 0 ? kPositionUnit * grid[a] - start[a] : start[a];
    const std::int64_t each = way[a] > 0 ? way[a] : -way[a];
    k = std::min(k, std::max<std::int64_t>(1, (room + each - 1) / each));
  }
  return {start[0] + k * way[0], start[1] + k * way[1], start[2] + k * way[2]};
}

// What the rays of all cells have in common.
struct RaySetting {
  std::array<int, 3> grid{};
  int side = 1;  // a face has side x side rays
  RoundKeys keys{};

  constexpr int rays() const { return side * side; }
};
constexpr RaySetting ray_setting(const std::array<int, 3>& grid, const Heat& heat) {
  return {grid,
          heat.rays_per_face == 16  ? 4
          : heat.rays_per_face == 4 ? 2
                                    : 1,
          round_keys(heat.ray_seed, kRayWord)};
}

// The rays of one cell to one source.
class CellRays {
 public:
  constexpr CellRays(const RaySetting& setting, SourceKind kind, const SourceKey& source,
                     const std::array<int, 3>& cell)
      : setting_(setting), kind_(kind), source_(source), cell_(cell) {
    const Triple at = triple(source.at);
    for (std::size_t a = 0; a < 3; ++a) {
      middle_[a] = kPositionUnit * cell[a] + kPositionUnit / 2;
      delta_[a] = at[a] - middle_[a];
    }
    if (kind == SourceKind::sphere && squared(delta_) > 0) axes_ = disc_axes(delta_);
  }

  // The face whose rays are asked for next.
  constexpr void choose(int number) {
    face_ = face_of(number);
    if (kind_ != SourceKind::sphere && kind_ != SourceKind::sky) return;
    const auto [nx, ny, nz] = setting_.grid;
    const auto index = (static_cast<std::uint64_t>(cell_[2]) * static_cast<std::uint64_t>(ny) +
                        static_cast<std::uint64_t>(cell_[1])) *
                           static_cast<std::uint64_t>(nx) +
                       static_cast<std::uint64_t>(cell_[0]);
    word_ =
        random_block(setting_.keys, static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(index));
  }

  // The start of ray side x i + j.
  constexpr Position start(int i, int j) const {
    Triple from{};
    const std::int64_t square = kPositionUnit / setting_.side;
    from[face_.axis] = middle_[face_.axis] + face_.side * (kPositionUnit / 2);
    from[next()] = middle_[next()] - kPositionUnit / 2 + square * i + square / 2;
    from[last()] = middle_[last()] - kPositionUnit / 2 + square * j + square / 2;
    return position(from);
  }

  struct Ray {
    std::int64_t weight = 0;  // 0: it is not cast
    Position end;
  };
  constexpr Ray ray(int n, const Position& from) const {
    switch (kind_) {
      case SourceKind::point:
        return to(source_.at);
      case SourceKind::sphere:
        return to_disc(disc_place(word_, n, setting_.rays()));
      case SourceKind::directional: {
        const Triple way = triple(source_.direction);
        const std::int64_t weight = face_.side * way[face_.axis];
        if (weight <= 0) return {};
        return {weight, leaving(triple(from), way, setting_.grid)};
      }
      case SourceKind::sky: {
        const Triple way = sky_way(disc_place(word_, n, setting_.rays()));
        if (way[1] <= 0) return {};
        return {1, leaving(triple(from), way, setting_.grid)};
      }
    }
    return {};
  }

  // What the cell receives: `sum` adds the weights of all rays that see the source.
  constexpr std::uint64_t receives(std::int64_t sum) const {
    if (sum == 0) return 0;
    constexpr std::uint64_t one_cell = kPositionUnit * kPositionUnit;
    const auto weight = static_cast<std::uint64_t>(sum);
    const auto rays = static_cast<std::uint64_t>(setting_.rays());
    if (kind_ == SourceKind::sky) return quotient(source_.power, weight, one_cell * rays);
    if (kind_ == SourceKind::directional) {
      const std::uint64_t length = square_root(squared(triple(source_.direction)) << 12);
      return quotient(source_.power, 64 * weight, one_cell * rays * length);
    }
    const auto radius = static_cast<std::uint64_t>(kind_ == SourceKind::sphere ? source_.radius : 0);
    return irradiance(source_.power, sum, setting_.rays(), std::max(squared(delta_), radius * radius));
  }

 private:
  constexpr std::size_t next() const { return (face_.axis + 1) % 3; }
  constexpr std::size_t last() const { return (face_.axis + 2) % 3; }

  // Ends that are not beyond the plane of the face are none.
  constexpr Ray to(const Position& end) const {
    const std::int64_t weight = face_.side * (triple(end)[face_.axis] - middle_[face_.axis]);
    if (weight <= kPositionUnit / 2) return {};
    return {weight, end};
  }
  constexpr Ray to_disc(const DiscPlace& place) const {
    if (squared(delta_) == 0) return {};
    Triple end = triple(source_.at);
    for (std::size_t a = 0; a < 3; ++a)
      end[a] += (source_.radius * (place.p * axes_.g[a] + place.q * axes_.v[a])) >> 28;
    return to(position(end));
  }
  constexpr Triple sky_way(const DiscPlace& place) const {
    const auto height = static_cast<std::int64_t>(
        square_root((std::uint64_t{1} << 28) - static_cast<std::uint64_t>(place.rho * place.rho)));
    Triple way{};
    way[face_.axis] = face_.side * height;
    way[next()] = place.p;
    way[last()] = place.q;
    return way;
  }
  static constexpr std::uint64_t quotient(std::uint64_t power, std::uint64_t by, std::uint64_t under) {
    __extension__ using Wide = unsigned __int128;
    return static_cast<std::uint64_t>(Wide{power} * by / under);
  }

  const RaySetting& setting_;
  SourceKind kind_;
  const SourceKey& source_;
  std::array<int, 3> cell_;
  Triple middle_{}, delta_{};
  DiscAxes axes_{};
  Face face_{};
  std::uint64_t word_ = 0;
};

}  // namespace voxmelt::rule
