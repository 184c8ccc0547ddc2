// The wires of a token have the widths of docs/hardware/pipeline.md. Each wire reads and writes its own
// field.
#include "hwmodel/pipeline/model/cell_wires.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/volume_port.h"

namespace voxmelt::hwmodel {
namespace {

TEST(CellWires, WidthsAreThoseOfThePage) {
  const std::vector<std::pair<std::string, int>> page{
      {"state", 2},     {"amount", 16},      {"energy", 16}, {"heat", 16},
      {"material", 4},  {"exposed_axes", 2}, {"pattern", 8}, {"beside_wall", 1},
      {"touches", 1},   {"set", 1},          {"in_run", 1},  {"head", 30},
      {"mobility", 22}, {"limit", 14},       {"dead", 25},   {"shut", 1}};
  ASSERT_EQ(kCellWires.size(), page.size());
  for (std::size_t i = 0; i < page.size(); ++i) {
    EXPECT_EQ(kCellWires[i].name, page[i].first);
    EXPECT_EQ(kCellWires[i].bits, page[i].second) << page[i].first;
    EXPECT_EQ(kCellWires[i].in_memory, i < 5) << page[i].first;
  }
  EXPECT_EQ(bits_in_memory({.energy = true, .heat = true, .material = false}), 50);
  EXPECT_EQ(bits_in_memory({.energy = true, .heat = false, .material = false}), 34);
  EXPECT_EQ(bits_in_memory({.energy = false, .heat = true, .material = false}), 34);
  EXPECT_EQ(bits_in_memory({.energy = false, .heat = false, .material = false}), 18);
  EXPECT_EQ(bits_in_memory({.energy = true, .heat = true, .material = true}), 54);
}

TEST(CellWires, EachReadsAndWritesItsOwnField) {
  for (const CellWire& written : kCellWires) {
    const Cell before;
    Cell cell;
    const std::int64_t other = written.get(before) == 1 ? 0 : 1;
    written.set(cell, other);
    for (const CellWire& read : kCellWires)
      EXPECT_EQ(read.get(cell), read.wire == written.wire ? other : read.get(before))
          << written.name << ' ' << read.name;
    EXPECT_FALSE(cell == before) << written.name << ": a field that no comparison sees";
  }
}

// A whole cell has no bits beside its wires: setting them all copies it.
TEST(CellWires, TheyAreAllThatACellHas) {
  Cell from;
  from.state = State::solid;
  from.amount = 1;
  from.energy = 2;
  from.heat = 3;
  from.material = 9;
  from.exposed_axes = 1;
  from.pattern = 77;
  from.beside_wall = 1;
  from.touches = 1;
  from.set = 1;
  from.in_run = 1;
  from.head = -5;
  from.mobility = 6;
  from.limit = 7;
  from.dead = 8;
  from.shut = 1;
  Cell to;
  for (const CellWire& row : kCellWires) row.set(to, row.get(from));
  EXPECT_EQ(to, from);
}

TEST(CellWires, AWordInMemoryHasTheNumbersOfTheState) {
  state::Volume volume(state::Grid{3, 1, 1});
  const state::Slot slot = volume.at(1, 0, 0);
  Cell cell;
  cell.state = State::liquid;
  cell.amount = 40000;
  cell.energy = 123;
  cell.heat = 65535;
  write_cell(cell, 1, 0, 0, volume);
  EXPECT_TRUE(volume.liquid.test(1, 0, 0));
  EXPECT_EQ(volume.amount[slot], 40000);
  EXPECT_EQ(volume.energy[slot], 123);
  EXPECT_EQ(volume.heat[slot], 65535);
  Cell back[3];
  read_token(volume, Shape{volume.grid, 3}, Place{}, back);
  EXPECT_EQ(back[1], cell);
  EXPECT_EQ(back[0].state, State::air);
}

TEST(CellWires, AWordInMemoryHasTheMaterialWhereTheStateHas) {
  Cell cell;
  cell.state = State::solid;
  cell.amount = 4096;
  cell.material = 15;
  for (const bool has : {false, true}) {
    state::Volume volume(state::Grid{3, 1, 1});
    if (has) volume.material = decltype(volume.material)(volume.grid);
    write_cell(cell, 1, 0, 0, volume);
    Cell back[3];
    read_token(volume, Shape{volume.grid, 3}, Place{}, back);
    EXPECT_EQ(back[1].material, has ? 15 : 0);
    EXPECT_EQ(back[0].material, 0);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
