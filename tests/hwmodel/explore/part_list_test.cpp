// A design takes products, registers and memories of a device.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "hwmodel/explore/mapping.h"
#include "hwmodel/explore/part_list.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel::explore {
namespace {

TEST(Explore, MemoriesTakeTheShapeThatFits) {
  const Family family = load_device("zu7ev", {}).family;
  // 127 words of 268 bits take 8 halves of 512 x 36, or 4 URAMs of 72 bits. In LUTs they are 2 deep and 39
  // wide at 8 each, and every bit needs a choice of two.
  const std::vector<MemoryUse> shallow = ways_to_hold(127, 268, family);
  ASSERT_EQ(shallow.size(), 3U);
  EXPECT_EQ(shallow[0].lutram, 2 * 39 * 8 + 268);
  EXPECT_EQ(shallow[1].parts, 8);
  EXPECT_EQ(shallow[2].uram, 4);
  // 3302 words of 268 bits have 30 bytes in each of 7 rows of 512 words: with 4 to a half of 512 x 36 that is
  // 53 (other shapes take 60 and more), or 4 URAMs.
  const std::vector<MemoryUse> deep = ways_to_hold(3302, 268, family);
  ASSERT_EQ(deep.size(), 2U);  // too deep for LUTs
  EXPECT_EQ(deep[0].parts, 53);
  EXPECT_EQ(deep[1].uram, 4);
  // 12694 words of 69 bits: 52 of 1024 x 18, with 13 rows. 512 x 36 takes 50, but 25 rows, and choosing among
  // 12 more is dearer than 2 halves: 12 * 69 > 2 * 258.
  EXPECT_EQ(ways_to_hold(12694, 69, family)[0].parts, 52);
  // 2048 words of 8 bits take one half of 2048 x 9.
  EXPECT_EQ(ways_to_hold(2048, 8, family)[0].parts, 1);
}

TEST(Explore, ShallowMemoriesOfLutsAreWider) {
  // 2 words of 240 bits: 18 of 14 bits in 8 LUTs (UltraScale+), or 40 of 6 in 4 (7 series). ECP5 has 60 of 4.
  EXPECT_EQ(luts_to_hold(2, 240, load_device("zu7ev", {}).family), 18 * 8);
  EXPECT_EQ(luts_to_hold(2, 240, load_device("artix-200t", {}).family), 40 * 4);
  EXPECT_EQ(luts_to_hold(2, 240, load_device("ecp5-85f", {}).family), 60 * 6);
  // 33 words of 14 bits: two of 32 words and a choice of two, 16 + 14, or two of 64 words and 7 bits, 16.
  EXPECT_EQ(luts_to_hold(33, 14, load_device("zu7ev", {}).family), 16);
}

TEST(Explore, ProductsAreCutIntoPieces) {
  const Widths ultrascale{27, 18}, ecp5{18, 18};
  EXPECT_EQ(dsps_of({18, 17}, ultrascale), 1);
  EXPECT_EQ(dsps_of({17, 25}, ultrascale), 1);  // either way round
  EXPECT_EQ(dsps_of({25, 17}, ecp5), 2);
  EXPECT_EQ(dsps_of({27, 27}, ultrascale), 2);
  EXPECT_EQ(dsps_of({27, 27}, ecp5), 4);
  EXPECT_EQ(dsps_of({35, 18}, ecp5), 2);  // 18 + 17 bits
  EXPECT_EQ(dsps_of({36, 18}, ecp5), 3);
}

TEST(Explore, NoSumIsKeptThatAnotherBeats) {
  const std::vector<MemoryUse> sums = sums_of({{10, 0, 0}, {0, 5, 0}}, {{10, 0, 0}, {0, 5, 0}, {0, 6, 0}});
  std::vector<std::int64_t> seen;
  seen.reserve(sums.size());
  for (const MemoryUse& sum : sums) seen.push_back(1000 * sum.lutram + sum.parts);
  EXPECT_EQ(seen, (std::vector<std::int64_t>{10, 10005, 20000}));
}

TEST(Explore, EverySumIsKeptThatNoOtherBeats) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> draw(0, 7);
  const auto list = [&] {
    std::vector<MemoryUse> uses(1 + random() % 12);
    for (MemoryUse& use : uses) use = {draw(random), draw(random), draw(random)};
    return uses;
  };
  const auto beats = [](const MemoryUse& a, const MemoryUse& b) {
    return a.lutram <= b.lutram && a.parts <= b.parts && a.uram <= b.uram;
  };
  for (int i = 0; i < 300; ++i) {
    const std::vector<MemoryUse> a = list(), b = list(), kept = sums_of(a, b);
    for (const MemoryUse& x : a)
      for (const MemoryUse& y : b)
        EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](const auto& k) { return beats(k, x + y); }));
    for (const MemoryUse& k : kept)
      EXPECT_EQ(std::count_if(kept.begin(), kept.end(), [&](const auto& other) { return beats(other, k); }),
                1);
  }
}

