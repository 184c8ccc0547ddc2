// Vents, drains and the path of a moving heat source are computed in integers, in sixteenths of a cell.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

VOXMELT_RULE bool contains(const Region& region, int x, int y, int z) {
  const std::int64_t dx = kPositionUnit * x + 8 - region.at.x, dy = kPositionUnit * y + 8 - region.at.y,
                     dz = kPositionUnit * z + 8 - region.at.z;
  return dx * dx + dy * dy + dz * dz <= region.radius * region.radius;
}

VOXMELT_RULE bool is_open(std::uint32_t from, std::uint32_t until, std::uint32_t step) {
  return from <= step && step < until;
}

// Returns the amount that a vent adds to, or a drain takes from, a cell that holds `amount`.
VOXMELT_RULE std::int32_t vented(std::int32_t amount, std::int32_t rate) {
  return std::min(rate, kAmountMax - amount);
}
VOXMELT_RULE std::int32_t drained(std::int32_t amount, std::int32_t rate) { return std::min(rate, amount); }

// Returns the energy of freshly vented liquid. `energy` is per kOne.
VOXMELT_RULE std::int32_t vented_energy(std::int32_t added, std::int32_t energy) {
  return (added * energy) >> 12;
}

// Returns a + floor((b - a) i / n), where 0 <= i < n < 2^32. The difference is divided into a quotient and a
// remainder by n. Then no product exceeds 64 bits, whatever a and b are.
VOXMELT_RULE std::int64_t between(std::int64_t a, std::int64_t b, std::int64_t i, std::int64_t n) {
  const std::int64_t difference = b - a;
  const std::int64_t whole = difference / n - (difference % n < 0 ? 1 : 0);
  const std::uint64_t rest = difference - whole * n;
  return a + whole * i + (rest * i / n);
}

VOXMELT_RULE Position between(const Position& a, const Position& b, std::int64_t i, std::int64_t n) {
  return {between(a.x, b.x, i, n), between(a.y, b.y, i, n), between(a.z, b.z, i, n)};
}

// Returns the numbers of a source at a step.
inline SourceKey source_at(const HeatSource& source, std::uint32_t step) {
  const auto& keys = source.keys;
  if (step <= keys.front().step) return keys.front();
  if (step >= keys.back().step) return keys.back();
  std::size_t k = 0;
  while (keys[k + 1].step <= step) ++k;
  const SourceKey &a = keys[k], &b = keys[k + 1];
  const std::int64_t i = step - a.step, n = b.step - a.step;
  return {step, between(a.at, b.at, i, n), static_cast<std::uint64_t>(between(a.power, b.power, i, n)),
          between(a.radius, b.radius, i, n), between(a.direction, b.direction, i, n)};
}

}  // namespace voxmelt::rule
