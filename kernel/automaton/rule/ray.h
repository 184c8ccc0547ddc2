// The rays of a solid cell begin, end and weigh as computed here, for a source of any kind
// (docs/automaton.md, section 5).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/random.h"
#include "kernel/automaton/rule/ray_geometry.h"
#include "kernel/automaton/rule/source_kinds.h"

namespace voxmelt::rule {

// Tells if a ray of this face may be cast, by the cell's coordinate along its axis alone. It is true wherever
// a ray is cast.
VOXMELT_RULE bool may_look(SourceKind kind, const SourceKey& source, const Face& face, int coordinate) {
  return with_kind(kind, [&](auto one) { return one.may_look(source, face, coordinate); });
}

// Computes the rays of one cell to one source.
class CellRays {
 public:
  using Ray = SightRay;

  constexpr CellRays(const RaySetting& setting, SourceKind kind, const SourceKey& source,
                     const std::array<int, 3>& cell)
      : sight_{.setting = setting, .source = source}, kind_(kind), cell_(cell) {
    const Triple at = triple(source.at);
    for (std::size_t a = 0; a < 3; ++a) {
      sight_.middle[a] = kPositionUnit * cell[a] + kPositionUnit / 2;
      sight_.delta[a] = at[a] - sight_.middle[a];
    }
    with_kind(kind, [&](auto one) { one.prepare(sight_); });
  }

  // Chooses the face whose rays are asked for next.
  constexpr void choose(int number) {
    sight_.face = face_of(number);
    if (!with_kind(kind_, [](auto one) { return one.kTurns; })) return;
    const auto [nx, ny, nz] = sight_.setting.grid;
    const std::uint64_t z = cell_[2], index = (z * ny + cell_[1]) * nx + cell_[0];
    sight_.word = random_block(sight_.setting.keys, number, static_cast<std::uint32_t>(index));
  }

  // Returns the start of ray side x i + j.
  constexpr Position start(int i, int j) const {
    Triple from{};
    const std::int64_t square = kPositionUnit / sight_.setting.side;
    const Face& face = sight_.face;
    const std::size_t next = sight_.next(), last = sight_.last();
    from[face.axis] = sight_.middle[face.axis] + face.side * (kPositionUnit / 2);
    from[next] = sight_.middle[next] - kPositionUnit / 2 + square * i + square / 2;
    from[last] = sight_.middle[last] - kPositionUnit / 2 + square * j + square / 2;
    return position(from);
  }

  constexpr Ray ray(int n, const Position& from) const {
    return with_kind(kind_, [&](auto one) { return one.ray(sight_, n, from); });
  }

  // Returns the irradiance that the cell receives. `sum` adds the weights of all rays that see the source.
  constexpr std::uint64_t receives(std::int64_t sum) const {
    if (sum == 0) return 0;
    return with_kind(kind_, [&](auto one) { return one.receives(sight_, sum); });
  }

 private:
  Sight sight_;
  SourceKind kind_;
  std::array<int, 3> cell_;
};

}  // namespace voxmelt::rule
