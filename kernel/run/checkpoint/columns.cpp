#include "kernel/run/checkpoint/columns.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::checkpoint {
namespace {

constexpr std::size_t kSlab = std::size_t{4} << 20;  // bytes that a block has at most, or one slice

std::size_t row_bytes(const state::BitPlane& plane, state::Grid) {
  return plane.row_words() * sizeof(std::uint64_t);
}
template <class T>
std::size_t row_bytes(const state::Field<T>&, state::Grid grid) {
  return grid.x * sizeof(T);
}
template <class Column>
auto* row_of(Column& column, int y, int z) {
  if constexpr (requires { column.row(y, z).data(); }) {
    return column.row(y, z).data();
  } else {
    return column.row(y, z);
  }
}

int slices_of_a_slab(std::size_t row, state::Grid grid) {
  const std::size_t slice = row * grid.y;
  return static_cast<int>(std::clamp<std::size_t>(kSlab / slice, 1, static_cast<std::size_t>(grid.z)));
}

// Is a slab of a column: its first slice, and the number of slices.
struct Slab {
  int first = 0, count = 0;
  BlockName name(std::string_view kind) const {
    return {std::string(kind), static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count)};
  }
};
std::vector<Slab> slabs_of(std::size_t row, state::Grid grid) {
  const int slices = slices_of_a_slab(row, grid);
  std::vector<Slab> slabs;
  for (int z = 0; z < grid.z; z += slices) slabs.push_back({z, std::min(slices, grid.z - z)});
  return slabs;
}

// Packs a slab. An empty slab is found in place, without a copy.
template <class Column>
Packed pack(const Column& column, state::Grid grid, const Slab& slab) {
  const std::size_t row = row_bytes(column, grid);
  const std::size_t bytes = row * grid.y * slab.count;
  const auto empty = [row](const auto* from) {
    const auto* at = reinterpret_cast<const char*>(from);
    return at[0] == 0 && std::memcmp(at, at + 1, row - 1) == 0;
  };
  int y = 0, z = slab.first;
  while (z < slab.first + slab.count && empty(row_of(column, y, z)))
    if (++y == grid.y) {
      y = 0;
      ++z;
    }
  if (z == slab.first + slab.count) return {bytes, {}};
  Bytes raw(bytes);
  std::byte* to = raw.data();
  for (z = slab.first; z < slab.first + slab.count; ++z)
    for (y = 0; y < grid.y; ++y, to += row) std::memcpy(to, row_of(column, y, z), row);
  return packed(raw);
}

template <class Column>
void put(BlockWriter& writer, cpu::Workers& workers, std::string_view kind, const Column& column,
         state::Grid grid) {
  const std::vector<Slab> slabs = slabs_of(row_bytes(column, grid), grid);
  const std::size_t at_once = 2 * workers.threads();
  std::vector<Packed> blocks(at_once);
  for (std::size_t begin = 0; begin < slabs.size(); begin += at_once) {
    const std::size_t count = std::min(at_once, slabs.size() - begin);
    workers.run(static_cast<int>(count), [&](int i) {
      const std::size_t k = i;
      blocks[k] = pack(column, grid, slabs[begin + k]);
    });
    for (std::size_t k = 0; k < count; ++k) writer.put(slabs[begin + k].name(kind), blocks[k]);
  }
}

template <class Column>
Column take(BlockReader& reader, std::string_view kind, state::Grid grid) {
  Column column(grid);
  const std::size_t row = row_bytes(column, grid);
  Bytes raw;
  for (const Slab& slab : slabs_of(row, grid)) {
    raw.resize(row * grid.y * slab.count);
    if (reader.next_is_empty(slab.name(kind), raw)) continue;
    const std::byte* from = raw.data();
    for (int z = slab.first; z < slab.first + slab.count; ++z)
      for (int y = 0; y < grid.y; ++y, from += row) {
        const bool empty = from[0] == std::byte{0} && std::memcmp(from, from + 1, row - 1) == 0;
        if (!empty) std::memcpy(row_of(column, y, z), from, row);  // if not, the page stays without memory
      }
  }
  return column;
}

}  // namespace

void put_volume(BlockWriter& writer, cpu::Workers& workers, const state::Volume& volume) {
  state::for_each_field([&](const auto& row) {
    const auto& column = volume.*row.column;
    if (!column.empty()) put(writer, workers, row.name, column, volume.grid);
  });
}

state::Volume take_volume(BlockReader& reader, state::Grid grid) {
  state::Volume volume;
  volume.grid = grid;
  state::for_each_field([&](const auto& row) {
    if (row.optional && !reader.next_is(row.name)) return;
    auto& column = volume.*row.column;
    column = take<std::remove_reference_t<decltype(column)>>(reader, row.name, grid);
  });
  return volume;
}

void put_field(BlockWriter& writer, cpu::Workers& workers, std::string_view kind,
               const state::Field<std::uint16_t>& field, state::Grid grid) {
  put(writer, workers, kind, field, grid);
}

state::Field<std::uint16_t> take_field(BlockReader& reader, std::string_view kind, state::Grid grid) {
  return take<state::Field<std::uint16_t>>(reader, kind, grid);
}

}  // namespace voxmelt::checkpoint
