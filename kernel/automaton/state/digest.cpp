#include "kernel/automaton/state/digest.h"

#include <algorithm>
#include <cstddef>
#include <tuple>
#include <utility>

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

// Returns the cells of a row from its first one on. It is null for an optional field that the volume lacks.
const std::uint64_t* row_of(const BitPlane& plane, int y, int z) {
  return plane.empty() ? nullptr : plane.row(y, z).data();
}
template <class T>
const T* row_of(const Field<T>& field, int y, int z) {
  return field.empty() ? nullptr : field.row(y, z);
}

// Tells if any of `count` cells from x = 64 w on is not 0.
bool any_of(const std::uint64_t* mask, std::size_t w, int /*bits past the grid are 0*/) {
  return mask[w] != 0;
}
template <class T>
bool any_of(const T* numbers, std::size_t w, int count) {
  unsigned bits = 0;
  for (int i = 0; i < count; ++i) bits |= numbers[64 * w + i];
  return bits != 0;
}

std::uint64_t value_of(const std::uint64_t* mask, std::size_t w, int bit) { return mask[w] >> bit & 1u; }
template <class T>
std::uint64_t value_of(const T* numbers, std::size_t w, int bit) {
  return numbers[64 * w + bit];
}

template <std::size_t i>
constexpr bool kOptional = std::get<i>(kFields).optional;

template <std::size_t... i>
std::uint64_t row_digest(const Volume& volume, int y, int z, std::index_sequence<i...>) {
  const Grid g = volume.grid;
  const std::tuple rows{row_of(volume.*std::get<i>(kFields).column, y, z)...};
  std::uint64_t sum = 0;
  for (int first = 0; first < g.x; first += 64) {
    const std::size_t w = first / 64;
    const int count = std::min(64, g.x - first);
    const auto any = [&]<std::size_t k>() {
      return (!kOptional<k> || std::get<k>(rows) != nullptr) && any_of(std::get<k>(rows), w, count);
    };
    if (!(any.template operator()<i>() || ...)) continue;
    const auto bits = [&]<std::size_t k>(int bit) {
      if (kOptional<k> && std::get<k>(rows) == nullptr) return std::uint64_t{0};
      return value_of(std::get<k>(rows), w, bit) << std::get<k>(kFields).digest_bit;
    };
    for (int bit = 0; bit < count; ++bit)
      sum += cell_digest(g.index(first + bit, y, z), (bits.template operator()<i>(bit) | ...));
  }
  return sum;
}

}  // namespace

std::uint64_t digest(const Volume& volume) {
  constexpr std::make_index_sequence<std::tuple_size_v<decltype(kFields)>> all;
  std::uint64_t sum = 0;
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y) sum += row_digest(volume, y, z, all);
  return sum;
}

}  // namespace voxmelt::state
