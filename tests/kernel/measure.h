// These functions measure what a picture would show: columns, roughness, spreading, motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "tests/kernel/worlds.h"

namespace voxmelt::worlds {

// Holds the liquid per column, in cells, [z][x].
struct Heights {
  int nx, nz;
  std::vector<double> h;
  double operator()(int x, int z) const { return h[static_cast<std::size_t>(z * nx + x)]; }
  double highest() const { return *std::max_element(h.begin(), h.end()); }
};
inline Heights heights(const Volume& v) {
  Heights result{v.grid.x, v.grid.z, std::vector<double>(static_cast<std::size_t>(v.grid.x * v.grid.z))};
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (v.liquid.test(x, y, z))
      result.h[static_cast<std::size_t>(z * v.grid.x + x)] += v.amount[v.at(x, y, z)] / 4096.0;
  });
  return result;
}

// Returns the checkerboard number: the mean of |height - mean of its four neighbours|, in cells, off the
// border.
inline double roughness(const Heights& h) {
  double sum = 0;
  for (int z = 1; z + 1 < h.nz; ++z)
    for (int x = 1; x + 1 < h.nx; ++x)
      sum += std::abs(h(x, z) - (h(x - 1, z) + h(x + 1, z) + h(x, z - 1) + h(x, z + 1)) / 4);
  return sum / ((h.nx - 2) * (h.nz - 2));
}

struct Spread {
  double radius;      // root of the second moment of the height, about the grid's middle
  double anisotropy;  // |a4 - 1|, a4 = 1 + (2/3) sum h (r^4 - 8 x^2 y^2) / sum h r^4
};
inline Spread spread_of(const Heights& h) {
  double sum = 0, r2_sum = 0, r4_sum = 0, four = 0;
  for (int z = 0; z < h.nz; ++z)
    for (int x = 0; x < h.nx; ++x) {
      const double dx = x - (h.nx - 1) / 2.0, dz = z - (h.nz - 1) / 2.0, r2 = dx * dx + dz * dz;
      sum += h(x, z);
      r2_sum += h(x, z) * r2;
      r4_sum += h(x, z) * r2 * r2;
      four += h(x, z) * (r2 * r2 - 8 * dx * dx * dz * dz);
    }
  return {std::sqrt(r2_sum / sum), std::abs(2.0 / 3 * four / r4_sum)};
}

inline std::int32_t largest_amount(const Volume& v) {
  std::int32_t largest = 0;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (v.liquid.test(x, y, z)) largest = std::max<std::int32_t>(largest, v.amount[v.at(x, y, z)]);
  });
  return largest;
}
template <class Which>  // which(amount, x, y, z)
int count_liquid(const Volume& v, Which&& which) {
  int count = 0;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (v.liquid.test(x, y, z)) count += which(std::int32_t{v.amount[v.at(x, y, z)]}, x, y, z);
  });
  return count;
}
inline int dust(const Volume& v, std::int32_t below) {
  return count_liquid(v, [&](std::int32_t a, int, int, int) { return a < below; });
}

// Counts those of the next n steps in which any amount changed.
inline int moving_steps(run::Simulation& s, int n) {
  int moving = 0;
  for (int i = 0; i < n; ++i) {
    const state::Field<std::uint16_t> before = s.volume().amount;
    s.step();
    moving += !(before == s.volume().amount);
  }
  return moving;
}

// Puts a ball of liquid on the floor in the middle of the grid. Under the paper's law it has full energy.
inline void put_ball(Volume& v, double radius, bool energetic, int floor = 0) {
  const double cx = (v.grid.x - 1) / 2.0, cy = floor + radius - 0.5, cz = (v.grid.z - 1) / 2.0;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (std::hypot(x - cx, y - cy, z - cz) <= radius) put(v, x, y, z, kOne, energetic ? kOne : 0);
  });
}
// Puts a flat round puddle of some depth in cells.
inline void put_disc(Volume& v, double radius, double depth, std::int32_t energy = 0) {
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (std::hypot(x - (v.grid.x - 1) / 2.0, z - (v.grid.z - 1) / 2.0) > radius) return;
    const auto a = static_cast<std::int32_t>(std::clamp(depth - y, 0.0, 1.0) * kOne);
    if (a > 0) put(v, x, y, z, a, std::min(a, energy));
  });
}

// Makes two shafts of 3 x 3, joined by a tunnel 3 high. One is filled 21 high, the other 3. At one level,
// both would be 12 high.
inline Volume u_tube() {
  Volume v(Grid{11, 30, 5});
  fill_inert(v, whole(v.grid));
  for (const Box& shaft : {Box{1, 1, 1, 4, 29, 4}, Box{7, 1, 1, 10, 29, 4}, Box{4, 1, 1, 7, 4, 4}})
    for_each(shaft, [&](int x, int y, int z) {
      v.inert.set(x, y, z, false);
      put(v, x, y, z, y < (x < 4 ? 22 : 4) ? kOne : 0);
    });
  return v;
}

}  // namespace voxmelt::worlds
