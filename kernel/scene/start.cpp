#include "kernel/scene/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/scene/npy.h"

namespace voxmelt::scene {
namespace {

state::BitPlane read_mask(const std::filesystem::path& file, state::Grid grid, const Place& place) {
  const std::vector<std::uint16_t> cells = read_npy(file, 1, grid, place);
  state::BitPlane mask(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        const std::uint16_t value = cells[grid.index(x, y, z)];
        if (value > 1)
          fail_at(place,
                  fmt::format("{}: cell ({}, {}, {}) is {}, not 0 or 1", file.string(), x, y, z, value));
        mask.set(x, y, z, value == 1);
      }
  return mask;
}

state::Field<std::uint16_t> read_field(const std::filesystem::path& file, state::Grid grid,
                                       const Place& place) {
  const std::vector<std::uint16_t> cells = read_npy(file, 2, grid, place);
  state::Field<std::uint16_t> field(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x)
        if (const std::uint16_t value = cells[grid.index(x, y, z)]; value != 0)
          field[field.layout().at(x, y, z)] = value;
  return field;
}

// Exports of version 0.1 call the field `temperature`.
std::filesystem::path heat_file(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "heat.npy", old = folder / "temperature.npy";
  return !std::filesystem::exists(file) && std::filesystem::exists(old) ? old : file;
}

bool is_empty(const state::Volume& volume, int y, int z) {
  const auto zero = [](std::uint64_t value) { return value == 0; };
  const auto row = static_cast<std::size_t>(volume.grid.x);
  for (const state::BitPlane* mask : {&volume.solid, &volume.liquid, &volume.inert})
    if (!std::ranges::all_of(mask->row(y, z), zero)) return false;
  for (const auto* field : {&volume.amount, &volume.energy, &volume.heat})
    if (!std::all_of(field->row(y, z), field->row(y, z) + row, zero)) return false;
  return true;
}

// The first invariant that a cell breaks, or nothing.
const char* broken_promise(const state::Volume& volume, int x, int y, int z) {
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
  return nullptr;
}

}  // namespace

state::Volume read_fields(const std::filesystem::path& folder, state::Grid grid, const Place& place) {
  state::Volume volume(grid);
  volume.solid = read_mask(folder / "solid.npy", grid, place);
  volume.liquid = read_mask(folder / "liquid.npy", grid, place);
  volume.inert = read_mask(folder / "inert.npy", grid, place);
  volume.amount = read_field(folder / "amount.npy", grid, place);
  volume.energy = read_field(folder / "energy.npy", grid, place);
  volume.heat = read_field(heat_file(folder), grid, place);
  if (const std::string broken = first_broken(volume); !broken.empty())
    fail_at(place, folder.string() + ": " + broken);
  return volume;
}

std::string first_broken(const state::Volume& volume) {
  const state::Grid grid = volume.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y) {
      if (is_empty(volume, y, z)) continue;
      for (int x = 0; x < grid.x; ++x)
        if (const char* promise = broken_promise(volume, x, y, z))
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
          if (heat[64 * w + static_cast<std::size_t>(std::countr_zero(left))] > 0) return true;
    }
  return false;
}

std::vector<std::string> drop_unused(state::Volume& volume, const rule::Parameters& parameters) {
  std::vector<std::string> dropped;
  const auto drop = [&](state::Field<std::uint16_t>& field, const char* what, const char* why) {
    const auto cells = std::ranges::count_if(field.stored(), [](std::uint16_t value) { return value != 0; });
    if (cells > 0)
      dropped.push_back(
          fmt::format("start.fields: {} of {} cell{} dropped: {}", what, cells, cells == 1 ? "" : "s", why));
    field.clear();
  };
  if (parameters.flow.law == rule::Law::viscous)
    drop(volume.energy, "energy", "the viscous law has no energy");
  if (!parameters.heat.enabled) drop(volume.heat, "heat", "the scene has no [heat]");
  return dropped;
}

}  // namespace voxmelt::scene
