// The tables of materials hold what docs/automaton.md says, by hand. Stages take what
// docs/hardware/pipeline.md says they take for it.
#include "hwmodel/pipeline/model/materials.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel {
namespace {

rule::Parameters three_materials() {
  rule::Parameters parameters;
  parameters.material = {.melting_point = 30000, .latent_heat = 8000};
  parameters.materials = {{.melting_point = 30000, .latent_heat = 8000},
                          {.melting_point = 20000, .latent_heat = 5000, .warmth = 32768},
                          {.melting_point = 40000}};
  return parameters;
}

// The second one has S = 65536 x 20000 / 32768 = 40000 and F = 45000, so F - Tm = 25000. At heat 65535 it has
// the temperature min(65535 / 2, 65535 - 25000) = 32767. The other two are warmer there. So top is 32767.
TEST(Curves, TemperaturesByHand) {
  const Curves curves(three_materials());
  EXPECT_EQ(curves.temperature(1001, 1), 500);
  EXPECT_EQ(curves.temperature(39999, 1), 19999);
  EXPECT_EQ(curves.temperature(40000, 1), 20000);
  EXPECT_EQ(curves.temperature(44999, 1), 20000);
  EXPECT_EQ(curves.temperature(45007, 1), 20007);
  EXPECT_EQ(curves.temperature(65535, 1), 32767);
  EXPECT_EQ(curves.temperature(29999, 0), 29999);
  EXPECT_EQ(curves.temperature(37999, 0), 30000);
  EXPECT_EQ(curves.temperature(60000, 0), 32767) << "top, not 52000";
  EXPECT_EQ(curves.temperature(60000), 32767);
  EXPECT_EQ(curves.temperature(38001), 30001);
  EXPECT_EQ(curves.temperature(65535, 2), 32767);
}

TEST(Curves, WhatMeltsGoesOnAtItsTemperature) {
  const Curves curves(three_materials());
  EXPECT_EQ(curves.liquid_from(0), 38000);
  EXPECT_EQ(curves.liquid_from(1), 45000);
  EXPECT_EQ(curves.liquid_from(2), 40000);
  EXPECT_EQ(curves.melted(38123, 0), 38123);
  EXPECT_EQ(curves.melted(45010, 1), 20010) << "colder than the first one's melting point";
  EXPECT_EQ(curves.melted(40010, 2), 48010) << "with the latent heat of the first one";
  EXPECT_EQ(curves.melted(65535, 2), 65535) << "no more";
}

TEST(Curves, OfOneMaterialHaveNoTop) {
  rule::Parameters parameters = three_materials();
  parameters.materials.clear();
  const Curves curves(parameters);
  EXPECT_EQ(curves.temperature(60000, 0), 52000);
  EXPECT_EQ(curves.temperature(65535), 57535);
  EXPECT_EQ(curves.temperature(30001, 0), 30000);
  EXPECT_EQ(curves.liquid_from(0), 38000);
}

TEST(PairWeights, AreThoseOfBothMaterials) {
  rule::Parameters parameters;
  parameters.materials.resize(16);
  for (std::size_t one = 0; one < 16; ++one)
    for (std::size_t other = 0; other < 16; ++other)
      parameters.materials[one].weight_edge[other] =
          static_cast<std::uint16_t>(one < other ? 100 * one + other : 100 * other + one);
  const PairWeights weights(parameters, 7, &rule::SolidMaterial::weight_edge);
  EXPECT_EQ(weights.words(), 136);
  for (std::size_t one = 0; one < 16; ++one)
    for (std::size_t other = 0; other < 16; ++other)
      EXPECT_EQ(weights.of(static_cast<std::int64_t>(one), static_cast<std::int64_t>(other)),
                parameters.materials[one].weight_edge[other]);
  parameters.materials.clear();
  EXPECT_EQ(PairWeights(parameters, 7, &rule::SolidMaterial::weight_edge).of(0, 0), 7);
}

using Table = std::pair<std::string, std::int64_t>;  // its name, and the bits of all its copies

// Returns how many bits a word of each buffer has more with three materials, and the tables that are added.
struct More {
  std::vector<std::int64_t> bits;
  std::vector<Table> tables;
  int multipliers = 0, channel = 0;
};
More more_of(StageKind kind, const Design& design) {
  const auto one = make_stage(kind, design);
  Design several = design;
  several.parameters.materials = three_materials().materials;
  const auto three = make_stage(kind, several);
  More more;
  const std::vector<BufferCost> before = one->buffers(), after = three->buffers();
  for (std::size_t i = 0; i < after.size(); ++i)
    if (i < before.size()) {
      EXPECT_EQ(after[i].name, before[i].name);
      EXPECT_EQ(after[i].words * after[i].lanes, before[i].words * before[i].lanes);
      more.bits.push_back(after[i].bits - before[i].bits);
    } else {
      more.tables.emplace_back(after[i].name, after[i].total());
    }
  more.multipliers = three->units().multipliers - one->units().multipliers;
  more.channel = three->output_bits() - one->output_bits();
  EXPECT_EQ(three->lag(), one->lag());
  EXPECT_EQ(three->units().dividers, one->units().dividers);
  return more;
}

Design hot_design(rule::Law law) {
  Design design{{}, {{40, 120, 9}, 4}};
  design.parameters.flow.law = law;
  rule::Heat& heat = design.parameters.heat;
  heat.enabled = heat.air = true;
  heat.neighbours = 26;
  heat.convection = 1;
  heat.air_temperature.resize(120);
  design.parameters.flow.viscous.stiffness = 8;
  return design;
}

// Four lanes, three materials, six pairs of them: conduction reads a weight for each of its 3, 6 or 4 pairs
// in a lane, and one curve. The words of its line have four bits more.
TEST(MaterialCost, OfHeat) {
  const Design design = hot_design(rule::Law::paper);
  for (const auto& [kind, pairs] :
       {std::pair{StageKind::conduction, 3}, {StageKind::edges, 6}, {StageKind::corners, 4}}) {
    const More more = more_of(kind, design);
    for (const std::int64_t bits : more.bits) EXPECT_EQ(bits, 4) << name_of(kind);
    EXPECT_EQ(more.tables,
              (std::vector<Table>{{"weights of pairs", 6 * 16 * 4 * pairs}, {"curves", 3 * 49 * 4}}))
        << name_of(kind);
    EXPECT_EQ(more.multipliers, 1) << name_of(kind);
    EXPECT_EQ(more.channel, 4);
  }
  EXPECT_EQ(more_of(StageKind::convection, design).multipliers, 0) << "liquid is of the first one";
  EXPECT_TRUE(more_of(StageKind::convection, design).tables.empty());
  const More exchange = more_of(StageKind::exchange, design);
  EXPECT_EQ(exchange.tables, (std::vector<Table>{{"rates of air", 3 * 48 * 4}, {"curves", 3 * 49 * 4}}));
  EXPECT_EQ(exchange.multipliers, 1);
  const More melt = more_of(StageKind::melt, design);
  EXPECT_EQ(melt.tables, (std::vector<Table>{{"melting heats", 3 * 33 * 4}}));
  EXPECT_EQ(melt.multipliers, 0);
}

TEST(MaterialCost, OfGlow) {
  Design design = hot_design(rule::Law::paper);
  design.parameters.heat.air_glow = 9;
  const More exchange = more_of(StageKind::exchange, design);
  EXPECT_EQ(exchange.tables, (std::vector<Table>{{"rates of air", 3 * 48 * 4}, {"curves", 2 * 3 * 49 * 4}}));
  EXPECT_EQ(exchange.multipliers, 2) << "the temperatures before and after air";
}

// Words of settle have room in the bits of a record. In spread a blocked word with its material has 18 + 16 +
// 62 + 10 + 4 = 110 bits. An open one has 18 + 16 + 48 + 2 + 12 and the head, which has 24 bits at height
// 120: that is 120. So nothing is added there, and 4 where all pairs are done.
TEST(MaterialCost, OfTheViscousFlow) {
  const Design design = hot_design(rule::Law::viscous);
  const More settle = more_of(StageKind::settle, design), spread = more_of(StageKind::viscous_spread, design);
  EXPECT_EQ(settle.bits, (std::vector<std::int64_t>{0, 0}));
  EXPECT_EQ(settle.tables, (std::vector<Table>{{"beds of the materials", 3 * 48 * 4}}));
  EXPECT_EQ(settle.multipliers + spread.multipliers, 0);
  EXPECT_EQ(settle.channel, 4);
  EXPECT_EQ(spread.bits, (std::vector<std::int64_t>{0, 0, 4, 0, 0, 0}));
  EXPECT_EQ(spread.tables, settle.tables);
  EXPECT_EQ(more_of(StageKind::gravity, design).bits, (std::vector<std::int64_t>{4}));
}

TEST(MaterialCost, AWordInMemoryHasFourBitsMore) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    Design design = hot_design(law);
    const int one = design.cell_bits();
    design.parameters.materials = three_materials().materials;
    EXPECT_EQ(design.cell_bits(), one + 4);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
