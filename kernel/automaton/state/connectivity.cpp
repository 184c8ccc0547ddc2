#include "kernel/automaton/state/connectivity.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace voxmelt::state {
namespace {

using Row = std::span<const std::uint64_t>;

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
  std::vector<std::pair<int, int>> news;  // rows that have reached more than their neighbours know
  const auto spread = [&](int y, int z) {
    const std::span<std::uint64_t> reached = attached.row(y, z);
    flood(volume.solid.row(y, z), reached);
    news.emplace_back(y, z);
  };
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const std::span<std::uint64_t> reached = attached.row(y, z);
      seed(volume, y, z, reached);
      for (const std::uint64_t word : reached)
        if (word != 0) {
          spread(y, z);
          break;
        }
    }
  while (!news.empty()) {
    const auto [y, z] = news.back();
    news.pop_back();
    const Row from = attached.row(y, z);
    const auto tell = [&](int beside_y, int beside_z) {
      const Row solid = volume.solid.row(beside_y, beside_z);
      const std::span<std::uint64_t> reached = attached.row(beside_y, beside_z);
      std::uint64_t fresh = 0;
      for (std::size_t w = 0; w < from.size(); ++w) {
        const std::uint64_t more = from[w] & solid[w] & ~reached[w];
        reached[w] |= more;
        fresh |= more;
      }
      if (fresh != 0) spread(beside_y, beside_z);
    };
    if (y > 0) tell(y - 1, z);
    if (y + 1 < g.y) tell(y + 1, z);
    if (z > 0) tell(y, z - 1);
    if (z + 1 < g.z) tell(y, z + 1);
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
