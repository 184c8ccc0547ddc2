// docs/automaton.md section 5: which solid cells see a source, and what they get from it.
//
// The ray is cut into the layers of cells along its longest axis. In a layer it meets few cells, and
// each opaque one is tested by itself. The ray is the set of t in (0, 1) with C + t delta. The cell's
// interior is an open interval of t per axis. The cell blocks if all have a point in common. All numbers
// are exact fractions.
#include <array>
#include <cstddef>
#include <vector>

#include "state.h"

namespace oracle {
namespace {

struct Ray {
  Point from{};                   // C, in sixteenths
  Point delta{};                  // S - C
  std::array<Int, 3> own_cell{};  // the cell of C: never in the way
  std::size_t longest = 0;        // the axis of the greatest |delta|
};

struct Opaque {
  std::vector<Int> cells;                    // 1: solid or inert
  std::array<Int, 3> size{}, low{}, high{};  // the grid, and the box around all opaque cells

  bool at(const std::array<Int, 3>& c) const {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (c[axis] < 0 || c[axis] >= size[axis]) return false;  // outside: transparent
    return cells[(c[2] * size[1] + c[1]) * size[0] + c[0]] == 1;
  }
};

Int magnitude(Int a) { return a < 0 ? -a : a; }

// Is there a t in (0, 1) with C + t delta strictly inside the cell?
bool meets_interior(const Ray& ray, const std::array<Int, 3>& cell) {
  // The open intervals (low / length, high / length) of t; the first is the segment itself.
  Int low[4] = {0}, high[4] = {1}, length[4] = {1};
  std::size_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Int to_lower = 16 * cell[axis] - ray.from[axis];
    const Int to_upper = to_lower + 16;
    const Int d = ray.delta[axis];
    if (d == 0) {
      if (to_lower >= 0 || to_upper <= 0) return false;
      continue;
    }
    low[count] = d > 0 ? to_lower : -to_upper;
    high[count] = d > 0 ? to_upper : -to_lower;
    length[count] = magnitude(d);
    ++count;
  }
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b)
      if (low[a] * length[b] >= high[b] * length[a]) return false;
  return true;
}

// The cell coordinate on an axis where the ray has gone the way `gone` along its longest axis.
Int cell_coordinate(const Ray& ray, std::size_t axis, Int gone) {
  const Int length = magnitude(ray.delta[ray.longest]);
  return floor_divide(ray.from[axis] * length + ray.delta[axis] * gone, 16 * length);
}

bool layer_is_clear(const Opaque& opaque, const Ray& ray, Int layer) {
  const std::size_t main = ray.longest, a = (main + 1) % 3, b = (main + 2) % 3;
  const Int length = magnitude(ray.delta[main]);
  const Int to_lower = 16 * layer - ray.from[main];
  const Int enters = clamp(ray.delta[main] > 0 ? to_lower : -to_lower - 16, 0, length);
  const Int leaves = clamp(ray.delta[main] > 0 ? to_lower + 16 : -to_lower, 0, length);
  const Int a1 = cell_coordinate(ray, a, enters), a2 = cell_coordinate(ray, a, leaves);
  const Int b1 = cell_coordinate(ray, b, enters), b2 = cell_coordinate(ray, b, leaves);
  std::array<Int, 3> cell{};
  cell[main] = layer;
  for (cell[a] = smaller(a1, a2); cell[a] <= larger(a1, a2); ++cell[a])
    for (cell[b] = smaller(b1, b2); cell[b] <= larger(b1, b2); ++cell[b])
      if (opaque.at(cell) && cell != ray.own_cell && meets_interior(ray, cell)) return false;
  return true;
}

bool sees(const Opaque& opaque, const Ray& ray) {
  const std::size_t main = ray.longest;
  const Int end = floor_divide<Int>(ray.from[main] + ray.delta[main], 16);
  const Int first = larger(smaller(ray.own_cell[main], end), opaque.low[main]);
  const Int last = smaller(larger(ray.own_cell[main], end), opaque.high[main]);
  if (ray.delta[main] > 0) {
    for (Int layer = first; layer <= last; ++layer)
      if (!layer_is_clear(opaque, ray, layer)) return false;
  } else {
    for (Int layer = last; layer >= first; --layer)
      if (!layer_is_clear(opaque, ray, layer)) return false;
  }
  return true;
}

Opaque opaque_cells(const State& state) {
  Opaque opaque;
  opaque.size = {state.nx, state.ny, state.nz};
  opaque.low = opaque.size;
  opaque.high = {-1, -1, -1};
  opaque.cells.resize(state.cells.size());
  for (Int z = 0; z < state.nz; ++z)
    for (Int y = 0; y < state.ny; ++y)
      for (Int x = 0; x < state.nx; ++x) {
        const Int i = state.index(x, y, z);
        if (!state.blocked(i)) continue;
        opaque.cells[i] = 1;
        const std::array<Int, 3> cell = {x, y, z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          opaque.low[axis] = smaller(opaque.low[axis], cell[axis]);
          opaque.high[axis] = larger(opaque.high[axis], cell[axis]);
        }
      }
  return opaque;
}

// Position and power of a source at step s, from its keys.
Key key_at(const RadiationSource& source, Int s) {
  const std::vector<Key>& keys = source.keys;
  if (s < keys.front().step) return keys.front();
  for (std::size_t n = 0; n + 1 < keys.size(); ++n) {
    const Key &a = keys[n], &b = keys[n + 1];
    if (s < a.step || s >= b.step) continue;
    const auto between = [&](Int from, Int to) {
      const Sum way = Sum{to - from} * (s - a.step);
      return from + static_cast<Int>(floor_divide<Sum>(way, b.step - a.step));
    };
    Key now;
    for (std::size_t axis = 0; axis < 3; ++axis) now.at[axis] = between(a.at[axis], b.at[axis]);
    now.power = between(a.power, b.power);
    return now;
  }
  return keys.back();
}

Int received(const Opaque& opaque, Place p, const Key& source) {
  Ray ray;
  ray.own_cell = {p.x, p.y, p.z};
  Int facing_axes = 0;
  Int square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.from[axis] = 16 * ray.own_cell[axis] + 8;
    const Int d = source.at[axis] - ray.from[axis];
    ray.delta[axis] = d;
    square += d * d;
    if (magnitude(d) > magnitude(ray.delta[ray.longest])) ray.longest = axis;
    if (d == 0) continue;
    std::array<Int, 3> neighbour = ray.own_cell;
    neighbour[axis] += d > 0 ? 1 : -1;
    if (!opaque.at(neighbour)) ++facing_axes;
  }
  if (facing_axes == 0 || !sees(opaque, ray)) return 0;
  return static_cast<Int>(Sum{source.power} * AXIS_WEIGHT[facing_axes] / (4096 * Sum{larger(square, 256)}));
}

}  // namespace

void find_irradiance(State& state) {
  const Opaque opaque = opaque_cells(state);
  std::vector<Key> sources;
  for (const RadiationSource& source : state.parameters.heat.sources)
    sources.push_back(key_at(source, state.step));
  for (Int& irradiance : state.irradiance) irradiance = 0;
  for (const Int i : state.list) {
    if (state.cells[i].solid == 0) continue;
    for (const Key& source : sources) {
      const Sum sum = Sum{state.irradiance[i]} + received(opaque, state.place(i), source);
      state.irradiance[i] = sum > 65535 ? 65535 : static_cast<Int>(sum);
    }
  }
}

}  // namespace oracle
