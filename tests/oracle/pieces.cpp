// Loose pieces of solid fall (docs/automaton.md section 15).
#include "state.h"

#include <cstddef>
#include <vector>

namespace oracle {
namespace {

struct Piece {
  Int number = 0;  // from 1 on
  std::vector<Int> cells;
  bool held = false;
  Int lowest = 0, highest = 0;  // y
};

// The pieces, and for each cell of the grid the number of its piece, 0 for none.
struct Pieces {
  std::vector<Piece> all;
  std::vector<Int> number;
};

// The first four faces are those along x and z.
constexpr Int FACES[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}};

// Finds all that is connected with this cell.
Piece piece_with(const State& state, Int first, Int n, std::vector<Int>& number) {
  Piece piece{n, {first}, false, state.place(first).y, state.place(first).y};
  number[first] = n;
  for (std::size_t k = 0; k < piece.cells.size(); ++k) {
    const Place p = state.place(piece.cells[k]);
    piece.lowest = smaller(piece.lowest, p.y);
    piece.highest = larger(piece.highest, p.y);
    if (p.y == 0) piece.held = true;
    for (const auto& face : FACES) {
      const Int x = p.x + face[0], y = p.y + face[1], z = p.z + face[2];
      if (!state.inside(x, y, z)) continue;  // of the border only the floor holds, see above
      const Int j = state.index(x, y, z);
      if (state.cells[j].inert == 1) piece.held = true;
      if (state.cells[j].solid == 0 || number[j] != 0) continue;
      number[j] = n;
      piece.cells.push_back(j);
    }
  }
  return piece;
}

Pieces find_pieces(const State& state) {
  Pieces pieces;
  pieces.number.resize(state.cells.size(), 0);
  for (const Int i : state.list) {
    if (state.cells[i].solid == 0 || pieces.number[i] != 0) continue;
    const Int n = static_cast<Int>(pieces.all.size()) + 1;
    pieces.all.push_back(piece_with(state, i, n, pieces.number));
  }
  return pieces;
}

bool half_full(const Cell& cell) { return cell.amount >= ONE / 2; }

// Tells whether a loose piece wades: none of its cells lies at y = 0.
bool wades(const State& state, const Piece& piece, const std::vector<Int>& number) {
  Int feet = 0, wet = 0;
  for (const Int i : piece.cells) {
    const Int below = i - state.nx;
    if (number[below] == piece.number) continue;
    ++feet;
    if (half_full(state.cells[below])) ++wet;
  }
  return 2 * wet >= feet;
}

// Holds the cells of a layer, and the pairs beside it: those that are open, and of these the full ones.
struct Layer {
  Int cells = 0, open = 0, full = 0;
};

Layer layer_at(const State& state, const Piece& piece, Int height) {
  Layer layer;
  for (const Int i : piece.cells) {
    const Place p = state.place(i);
    if (p.y != height) continue;
    ++layer.cells;
    for (std::size_t d = 0; d < 4; ++d) {
      const Int x = p.x + FACES[d][0], z = p.z + FACES[d][2];
      if (state.blocked(x, height, z)) continue;  // what is outside the grid is blocked, too
      ++layer.open;
      if (half_full(state.cells[state.index(x, height, z)])) ++layer.full;
    }
  }
  return layer;
}

bool floats(const State& state, const Piece& piece) {
  const Int density = state.parameters.pieces.density;
  if (density == 65536) return false;
  Int sunk = 0;
  for (Int y = piece.lowest; y <= piece.highest; ++y) {
    const Layer layer = layer_at(state, piece, y);
    if (layer.open == 0 || 2 * layer.full < layer.open) break;
    sunk += layer.cells;
  }
  return 65536 * sunk >= density * static_cast<Int>(piece.cells.size());
}

// Tells whether the piece moves in this step, and counts.
bool moves(State& state, const Piece& piece, const std::vector<Int>& number) {
  PieceCounts& counts = state.piece_counts;
  if (piece.held) return false;
  if (!wades(state, piece, number)) {
    ++counts.falls;
    return true;
  }
  if (state.step % state.parameters.pieces.in_liquid != 0) return false;
  if (floats(state, piece)) {
    ++counts.floats;
    return false;
  }
  ++counts.wades;
  return true;
}

// Turns the cells y0 - 1..y1 round, of which `lowest` is the one at y0.
void turn(State& state, const std::vector<bool>& moving, Int lowest) {
  const Cell pushed = state.cells[lowest - state.nx];
  state.touch(lowest - state.nx);
  Int i = lowest;
  for (;;) {
    state.cells[i - state.nx] = state.cells[i];
    if (state.place(i).y == state.ny - 1 || !moving[i + state.nx]) break;
    i += state.nx;
  }
  state.cells[i] = pushed;
}

}  // namespace

void pieces_fall(State& state) {
  const Pieces pieces = find_pieces(state);
  std::vector<bool> moving(state.cells.size(), false);
  for (const Piece& piece : pieces.all) {
    if (!moves(state, piece, pieces.number)) continue;
    for (const Int i : piece.cells) {
      moving[i] = true;
      if (state.cells[i].material != 0) ++state.material_counts.moved;
    }
  }
  for (const Piece& piece : pieces.all)
    for (const Int i : piece.cells)
      if (moving[i] && !moving[i - state.nx]) turn(state, moving, i);
  finish_phase(state, "after pieces fell");
}

}  // namespace oracle
