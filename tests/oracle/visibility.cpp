// docs/automaton.md section 5: which faces of solid cells see a source, and what the cells get from it.
//
// A ray is cut into the layers of cells along its longest axis. In a layer it meets few cells; each opaque
// one of them is tested by itself: the ray, as the set of t in (0, 1) with start + t delta, and the cell's
// interior, as an open interval of t per axis, have a point in common. All numbers are exact fractions.
// A ray may start on the border of a cell; the test needs no exception for that, nor for the ray's own cell.
#include <array>
#include <cstddef>
#include <vector>

#include "state.h"

namespace oracle {
namespace {

struct Ray {
  Point from{};             // its start on a face, in sixteenths
  Point delta{};            // from there to the source
  std::size_t longest = 0;  // the axis of the greatest |delta|
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

// Is there a t in (0, 1) with from + t delta strictly inside the cell?
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
      if (opaque.at(cell) && meets_interior(ray, cell)) return false;
  return true;
}

bool sees(const Opaque& opaque, const Ray& ray) {
  const std::size_t main = ray.longest;
  const Int start = floor_divide<Int>(ray.from[main], 16);
  const Int end = floor_divide<Int>(ray.from[main] + ray.delta[main], 16);
  const Int first = larger(smaller(start, end), opaque.low[main]);
  const Int last = smaller(larger(start, end), opaque.high[main]);
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

Ray ray_between(const Point& from, const Point& to) {
  Ray ray;
  ray.from = from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.delta[axis] = to[axis] - from[axis];
    if (magnitude(ray.delta[axis]) > magnitude(ray.delta[ray.longest])) ray.longest = axis;
  }
  return ray;
}

// How many of the m x m rays see the source that start at the face whose centre is given, across `axis`.
Int seeing_rays(const Opaque& opaque, const Point& face, std::size_t axis, Int m, const Point& source) {
  const std::size_t a = (axis + 1) % 3, b = (axis + 2) % 3;
  Int count = 0;
  Point start = face;
  for (Int i = 0; i < m; ++i)
    for (Int j = 0; j < m; ++j) {
      start[a] = face[a] - 8 + (16 * i + 8) / m;
      start[b] = face[b] - 8 + (16 * j + 8) / m;
      if (sees(opaque, ray_between(start, source))) ++count;
    }
  return count;
}

Int received(const Opaque& opaque, Place p, const Key& source, Int rays_per_face) {
  const std::array<Int, 3> own_cell = {p.x, p.y, p.z};
  const Int m = square_root(rays_per_face);
  Point centre{}, delta{};
  Int square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis] = 16 * own_cell[axis] + 8;
    delta[axis] = source.at[axis] - centre[axis];
    square += delta[axis] * delta[axis];
  }
  Int N = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Int ahead = delta[axis] > 0 ? 1 : -1;
    std::array<Int, 3> neighbour = own_cell;
    neighbour[axis] += ahead;
    if (magnitude(delta[axis]) <= 8 || opaque.at(neighbour)) continue;  // this face does not look
    Point face = centre;
    face[axis] += 8 * ahead;
    N += seeing_rays(opaque, face, axis, m, source.at) * magnitude(delta[axis]);
  }
  if (N == 0) return 0;
  const Int d2 = larger(square, 256);
  const Sum divisor = Sum{rays_per_face} * d2 * square_root(4096 * d2);
  return static_cast<Int>(64 * Sum{source.power} * N / divisor);
}

}  // namespace

void find_irradiance(State& state) {
  const Opaque opaque = opaque_cells(state);
  const Int rays = state.parameters.heat.rays_per_face;
  std::vector<Key> sources;
  for (const RadiationSource& source : state.parameters.heat.sources)
    sources.push_back(key_at(source, state.step));
  for (Int& irradiance : state.irradiance) irradiance = 0;
  for (const Int i : state.list) {
    if (state.cells[i].solid == 0) continue;
    for (const Key& source : sources) {
      const Sum sum = Sum{state.irradiance[i]} + received(opaque, state.place(i), source, rays);
      state.irradiance[i] = sum > 65535 ? 65535 : static_cast<Int>(sum);
    }
  }
}

}  // namespace oracle
