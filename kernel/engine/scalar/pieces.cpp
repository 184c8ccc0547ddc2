#include "kernel/engine/scalar/pieces.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "kernel/automaton/rule/pieces.h"
#include "kernel/automaton/state/bit_plane.h"

namespace voxmelt::scalar {
namespace {

struct Place {
  int x, y, z;
};
constexpr Place kFaces[] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}};
constexpr int kSides = 4;  // the first of them

struct Piece {
  std::vector<Place> cells;
  bool held = false;
};

// Finds the piece of this cell, and marks its cells as seen.
Piece piece_of(const state::Volume& volume, Place start, state::BitPlane& seen) {
  Piece piece{{start}};
  seen.set(start.x, start.y, start.z, true);
  for (std::size_t next = 0; next < piece.cells.size(); ++next) {
    const Place at = piece.cells[next];
    piece.held |= at.y == 0;
    for (const Place& face : kFaces) {
      const Place to{at.x + face.x, at.y + face.y, at.z + face.z};
      if (!volume.grid.contains(to.x, to.y, to.z)) continue;
      piece.held |= volume.inert.test(to.x, to.y, to.z);
      if (!volume.solid.test(to.x, to.y, to.z) || seen.test(to.x, to.y, to.z)) continue;
      seen.set(to.x, to.y, to.z, true);
      piece.cells.push_back(to);
    }
  }
  return piece;
}

template <class Visit>
void for_each_loose_piece(const state::Volume& volume, const Visit& visit) {
  const state::Grid grid = volume.grid;
  state::BitPlane seen(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        if (!volume.solid.test(x, y, z) || seen.test(x, y, z)) continue;
        const Piece piece = piece_of(volume, {x, y, z}, seen);
        if (!piece.held) visit(piece);
      }
}

rule::PieceCounts count(const state::Volume& volume, const Piece& piece) {
  struct Layer {
    std::int64_t cells = 0, open = 0, full = 0;
  };
  std::map<int, Layer> layers;  // by height
  rule::PieceCounts counts;
  counts.cells = static_cast<std::int64_t>(piece.cells.size());
  for (const Place& at : piece.cells) {
    Layer& layer = layers[at.y];
    ++layer.cells;
    // A cell beside or below a loose piece is open if it is no part of it.
    if (!volume.solid.test(at.x, at.y - 1, at.z)) {
      ++counts.feet;
      counts.wet += volume.amount[volume.at(at.x, at.y - 1, at.z)] >= rule::kWet;
    }
    for (int side = 0; side < kSides; ++side) {
      const int x = at.x + kFaces[side].x, z = at.z + kFaces[side].z;
      if (!volume.grid.contains(x, at.y, z) || volume.solid.test(x, at.y, z)) continue;
      ++layer.open;
      layer.full += volume.amount[volume.at(x, at.y, z)] >= rule::kWet;
    }
  }
  for (const auto& [y, layer] : layers) {
    if (!rule::is_under_surface(layer.open, layer.full)) break;
    counts.sunk += layer.cells;
  }
  return counts;
}

// Writes memory only if something changes.
void move(state::Field<std::uint16_t>& field, state::Slot to, std::uint16_t value) {
  if (field[to] != value) field[to] = value;
}

// Turns cells y0 - 1 .. y1 of a column round once.
void turn(state::Volume& volume, int x, int y0, int y1, int z) {
  for (auto* plane : {&volume.solid, &volume.liquid}) {
    const bool below = plane->test(x, y0 - 1, z);
    for (int y = y0; y <= y1; ++y) plane->set(x, y - 1, z, plane->test(x, y, z));
    plane->set(x, y1, z, below);
  }
  for (auto* field : {&volume.amount, &volume.energy, &volume.heat}) {
    const std::uint16_t below = (*field)[volume.at(x, y0 - 1, z)];
    for (int y = y0; y <= y1; ++y) move(*field, volume.at(x, y - 1, z), (*field)[volume.at(x, y, z)]);
    move(*field, volume.at(x, y1, z), below);
  }
  if (volume.material.empty()) return;
  for (int y = y0; y <= y1; ++y)
    volume.material[volume.at(x, y - 1, z)] = volume.material[volume.at(x, y, z)];
  volume.material[volume.at(x, y1, z)] = 0;  // of the liquid, or of air
}

void turn_columns(state::Volume& volume, const state::BitPlane& moving) {
  const state::Grid grid = volume.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      for (int y = 1; y < grid.y; ++y) {
        const int first = y;
        while (y < grid.y && moving.test(x, y, z)) ++y;
        if (y > first) turn(volume, x, first, y - 1, z);
      }
}

}  // namespace

std::optional<state::BitPlane> falling_cells(const rule::Pieces& pieces, std::uint32_t step,
                                             const state::Volume& volume) {
  state::BitPlane moving(volume.grid);
  bool any = false;
  for_each_loose_piece(volume, [&](const Piece& piece) {
    if (!rule::piece_moves(count(volume, piece), pieces, step)) return;
    for (const Place& at : piece.cells) moving.set(at.x, at.y, at.z, true);
    any = true;
  });
  if (!any) return {};
  return moving;
}

std::int64_t loose_cells(const state::Volume& volume) {
  std::int64_t cells = 0;
  for_each_loose_piece(volume,
                       [&](const Piece& piece) { cells += static_cast<std::int64_t>(piece.cells.size()); });
  return cells;
}

bool let_pieces_fall(const rule::Pieces& pieces, std::uint32_t step, state::Volume& volume) {
  const std::optional<state::BitPlane> moving = falling_cells(pieces, step, volume);
  if (moving) turn_columns(volume, *moving);
  return moving.has_value();
}

}  // namespace voxmelt::scalar
