// Visibility tells which rays see their source, and what the cells get from it (docs/automaton.md section 5).
//
// A ray is cut into the layers of cells along its longest axis. In a layer it meets few cells, and each
// opaque one of them is tested by itself. The ray is the set of t in (0, 1) with start + t delta. The cell's
// interior is an open interval of t per axis. They must have a point in common. All numbers are exact
// fractions. A ray may start on the border of a cell. The test needs no exception for that, nor for the ray's
// own cell.
#include "kinds.h"

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace oracle {
namespace {

struct Ray {
  Point from{};             // its start on a face, in sixteenths
  Point delta{};            // from there to its end
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

// Tells if there is a t in (0, 1) with from + t delta strictly inside the cell.
bool meets_interior(const Ray& ray, const std::array<Int, 3>& cell) {
  // The open intervals of t are (low / length, high / length). The first is the segment itself.
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

// Returns the cell coordinate on an axis, when the ray has gone the way `gone` along its longest axis.
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

Ray ray_between(const Point& from, const Point& to) {
  Ray ray;
  ray.from = from;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.delta[axis] = to[axis] - from[axis];
    if (magnitude(ray.delta[axis]) > magnitude(ray.delta[ray.longest])) ray.longest = axis;
  }
  return ray;
}

// Holds a source at one step.
struct Light {
  const Kind& kind;
  Key now;
};

// Returns N of section 5: the sum of w over all rays of the cell that see the source.
Int seen(const State& state, const Opaque& opaque, const Light& light, const Turns& turns, Int cell) {
  const Place p = state.place(cell);
  const Int R = state.parameters.heat.rays_per_face;
  Int N = 0;
  for (Int f = 0; f < 6; ++f) {
    const Face face = face_of(p, f);
    if (opaque.at(face.beyond)) continue;  // not free
    for (Int n = 0; n < R; ++n) {
      const Look look{start_of(face, n, R), face, light.now, turns, {cell, f, n, R}, opaque.size};
      const std::optional<Cast> cast = light.kind.cast(look);
      if (cast && sees(opaque, ray_between(look.start, cast->end))) N += cast->weight;
    }
  }
  return N;
}

}  // namespace

void find_irradiance(State& state) {
  const Opaque opaque = opaque_cells(state);
  const Turns turns(state.parameters.seed);
  const Int R = state.parameters.heat.rays_per_face;
  std::vector<Light> lights;
  for (const RadiationSource& source : state.parameters.heat.sources)
    lights.push_back({*source.kind, key_at(source, state.step)});
  for (Int& irradiance : state.irradiance) irradiance = 0;
  for (const Int i : state.list) {
    const Cell& cell = state.cells[i];
    if (cell.solid == 0) continue;
    const Point centre = centre_of(state.place(i));
    Int sum = 0;
    for (const Light& light : lights) {
      const Int N = seen(state, opaque, light, turns, i);
      if (N == 0) continue;
      const Sum more = sum + light.kind.received(light.now, centre, N, R);
      sum = more > 65535 ? 65535 : static_cast<Int>(more);
    }
    // The cell takes in all of it, so that less matter warms faster.
    state.irradiance[i] = smaller(65535, ONE * sum / cell.amount);
  }
}

}  // namespace oracle
