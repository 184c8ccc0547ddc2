// A surface tells which faces of the solid cells may look at a source (docs/automaton.md, section 5), by
// words of 64 cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/rule/ray.h"
#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

inline Cell beyond_face(Cell cell, const rule::Face& face) {
  cell[face.axis] += static_cast<int>(face.side);
  return cell;
}

class Surface {
 public:
  using Faces = std::array<std::uint64_t, rule::kFaces>;

  Surface(const state::Grid& grid, rule::SourceKind kind, const rule::SourceKey& source)
      : grid_(grid), kind_(kind), source_(source) {
    const std::size_t words = state::words_for(grid.x);
    up_.assign(words, 0);
    down_.assign(words, 0);
    for (int x = 0; x < grid.x; ++x) {
      const int w = x / 64;
      up_[w] |= std::uint64_t{looks(0, x)} << (x & 63);
      down_[w] |= std::uint64_t{looks(1, x)} << (x & 63);
    }
  }

  // Returns, by the numbers of faces, the solid cells of a word whose face is free and may look.
  Faces faces(const Opaque& opaque, std::size_t w, int y, int z) const {
    const std::uint64_t solid = opaque.solid().row(y, z)[w];
    if (solid == 0) return {};
    const auto row = opaque.plane().row(y, z);
    const std::uint64_t above = row[w] >> 1 | (w + 1 < row.size() ? row[w + 1] << 63 : 0);
    const std::uint64_t below = row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0);
    const auto across = [&](int face, int here, int size, auto&& at) -> std::uint64_t {
      if (!looks(face, here)) return 0;
      const int there = here + (face % 2 == 0 ? 1 : -1);
      return there >= 0 && there < size ? solid & ~at(there) : solid;
    };
    const auto on_y = [&](int there) { return opaque.plane().row(there, z)[w]; };
    const auto on_z = [&](int there) { return opaque.plane().row(y, there)[w]; };
    return {solid & up_[w] & ~above,     solid & down_[w] & ~below,   across(2, y, grid_.y, on_y),
            across(3, y, grid_.y, on_y), across(4, z, grid_.z, on_z), across(5, z, grid_.z, on_z)};
  }

 private:
  bool looks(int face, int coordinate) const {
    return rule::may_look(kind_, source_, rule::face_of(face), coordinate);
  }

  state::Grid grid_;
  rule::SourceKind kind_;
  rule::SourceKey source_;
  std::vector<std::uint64_t> up_, down_;  // cells along x whose upper, or lower, face may look
};

}  // namespace voxmelt::visibility
