#include "kernel/automaton/state/connectivity.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace voxmelt::state {
namespace {

using Row = std::span<const std::uint64_t>;

bool is_clear(Row row) {
  return std::ranges::all_of(row, [](std::uint64_t word) { return word == 0; });
}

// Floods a row of solids from the bits of `reached` on, both ways.
void flood(Row solid, std::span<std::uint64_t> reached) {
  std::uint64_t carry = 0;
  for (std::size_t w = 0; w < solid.size(); ++w) {
    const std::uint64_t s = solid[w], from = reached[w] | (s & carry);
    const std::uint64_t sum = s + from;  // flips each run of ones from its first seed on
    carry = sum < s ? 1 : 0;
    reached[w] = from | ((sum ^ s) & s);
  }
  carry = 0;
  for (std::size_t w = solid.size(); w-- > 0;) {
    std::uint64_t open = solid[w], all = reached[w] | (open & carry << 63);
    for (int by = 1; by < 64; by *= 2) {
      all |= open & all >> by;
      open &= open >> by;
    }
    reached[w] = all;
    carry = all & 1;
  }
}

// Marks the solids that stand on the bottom or on an inert cell of their row or of a row beside it.
void seed(const Volume& volume, int y, int z, std::span<std::uint64_t> reached) {
  const Grid g = volume.grid;
  const Row solid = volume.solid.row(y, z), inert = volume.inert.row(y, z);
  const std::size_t last = solid.size() - 1;
  for (std::size_t w = 0; w <= last; ++w) {
    std::uint64_t holds = y == 0 ? ~std::uint64_t{0} : inert[w] << 1 | inert[w] >> 1;
    if (w > 0) holds |= inert[w - 1] >> 63;
    if (w < last) holds |= inert[w + 1] << 63;
    if (y > 0) holds |= volume.inert.row(y - 1, z)[w];
    if (y + 1 < g.y) holds |= volume.inert.row(y + 1, z)[w];
    if (z > 0) holds |= volume.inert.row(y, z - 1)[w];
    if (z + 1 < g.z) holds |= volume.inert.row(y, z + 1)[w];
    reached[w] = solid[w] & holds;
  }
}

}  // namespace

BitPlane loose_solids(const Volume& volume) {
  const Grid g = volume.grid;
  BitPlane attached(g);
  std::vector<std::uint8_t> news(static_cast<std::size_t>(g.y) * g.z);  // rows whose neighbours know less
  std::vector<std::size_t> later;  // those of them that the sweep has passed
  bool sweeping = true;
  const auto spread = [&](int y, int z) {
    flood(volume.solid.row(y, z), attached.row(y, z));
    const std::size_t row = static_cast<std::size_t>(z) * g.y + y;
    news[row] = 1;
    if (!sweeping) later.push_back(row);
  };
  const auto tell = [&](Row from, int y, int z) {
    const Row solid = volume.solid.row(y, z);
    const std::span<std::uint64_t> reached = attached.row(y, z);
    std::uint64_t fresh = 0;
    for (std::size_t w = 0; w < from.size(); ++w) {
      const std::uint64_t more = from[w] & solid[w] & ~reached[w];
      reached[w] |= more;
      fresh |= more;
    }
    if (fresh != 0) spread(y, z);
  };
  const auto tell_all = [&](std::size_t row) {
    if (std::exchange(news[row], 0) == 0) return;
    const int y = static_cast<int>(row % g.y), z = static_cast<int>(row / g.y);
    const Row from = attached.row(y, z);
    if (y > 0) tell(from, y - 1, z);
    if (y + 1 < g.y) tell(from, y + 1, z);
    if (z > 0) tell(from, y, z - 1);
    if (z + 1 < g.z) tell(from, y, z + 1);
  };
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const std::span<std::uint64_t> reached = attached.row(y, z);
      if (is_clear(volume.solid.row(y, z))) continue;
      seed(volume, y, z, reached);
      if (!is_clear(reached)) spread(y, z);
    }
  // Most bodies stand on the ground, so that a sweep reaches nearly all of them.
  for (std::size_t row = 0; row < news.size(); ++row) tell_all(row);
  sweeping = false;
  for (std::size_t row = news.size(); row-- > 0;) tell_all(row);
  while (!later.empty()) {
    const std::size_t row = later.back();
    later.pop_back();
    tell_all(row);
  }
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const Row solid = volume.solid.row(y, z);
      const std::span<std::uint64_t> row = attached.row(y, z);
      for (std::size_t w = 0; w < row.size(); ++w) row[w] = solid[w] & ~row[w];
    }
  return attached;
}

}  // namespace voxmelt::state
