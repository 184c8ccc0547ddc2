#include "kernel/run/io/vdb.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "kernel/automaton/rule/materials.h"
#include "kernel/run/io/file_writer.h"
#include "kernel/vdb/helper.h"
#include "kernel/vdb/stream.h"

namespace voxmelt::io {
namespace {

using Words = std::array<std::uint64_t, vdb::kCells / 64>;

// Holds which cells of a brick are what. Bits are places in the brick.
struct Masks {
  Words solid{}, liquid{}, inert{};
};

// Says which cells of a brick are active in a grid, and what their numbers are.
struct GridOf {
  const char* name;
  double unit;
  bool is_fog;
  Words (*cells)(const Masks& masks);
  bool (*is_there)(const Moment& moment);
  std::uint16_t (*number)(const Moment& moment, const rule::Materials* materials, state::Slot slot);
};

Words either(const Words& a, const Words& b) {
  Words both;
  std::ranges::transform(a, b, both.begin(), [](std::uint64_t x, std::uint64_t y) { return x | y; });
  return both;
}
Words matter(const Masks& masks) { return either(masks.solid, masks.liquid); }
bool always(const Moment&) { return true; }
bool has_heat(const Moment& moment) {
  return moment.parameters == nullptr || moment.parameters->heat.enabled;
}
std::uint16_t one(const Moment&, const rule::Materials*, state::Slot) { return 1; }

std::uint16_t amount_at(const Moment& moment, const rule::Materials*, state::Slot slot) {
  return moment.volume.amount[slot];
}
std::uint16_t temperature_at(const Moment& moment, const rule::Materials* materials, state::Slot slot) {
  const std::uint16_t heat = moment.volume.heat[slot];
  if (materials == nullptr) return heat;
  const int material = moment.volume.material.empty() ? 0 : moment.volume.material[slot];
  return static_cast<std::uint16_t>(materials->temperature(heat, material));
}

constexpr std::array kGrids{
    GridOf{"density", 4096, true, matter, always, amount_at},
    GridOf{"liquid", 1, false, [](const Masks& masks) { return masks.liquid; }, always, one},
    GridOf{"solid", 1, false, [](const Masks& masks) { return masks.solid; }, always, one},
    GridOf{"inert", 1, false, [](const Masks& masks) { return masks.inert; }, always, one},
    GridOf{"temperature", 65535, false, [](const Masks& masks) { return either(matter(masks), masks.inert); },
           has_heat, temperature_at},
};

template <class Bytes>
std::string_view bytes_of(const Bytes& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

// A brick begins at a multiple of its side, so a row of it is one byte of a row of bits.
Words cells_of(const state::BitPlane& plane, state::Grid g, std::array<int, 3> at) {
  Words cells{};
  for (int z = 0; z < std::min(vdb::kSide, g.z - at[2]); ++z)
    for (int y = 0; y < std::min(vdb::kSide, g.y - at[1]); ++y) {
      const std::uint64_t word = plane.row(at[1] + y, at[2] + z)[static_cast<std::size_t>(at[0]) / 64];
      for (std::uint64_t left = word >> (at[0] % 64) & 0xFF; left != 0; left &= left - 1) {
        const std::size_t place = vdb::place_in_brick(std::countr_zero(left), y, z);
        cells[place / 64] |= std::uint64_t{1} << (place % 64);
      }
    }
  return cells;
}

// A brick of a grid: its active cells, and their numbers.
struct Brick {
  Words active{};
  vdb::NumbersRecord numbers;

  bool is_empty() const {
    return std::ranges::all_of(active, [](std::uint64_t word) { return word == 0; });
  }
  bool is_tile() const {
    return std::ranges::all_of(active, [](std::uint64_t word) { return word == ~std::uint64_t{0}; }) &&
           std::ranges::count(numbers.numbers, numbers.numbers[0]) == std::ssize(numbers.numbers);
  }
};

Brick brick_at(const GridOf& grid, const Moment& moment, const rule::Materials* materials,
               std::array<int, 3> at) {
  const state::Volume& volume = moment.volume;
  const state::Grid g = volume.grid;
  const Masks masks{cells_of(volume.solid, g, at), cells_of(volume.liquid, g, at),
                    cells_of(volume.inert, g, at)};
  Brick brick{grid.cells(masks), {.at = {at[0], at[1], at[2]}}};
  for (std::size_t word = 0; word < brick.active.size(); ++word)
    for (std::uint64_t left = brick.active[word]; left != 0; left &= left - 1) {
      const int place = static_cast<int>(64 * word) + std::countr_zero(left);
      const state::Slot slot = volume.at(at[0] + place / (vdb::kSide * vdb::kSide),
                                         at[1] + place / vdb::kSide % vdb::kSide, at[2] + place % vdb::kSide);
      brick.numbers.numbers[static_cast<std::size_t>(place)] = grid.number(moment, materials, slot);
    }
  return brick;
}

template <class Bytes>
void send(vdb::Helper& helper, vdb::Record kind, const Bytes& record) {
  helper.send(std::string(1, static_cast<char>(kind)) + std::string(bytes_of(record)));
}

// Sends what is active, and then the numbers of what is not all alike.
void send_grid(vdb::Helper& helper, const GridOf& grid, const Moment& moment,
               const rule::Materials* materials, const Poll& poll) {
  const state::Grid g = moment.volume.grid;
  vdb::GridRecord head{.unit = grid.unit, .is_fog = grid.is_fog ? 1U : 0U};
  std::string_view(grid.name).copy(head.name.data(), head.name.size() - 1);
  send(helper, vdb::Record::grid, head);
  for (const bool is_numbers : {false, true})
    vdb::tree_order({g.x, g.y, g.z}, [&](std::array<int, 3> at) {
      if (at[2] == 0 && poll) poll();
      const Brick brick = brick_at(grid, moment, materials, at);
      if (brick.is_empty()) return;
      const auto& [x, y, z] = at;
      const bool is_tile = brick.is_tile();
      if (is_tile && !is_numbers)
        send(helper, vdb::Record::tile, vdb::TileRecord{{x, y, z}, brick.numbers.numbers[0]});
      else if (!is_tile && !is_numbers)
        send(helper, vdb::Record::brick, vdb::BrickRecord{.at = {x, y, z}, .active = brick.active});
      else if (!is_tile)
        send(helper, vdb::Record::numbers, brick.numbers);
    });
}

}  // namespace

std::string missing_for_vdb() { return vdb::helper_program().empty() ? vdb::how_to_get_it() : ""; }

void export_vdb(const Moment& moment, const std::filesystem::path& folder, const Poll& poll) {
  const std::filesystem::path place = folder / "volume.vdb", partial = folder / "volume.vdb.partial";
  std::vector<const GridOf*> grids;
  for (const GridOf& grid : kGrids)
    if (grid.is_there(moment)) grids.push_back(&grid);
  std::optional<rule::Materials> materials;
  if (moment.parameters != nullptr) materials.emplace(*moment.parameters);
  try {
    vdb::Helper helper(
        {"write", partial.string(), std::to_string(moment.step), std::to_string(grids.size())});
    for (const GridOf* const grid : grids)
      send_grid(helper, *grid, moment, materials ? &*materials : nullptr, poll);
    helper.send(std::string(1, static_cast<char>(vdb::Record::end)));
    helper.end_of_input();
    helper.answer();
    helper.finish();
    std::filesystem::rename(partial, place);
  } catch (const vdb::HelperError& error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw OutputError(place.string() + ": error: " + error.what(), error.out_of_space());
  }
}

}  // namespace voxmelt::io
