#include "kernel/automaton/state/digest.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::state {
namespace {

constexpr bool every_bit_has_its_place() {
  std::uint64_t taken = 0;
  bool fits = true;
  for_each_field([&](const auto& row) {
    const std::uint64_t bits = ((std::uint64_t{1} << row.bits) - 1) << row.digest_bit;
    fits = fits && row.digest_bit + row.bits <= 64 && (taken & bits) == 0;
    taken |= bits;
  });
  return fits;
}
static_assert(every_bit_has_its_place(), "two fields share a bit of a cell's word");

// 64 cells along x, or those up to the end of the row.
struct Chunk {
  std::size_t word;
  int first, count;
};
using Packed = std::array<std::uint64_t, 64>;

bool any_in(const BitPlane& plane, int y, int z, const Chunk& chunk) {
  return plane.row(y, z)[chunk.word] != 0;
}
template <class T>
bool any_in(const Field<T>& field, int y, int z, const Chunk& chunk) {
  const T* cells = field.row(y, z) + chunk.first;
  unsigned bits = 0;
  for (int i = 0; i < chunk.count; ++i) bits |= cells[i];
  return bits != 0;
}

void pack(const BitPlane& plane, int y, int z, const Chunk& chunk, int at, Packed& packed) {
  const std::uint64_t word = plane.row(y, z)[chunk.word];
  for (std::size_t i = 0; i < packed.size(); ++i) packed[i] |= (word >> i & 1u) << at;
}
template <class T>
void pack(const Field<T>& field, int y, int z, const Chunk& chunk, int at, Packed& packed) {
  const T* cells = field.row(y, z) + chunk.first;  // rows end at multiples of 64 cells
  for (std::size_t i = 0; i < packed.size(); ++i) packed[i] |= std::uint64_t{cells[i]} << at;
}

}  // namespace

std::uint64_t digest(const Volume& volume) {
  const Grid g = volume.grid;
  std::uint64_t sum = 0;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int first = 0; first < g.x; first += 64) {
        const Chunk chunk{static_cast<std::size_t>(first) / 64, first, std::min(64, g.x - first)};
        bool any = false;
        for_each_field([&](const auto& row) {
          const auto& column = volume.*row.column;
          any = any || (!column.empty() && any_in(column, y, z, chunk));
        });
        if (!any) continue;
        Packed packed{};
        for_each_field([&](const auto& row) {
          const auto& column = volume.*row.column;
          if (!column.empty()) pack(column, y, z, chunk, row.digest_bit, packed);
        });
        for (int i = 0; i < chunk.count; ++i)
          sum += cell_digest(g.index(first + i, y, z), packed[static_cast<std::size_t>(i)]);
      }
  return sum;
}

}  // namespace voxmelt::state