// With three copies, each way to hold them takes thrice as much for settle and spread as with one.
TEST(Explore, MemoriesOfCopiesAllCount) {
  const Family family = load_device("ecp5-85f", {}).family;
  const auto parts = [&](int copies) {
    Design design{{}, {{60, 40, 30}, 4}, copies};
    design.parameters.flow.law = rule::Law::viscous;
    return part_list(design, family);
  };
  const auto fewest = [](const PartList& list) {
    std::int64_t least = list.memories.front().parts;
    for (const MemoryUse& use : list.memories)
      if (use.lutram == 0) least = std::min(least, use.parts);
    return least;
  };
  const PartList one = parts(1), three = parts(3);
  std::int64_t of_copy = 0;  // in BRAM alone
  for (const StagePart& part : one.stages)
    if (part.kind == StageKind::settle || part.kind == StageKind::viscous_spread)
      for (const BufferCost& buffer : part.buffers)
        if (buffer.words > family.register_words)
          for (const MemoryUse& way : ways_to_hold(buffer.words, buffer.lanes * buffer.bits, family))
            if (way.lutram == 0) of_copy += way.parts;
  EXPECT_GT(of_copy, 10);
  EXPECT_EQ(fewest(three) - fewest(one), 2 * of_copy);
}

// A family whose registers hold just as many words as a buffer has keeps it in registers.
TEST(Explore, MemoriesBeginAboveTheWordsOfRegisters) {
  Family family = load_device("zu7ev", {}).family;
  Design design{{}, {{20, 6, 9}, 4}};
  design.parameters.flow.law = rule::Law::paper;
  std::vector<BufferCost> buffers;
  for (const StagePart& part : part_list(design, family).stages)
    buffers.insert(buffers.end(), part.buffers.begin(), part.buffers.end());
  ASSERT_GT(buffers.size(), 3u);
  for (const BufferCost& largest : buffers) {
    family.register_words = static_cast<int>(largest.words);
    std::int64_t bits = 0;
    for (const BufferCost& one : buffers)
      if (one.words <= largest.words) bits += one.total();
    EXPECT_EQ(part_list(design, family).register_bits, bits) << largest.name;
  }
}

// A lane with all products costs what was synthesised. Without any, source costs a seventh: it has six.
TEST(Explore, LanesCostInProportionToProducts) {
  Family family = load_device("zu7ev", {"family.control.lut=0", "family.control.ff=0"}).family;
  for (auto& [kind, cost] : family.stages)
    if (kind != StageKind::source) cost.lane.lut.value = cost.lane.ff.value = 0;
  ASSERT_EQ(family.stages.at(StageKind::source).products, 6);
  family.stages.at(StageKind::source).lane.lut.value = 700;
  family.stages.at(StageKind::source).lane.ff.value = 70;
  family.divider.lut.value = family.divider.ff.value = family.random_block.lut.value = 0;
  family.random_block.ff.value = 0;
  const auto logic = [&](int vents, int drains) {
    Design design{{}, {{60, 40, 30}, 4}};
    design.parameters.flow.law = rule::Law::paper;
    design.parameters.heat.enabled = true;
    design.parameters.open_border = true;
    design.parameters.vents.resize(vents);
    design.parameters.drains.resize(drains);
    PartList parts = part_list(design, family);
    parts.register_bits = 0;
    return logic_of(parts, family);
  };
  EXPECT_EQ(logic(0, 0).lut, 4 * 100);
  EXPECT_EQ(logic(0, 0).ff, 4 * 10);
  EXPECT_EQ(logic(0, 1).lut, 4 * 200);
  EXPECT_EQ(logic(1, 0).lut, 4 * 600);  // five products
  EXPECT_EQ(logic(1, 1).lut, 4 * 700);
  EXPECT_EQ(logic(2, 2).lut, 4 * 1300);
}

