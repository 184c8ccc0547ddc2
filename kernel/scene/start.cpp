#include "kernel/scene/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/state/fields.h"
#include "kernel/scene/npy.h"

namespace voxmelt::scene {
namespace {

using Cells = std::vector<std::uint16_t>;

void take(const Cells& cells, state::Grid grid, state::BitPlane& mask, const std::filesystem::path& file,
          const Place& place) {
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        const std::uint16_t value = cells[grid.index(x, y, z)];
        if (value > 1)
          fail_at(place,
                  fmt::format("{}: cell ({}, {}, {}) is {}, not 0 or 1", file.string(), x, y, z, value));
        mask.set(x, y, z, value == 1);
      }
}
template <class T>
void take(const Cells& cells, state::Grid grid, state::Field<T>& field,
          const std::filesystem::path& /*any number is one*/, const Place& /*likewise*/) {
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) state::set_value(field, x, y, z, cells[grid.index(x, y, z)]);
}

// Returns the file of a field. Exports of version 0.1 call `heat` `temperature`.
std::filesystem::path file_of(const std::filesystem::path& folder, std::string_view field) {
  const std::filesystem::path file = folder / fmt::format("{}.npy", field), old = folder / "temperature.npy";
  const bool is_old = field == "heat" && !std::filesystem::exists(file) && std::filesystem::exists(old);
  return is_old ? old : file;
}

bool is_empty_row(const state::BitPlane& mask, int y, int z, int /*padding is 0*/) {
  return std::ranges::all_of(mask.row(y, z), [](std::uint64_t word) { return word == 0; });
}
template <class T>
bool is_empty_row(const state::Field<T>& field, int y, int z, int width) {
  return std::all_of(field.row(y, z), field.row(y, z) + width, [](T value) { return value == 0; });
}

bool is_empty(const state::Volume& volume, int y, int z) {
  bool empty = true;
  state::for_each_field([&](const auto& row) {
    const auto& column = volume.*row.column;
    empty = empty && (column.empty() || is_empty_row(column, y, z, volume.grid.x));
  });
  return empty;
}

std::int64_t cells_with_something(const state::BitPlane& mask) { return mask.count(); }
template <class T>
std::int64_t cells_with_something(const state::Field<T>& field) {
  return std::ranges::count_if(field.stored(), [](T value) { return value != 0; });
}

// Returns the first invariant that a cell breaks, or null.
const char* broken_promise(const state::Volume& volume, std::size_t materials, int x, int y, int z) {
  const state::Slot cell = volume.at(x, y, z);
  const bool solid = volume.solid.test(x, y, z), liquid = volume.liquid.test(x, y, z),
             inert = volume.inert.test(x, y, z);
  const int amount = volume.amount[cell];
  if (solid + liquid + inert > 1) return "at most one of solid, liquid and inert";
  if (inert && amount >= rule::kOne) return "a bed offset of inert below a whole cell";
  if (!inert && !solid && liquid != (amount > 0))
    return "liquid exactly where there is an amount, neither solid nor inert";
  if (solid && amount == 0) return "no solid without an amount";
  if (solid && volume.energy[cell] != 0) return "no energy in solids";
  if (volume.energy[cell] > amount) return "energy not more than the amount";
  if (!solid && !liquid && volume.energy[cell] != 0) return "no energy without solid or liquid";
  if (amount == 0 && volume.heat[cell] != 0) return "no heat without an amount";
  if (volume.material.empty()) return nullptr;
  if (!solid && volume.material[cell] != 0) return "no material but in solids";
  if (volume.material[cell] >= materials) return "a material of the scene";
  return nullptr;
}

}  // namespace

state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place) {
  state::Volume volume(grid);
  state::for_each_field([&](const auto& row) {
    const std::filesystem::path file = file_of(folder, row.name);
    if (row.optional && !std::filesystem::exists(file)) return;
    auto& column = volume.*row.column;
    if (row.optional) column = std::remove_reference_t<decltype(column)>(grid);
    take(read_npy(file, row.bits > 8 ? 65535 : 255, grid, place), grid, column, file, place);
  });
  if (const std::string broken = first_broken(volume); !broken.empty())
    fail_at(place, folder.string() + ": " + broken);
  return volume;
}

std::string first_broken(const state::Volume& volume, std::size_t materials) {
  const state::Grid grid = volume.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y) {
      if (is_empty(volume, y, z)) continue;
      for (int x = 0; x < grid.x; ++x)
        if (const char* promise = broken_promise(volume, materials, x, y, z))
          return fmt::format("cell ({}, {}, {}) breaks a rule: {}", x, y, z, promise);
    }
  return {};
}

bool has_walls(const state::Volume& volume) {
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y) {
      const auto inert = volume.inert.row(y, z);
      const std::uint16_t* heat = volume.heat.row(y, z);
      for (std::size_t w = 0; w < inert.size(); ++w)
        for (std::uint64_t left = inert[w]; left != 0; left &= left - 1)
          if (heat[64 * w + std::countr_zero(left)] > 0) return true;
    }
  return false;
}

std::vector<std::string> fit_fields(state::Volume& volume, const rule::Parameters& parameters) {
  std::vector<std::string> dropped;
  state::for_each_field([&](const auto& row) {
    if (row.present == nullptr) return;
    auto& column = volume.*row.column;
    using Column = std::remove_reference_t<decltype(column)>;
    if (row.present(parameters)) {
      if (column.empty()) column = Column(volume.grid);
      return;
    }
    if (column.empty()) return;
    if (const std::int64_t cells = cells_with_something(column); cells > 0)
      dropped.push_back(fmt::format("start.fields: {} of {} cell{} dropped: {}", row.name, cells,
                                    cells == 1 ? "" : "s", row.missing));
    if (row.optional)
      column = {};
    else
      column.clear();
  });
  return dropped;
}

}  // namespace voxmelt::scene
