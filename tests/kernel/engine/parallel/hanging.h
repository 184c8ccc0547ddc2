// Watches pieces that nothing holds: at every step they have moved down, or half of their feet are wet. They
// are found here by a plain search.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "kernel/automaton/state/connectivity.h"
#include "kernel/run/implementations.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::hanging {

using namespace worlds;

struct Place {
  int x, y, z;
};
using Piece = std::vector<Place>;

inline std::vector<Piece> loose_pieces(const Volume& v) {
  state::BitPlane left = state::loose_solids(v);
  std::vector<Piece> pieces;
  if (left.count() == 0) return pieces;
  for_each(whole(v.grid), [&](int x0, int y0, int z0) {
    if (!left.test(x0, y0, z0)) return;
    Piece piece{{x0, y0, z0}};
    left.set(x0, y0, z0, false);
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto [x, y, z] = piece[i];
      for (const auto& [dx, dy, dz] :
           std::array<Place, 6>{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}}) {
        const Place next{x + dx, y + dy, z + dz};
        if (!v.grid.contains(next.x, next.y, next.z) || !left.test(next.x, next.y, next.z)) continue;
        left.set(next.x, next.y, next.z, false);
        piece.push_back(next);
      }
    }
    pieces.push_back(std::move(piece));
  });
  return pieces;
}

// Tells if less than half of the feet of a piece stand in cells that are half full or more.
inline bool in_the_air(const Volume& v, const Piece& piece) {
  int feet = 0, wet = 0;
  for (const auto& [x, y, z] : piece) {
    if (v.solid.test(x, y - 1, z)) continue;  // of this piece: no two pieces touch
    ++feet;
    wet += v.amount[v.at(x, y - 1, z)] >= 2048 ? 1 : 0;
  }
  return 2 * wet < feet;
}

// Runs a scene and looks at every step. It returns how many pieces it has seen in the air.
inline int watch(const scene::Scene& scene, const Parameters& parameters, int steps) {
  run::Simulation run(parameters, scene.initial, run::implementations().widest(), {.threads = 2});
  run.begin_at(scene.first_step);
  int seen = 0;
  for (int i = 0; i < steps; ++i) {
    std::vector<Piece> falling;
    for (Piece& piece : loose_pieces(run.volume()))
      if (in_the_air(run.volume(), piece)) falling.push_back(std::move(piece));
    run.begin_step();
    for (const Piece& piece : falling) {
      ++seen;
      for (const auto& [x, y, z] : piece)
        if (!run.volume().solid.test(x, y - 1, z)) {
          ADD_FAILURE() << scene.title << ", step " << i << ": a piece of " << piece.size()
                        << " cells hangs at " << x << ' ' << y << ' ' << z;
          return seen;
        }
    }
    for (const step::Phase phase : run.phases()) run.run_phase(phase);
    run.end_step();
  }
  return seen;
}

}  // namespace voxmelt::hanging