// Spread's circuit has words of 108 bits with heat, 92 without, and apart from them what cells got (48 and
// 16), as hwmodel/rtl/spread_stage.sv says. Columns of this grid have 40 cells, and its planes 15 blocks.
TEST(Explore, SpreadHoldsWhatItsCircuitHolds) {
  const Family family = load_device("zu7ev", {}).family;
  for (const bool hot : {true, false}) {
    Design design{{}, {{60, 40, 30}, 4}};
    design.parameters.flow.law = rule::Law::viscous;
    design.parameters.heat.enabled = hot;
    std::multiset<std::vector<std::int64_t>> held;  // words, and bits of all lanes
    for (const StagePart& part : part_list(design, family).stages)
      if (part.kind == StageKind::viscous_spread)
        for (const BufferCost& buffer : part.buffers) held.insert({buffer.words, buffer.lanes * buffer.bits});
    const std::int64_t word = hot ? 108 : 92, done = hot ? 36 : 20, sum = hot ? 48 : 16;
    EXPECT_EQ(held, (std::multiset<std::vector<std::int64_t>>{{40, 4 * word},
                                                              {40, 4 * sum},
                                                              {40, word},
                                                              {40, 4 * sum},
                                                              {62, 4 * done},
                                                              {560, 4 * word},
                                                              {560, 4 * sum},
                                                              {15, 4 * 62}}));
  }
}

TEST(Explore, CopiesOfAStageHoldTheSame) {
  const Family family = load_device("zu7ev", {}).family;
  Design design{{}, {{60, 40, 30}, 4}, 3};
  design.parameters.flow.law = rule::Law::viscous;
  design.parameters.heat.enabled = true;
  const PartList parts = part_list(design, family);
  std::map<StageKind, std::vector<std::string>> held;
  for (const StagePart& part : parts.stages) {
    std::string buffers;
    for (const BufferCost& buffer : part.buffers)
      buffers += buffer.name + ' ' + std::to_string(buffer.words) + ' ' +
                 std::to_string(buffer.lanes * buffer.bits) + ',';
    held[part.kind].push_back(buffers);
  }
  EXPECT_EQ(held[StageKind::settle].size(), 3u);
  EXPECT_EQ(held[StageKind::viscous_spread].size(), 3u);
  for (const auto& [kind, copies] : held)
    for (const std::string& copy : copies) EXPECT_EQ(copy, copies.front());
}

// A synthesis had every feature. The model counts as many products and dividers then as its numbers rest on.
TEST(Explore, SynthesisedStagesHadTheProductsOfTheModel) {
  const Family family = load_device("zu7ev", {}).family;
  std::map<StageKind, int> dividers;
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Design design{{}, {{60, 40, 30}, 4}, 1};
    rule::Parameters& all = design.parameters;
    all.flow.law = law;
    all.flow.thermal_viscosity = law == rule::Law::viscous;  // the paper's circuit reads shares from a table
    all.flow.fall.factor = 40000;
    all.flow.paper.reheat = 100;
    all.heat.enabled = all.heat.air = true;
    all.heat.convection = all.heat.air_glow = 1000;
    all.heat.neighbours = 26;
    all.vents.resize(1);
    all.drains.resize(1);
    for (const auto& stage : make_step(design)) {
      const bool paper_alone = stage->kind() == StageKind::source || stage->kind() == StageKind::gravity ||
                               stage->kind() == StageKind::melt;  // they give energy, too
      if (law == rule::Law::viscous && paper_alone) continue;
      EXPECT_EQ(stage->units().multipliers, family.stages.at(stage->kind()).products)
          << name_of(stage->kind());
      dividers[stage->kind()] = stage->units().dividers;
    }
  }
  EXPECT_EQ(dividers[StageKind::source], 1);
  EXPECT_EQ(dividers.count(StageKind::corners), 1U);
  EXPECT_EQ(dividers[StageKind::gravity], 1);
  EXPECT_EQ(dividers[StageKind::apply], 1);
  EXPECT_EQ(dividers[StageKind::settle], 5);
  EXPECT_EQ(dividers[StageKind::viscous_spread], 1);
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
