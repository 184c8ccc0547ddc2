// The table of fields determines parts of volumes, and the first difference of two volumes.
#include "kernel/automaton/state/fields.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/state/difference.h"
#include "kernel/automaton/state/part.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

// Sections 1 and 13 of docs/automaton.md say that a cell outside is inert and flat (offset 2048), and give
// the places in a cell's word. Exports of all versions have this order.
TEST(Fields, AreThoseOfTheDefinitionInTheOrderOfFiles) {
  struct Expected {
    const char* name;
    int bits, digest_bit;
    std::uint32_t border;
  };
  const std::vector<Expected> page{{"solid", 1, 48, 0},     {"liquid", 1, 49, 0},  {"inert", 1, 50, 1},
                                   {"amount", 16, 0, 2048}, {"energy", 16, 16, 0}, {"heat", 16, 32, 0}};
  std::size_t n = 0;
  for_each_field([&](const auto& row) {
    if (n == page.size()) return;  // a field that came later
    EXPECT_EQ(row.name, page[n].name);
    EXPECT_EQ(row.bits, page[n].bits) << row.name;
    EXPECT_EQ(row.digest_bit, page[n].digest_bit) << row.name;
    EXPECT_EQ(row.border, page[n].border) << row.name;
    EXPECT_FALSE(row.optional) << row.name << ": every file of theirs has it";
    ++n;
  });
  EXPECT_EQ(n, page.size());
}

TEST(Fields, AreThereInTheScenesThatHaveThem) {
  rule::Parameters paper, viscous;
  paper.flow.law = rule::Law::paper;
  viscous.flow.law = rule::Law::viscous;
  viscous.heat.enabled = true;
  const auto names = [](const rule::Parameters& p) {
    std::string all;
    for_each_field([&](const auto& row) {
      if (!row.optional && (row.present == nullptr || row.present(p))) all += std::string(row.name) + " ";
    });
    return all;
  };
  EXPECT_EQ(names(paper), "solid liquid inert amount energy ");
  EXPECT_EQ(names(viscous), "solid liquid inert amount heat ");
}

TEST(Fields, HaveNumbersOfAnyWidth) {
  const Grid grid{70, 2, 2};
  BitPlane mask(grid);
  Field<std::uint8_t> bytes(grid);
  Field<std::uint16_t> words(grid);
  set_value(mask, 69, 1, 1, 1);
  set_value(bytes, 69, 1, 1, 255);
  set_value(words, 69, 1, 1, 65535);
  EXPECT_EQ(value_at(mask, 69, 1, 1), 1u);
  EXPECT_EQ(value_at(bytes, 69, 1, 1), 255u);
  EXPECT_EQ(value_at(words, 69, 1, 1), 65535u);
  EXPECT_EQ(value_at(mask, 68, 1, 1) + value_at(bytes, 68, 1, 1) + value_at(words, 68, 1, 1), 0u);
}

Volume sample() {
  Volume v(Grid{70, 4, 3});
  worlds::put(v, 66, 1, 1, 0x1234, 0x0102, 0xFFFE);
  worlds::put_solid(v, 67, 2, 1, 4096, 7);
  worlds::put_inert(v, 5, 0, 0);
  return v;
}

TEST(Part, HasTheCellsOfItsBox) {
  const Volume part =
      part_of(sample(), {{65, 1, 0}, {3, 2, 3}});  // no two numbers that a bug could take for each other
  Volume expected(Grid{3, 2, 3});
  worlds::put(expected, 1, 0, 1, 0x1234, 0x0102, 0xFFFE);
  worlds::put_solid(expected, 2, 1, 1, 4096, 7);
  EXPECT_TRUE(part == expected);
}

TEST(Part, IsClearedAndNothingElseIs) {
  Volume v = sample();
  const Box box{{66, 1, 0}, {1, 3, 3}};
  EXPECT_TRUE(holds_something(v, box));
  clear(v, box);
  EXPECT_FALSE(holds_something(v, box));
  Volume expected(Grid{70, 4, 3});
  worlds::put_solid(expected, 67, 2, 1, 4096, 7);
  worlds::put_inert(expected, 5, 0, 0);
  EXPECT_TRUE(v == expected);
}

TEST(Difference, IsTheFirstOneOfAnyField) {
  const Volume base = sample();
  EXPECT_FALSE(first_difference(base, base));
  for_each_field([&](const auto& row) {
    if (row.optional) return;
    Volume other = base;
    const std::uint32_t was = value_at(base.*row.column, 66, 1, 1);
    set_value(other.*row.column, 66, 1, 1, was ^ 1);
    other.heat[other.at(0, 2, 1)] = 9;  // a later difference
    const auto found = first_difference(base, other);
    ASSERT_TRUE(found) << row.name;
    EXPECT_EQ(text_of(*found), std::string(row.name) + " at 66, 1, 1: expected " + std::to_string(was) +
                                   ", is " + std::to_string(was ^ 1));
    EXPECT_FALSE(same_cell(base, other, 66, 1, 1)) << row.name;
    EXPECT_TRUE(same_cell(base, other, 65, 1, 1)) << row.name;
  });
}

TEST(CopyFields, TellsNothingOfChanges) {
  const Volume from = sample();
  Volume to(from.grid);
  to.changed.follow(to.grid);
  const ChangedBricks::Seen seen = to.changed.now();
  copy_fields(from, to);
  EXPECT_TRUE(to == from);
  EXPECT_TRUE(to.changed.none_since(seen));
}

}  // namespace
}  // namespace voxmelt::state
