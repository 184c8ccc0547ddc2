#include "kernel/automaton/state/volume.h"

#include <cstddef>
#include <type_traits>

#include "kernel/automaton/state/fields.h"

namespace voxmelt::state {
namespace {

constexpr std::size_t bytes_of_all_rows() {
  std::size_t bytes = 0;
  for_each_field([&](const auto& row) { bytes += sizeof(Volume{}.*row.column); });
  return bytes;
}
constexpr std::size_t kGridBytes =
    (sizeof(Grid) + alignof(BitPlane) - 1) / alignof(BitPlane) * alignof(BitPlane);
static_assert(sizeof(Volume) == kGridBytes + bytes_of_all_rows() + sizeof(ChangedBricks),
              "a field without a row");

constexpr bool names_fit_a_block() {
  bool fit = true;
  for_each_field([&](const auto& row) { fit = fit && !row.name.empty() && row.name.size() <= 8; });
  return fit;
}
static_assert(names_fit_a_block(), "a name is too long for a checkpoint's block");

}  // namespace

Volume::Volume(Grid size) : grid(size) {
  for_each_field([&](const auto& row) {
    auto& column = this->*row.column;
    if (!row.optional) column = std::remove_reference_t<decltype(column)>(size);
  });
}

bool operator==(const Volume& a, const Volume& b) {
  bool same = a.grid == b.grid;
  for_each_field([&](const auto& row) { same = same && a.*row.column == b.*row.column; });
  return same;
}

void copy_fields(const Volume& from, Volume& to) {
  for_each_field([&](const auto& row) { to.*row.column = from.*row.column; });
}

}  // namespace voxmelt::state
