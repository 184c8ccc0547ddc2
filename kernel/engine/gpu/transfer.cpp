#include "kernel/engine/gpu/transfer.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::gpu {
namespace {

constexpr std::uint8_t kSolid = 1, kInert = 2;
constexpr int kMaterialShift = 4;

template <class Visit>  // visit(y, z, place of the first cell)
void for_each_row(const Shape& shape, const Visit& visit) {
  for (int z = 0; z < shape.grid.z; ++z)
    for (int y = 0; y < shape.grid.y; ++y) visit(y, z, shape.at(0, y, z));
}

bool bit(std::span<const std::uint64_t> row, int x) {
  return (row[static_cast<std::size_t>(x) / 64] >> (x & 63) & 1) != 0;
}

// Writes a row of a plane, and memory only where a word changes.
template <class Test>
void put_row(std::span<std::uint64_t> row, int nx, const Test& test) {
  for (std::size_t w = 0; w < row.size(); ++w) {
    std::uint64_t word = 0;
    const int begin = static_cast<int>(64 * w), end = std::min(nx, begin + 64);
    for (int x = begin; x < end; ++x) word |= std::uint64_t{test(x)} << (x - begin);
    if (row[w] != word) row[w] = word;
  }
}

template <class T, class Number>
void put_row(T* row, int nx, const Number& number) {
  for (int x = 0; x < nx; ++x)
    if (const auto value = static_cast<T>(number(x)); row[x] != value) row[x] = value;
}

}  // namespace

Packed packed(const state::Volume& volume, const Shape& shape) {
  const auto cells = static_cast<std::size_t>(shape.cells);
  Packed to{std::vector<std::uint8_t>(cells, kInert), std::vector<std::uint16_t>(cells, rule::kBedHalf),
            std::vector<std::uint16_t>(cells), std::vector<std::uint16_t>(cells)};
  const int nx = shape.grid.x;
  for_each_row(shape, [&](int y, int z, std::size_t at) {
    const auto solid = volume.solid.row(y, z), inert = volume.inert.row(y, z);
    for (int x = 0; x < nx; ++x) {
      int flags = (bit(solid, x) ? kSolid : 0) | (bit(inert, x) ? kInert : 0);
      if (!volume.material.empty()) flags |= volume.material.row(y, z)[x] << kMaterialShift;
      to.flags[at + static_cast<std::size_t>(x)] = static_cast<std::uint8_t>(flags);
    }
    std::copy_n(volume.amount.row(y, z), nx, to.amount.begin() + static_cast<std::ptrdiff_t>(at));
    std::copy_n(volume.energy.row(y, z), nx, to.energy.begin() + static_cast<std::ptrdiff_t>(at));
    std::copy_n(volume.heat.row(y, z), nx, to.heat.begin() + static_cast<std::ptrdiff_t>(at));
  });
  return to;
}

std::vector<std::uint16_t> packed(const step::Irradiance& irradiance, const Shape& shape) {
  std::vector<std::uint16_t> to(static_cast<std::size_t>(shape.cells));
  for_each_row(shape, [&](int y, int z, std::size_t at) {
    std::copy_n(irradiance.row(y, z), shape.grid.x, to.begin() + static_cast<std::ptrdiff_t>(at));
  });
  return to;
}

void unpack(const std::vector<std::uint16_t>& numbers, const Shape& shape, step::Irradiance& irradiance) {
  for_each_row(shape, [&](int y, int z, std::size_t at) {
    put_row(irradiance.row(y, z), shape.grid.x,
            [&](int x) { return numbers[at + static_cast<std::size_t>(x)]; });
  });
}

PackedWords packed_words(const step::Irradiance& irradiance, const state::ChangedRows& rows,
                         const Shape& shape) {
  PackedWords to;
  for (const state::ChangedRow& row : rows)
    for (std::uint64_t words = row.words; words != 0; words &= words - 1) {
      const int x = kWordCells * std::countr_zero(words);
      to.places.push_back(static_cast<std::int32_t>(shape.at(x, row.y, row.z)));
      const std::uint16_t* const from = irradiance.row(row.y, row.z) + x;
      to.numbers.insert(to.numbers.end(), from, from + kWordCells);
    }
  return to;
}

void unpack_masks(const std::vector<std::uint8_t>& flags, const Shape& shape, state::Volume& volume) {
  for_each_row(shape, [&](int y, int z, std::size_t at) {
    const std::uint8_t* from = flags.data() + at;
    put_row(volume.solid.row(y, z), shape.grid.x, [&](int x) { return (from[x] & kSolid) != 0; });
    put_row(volume.inert.row(y, z), shape.grid.x, [&](int x) { return (from[x] & kInert) != 0; });
  });
}

void unpack(const Packed& from, const Shape& shape, state::Volume& volume) {
  unpack_masks(from.flags, shape, volume);
  const int nx = shape.grid.x;
  for_each_row(shape, [&](int y, int z, std::size_t at) {
    const std::uint8_t* flags = from.flags.data() + at;
    const std::uint16_t* amount = from.amount.data() + at;
    put_row(volume.liquid.row(y, z), nx,
            [&](int x) { return (flags[x] & (kSolid | kInert)) == 0 && amount[x] > 0; });
    put_row(volume.amount.row(y, z), nx, [&](int x) { return amount[x]; });
    if (!from.energy.empty())
      put_row(volume.energy.row(y, z), nx, [&](int x) { return from.energy[at + x]; });
    if (!from.heat.empty()) put_row(volume.heat.row(y, z), nx, [&](int x) { return from.heat[at + x]; });
    if (!volume.material.empty())
      put_row(volume.material.row(y, z), nx, [&](int x) { return flags[x] >> kMaterialShift; });
  });
}

}  // namespace voxmelt::gpu
