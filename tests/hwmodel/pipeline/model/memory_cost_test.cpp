// The memories of a stage hold what docs/hardware/pipeline.md says: so many bits per cell of a plane, and so
// many cells.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>

#include "hwmodel/pipeline/model/pipeline.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel {
namespace {

struct Memory {
  // The bits are those of a word of the plane memory. In the other memories they count per cell of a column.
  std::int64_t plane = 0, beside = 0;
  friend bool operator==(const Memory&, const Memory&) = default;
};
void PrintTo(const Memory& memory, std::ostream* out) {
  *out << memory.plane << " (" << memory.beside << ")";
}

// Checks every stage that has memories. Its memories must hold as much as it delays.
std::map<StageKind, Memory> memories_of(const std::string& scene_name, bool freezes = false) {
  constexpr int kLanes = 4;
  scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene_name + ".toml"), {});
  if (freezes) scene.parameters.material.freezing_point = 1;
  const Shape shape{scene.initial.grid, kLanes};
  std::map<StageKind, Memory> memories;
  for (const StageReport& stage : Pipeline(scene.parameters, shape.grid, {kLanes, 1, 4, 0}).stages()) {
    Memory memory;
    std::int64_t cells = 0, others = 0;
    for (const BufferCost& buffer : stage.buffers) {
      const bool plane = buffer.name == "plane memory";
      if (plane) memory.plane = buffer.bits;
      if (!plane) others += buffer.total();
      if (!buffer.name.starts_with("floor")) cells += buffer.words * buffer.lanes;
    }
    memory.beside = (others + 2 * shape.column()) / (kLanes * shape.column());
    if (memory != Memory{} && stage.kind != StageKind::gravity) memories[stage.kind] = memory;
    const std::int64_t scan = stage.kind == StageKind::settle ? 1 : 0;  // a look-ahead without memory
    if (stage.kind != StageKind::exchange) {
      EXPECT_EQ(cells, kLanes * (stage.lag - scan)) << name_of(stage.kind);
    }
  }
  return memories;
}

TEST(MemoryCost, OfThePaperLawWithHeat) {
  EXPECT_EQ(memories_of("cello"), (std::map<StageKind, Memory>{{StageKind::conduction, {67, 67}},
                                                               {StageKind::pattern, {53, 122}},
                                                               {StageKind::apply, {113, 188}}}));
}

TEST(MemoryCost, OfTheSidesWithoutHeat) {
  EXPECT_EQ(memories_of("lesson_gravity").at(StageKind::walls), (Memory{34 + 1, 0}));
}

TEST(MemoryCost, OfTheViscousLawWithHeat) {
  EXPECT_EQ(memories_of("cello_viscous"),
            (std::map<StageKind, Memory>{{StageKind::conduction, {50, 50}},
                                         {StageKind::settle, {0, 115}},
                                         {StageKind::viscous_spread, {121, 191}}}));
}

// The same scene, and freezing: a bit more in the words of conduction (touches), of both reversers of settle
// and of spread (set; all of its memories hold one of each four cells twice, so beside the plane 2 and no
// more).
TEST(MemoryCost, OfFreezing) {
  const std::map<StageKind, Memory> freezing = memories_of("cello_viscous", true);
  EXPECT_EQ(freezing.at(StageKind::conduction), (Memory{50 + 1, 50 + 1}));
  EXPECT_EQ(freezing.at(StageKind::settle), (Memory{0, 115 + 2}));
  EXPECT_EQ(freezing.at(StageKind::viscous_spread), (Memory{121 + 1, 191 + 2}));
}

TEST(MemoryCost, OfTheAirOneTemperaturePerHeight) {
  rule::Parameters parameters;
  parameters.heat.enabled = parameters.heat.air = true;
  parameters.heat.air_temperature.resize(9);
  for (const StageReport& stage : Pipeline(parameters, {5, 9, 3}, {}).stages()) {
    if (stage.kind != StageKind::exchange) continue;
    ASSERT_EQ(stage.buffers.size(), 1u);
    EXPECT_EQ(stage.buffers.front().total(), 9 * 16);
    return;
  }
  ADD_FAILURE() << "no exchange";
}

// A channel is as wide as a cell and the bits that its producer adds to it.
TEST(MemoryCost, ChannelsAreAsWideAsWhatTheyCarry) {
  const auto widths_of = [](const std::string& scene_name) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene_name + ".toml"), {});
    std::map<StageKind, int> widths;
    for (const ChannelReport& channel : Pipeline(scene.parameters, scene.initial.grid, {}).channels())
      widths[channel.producer] = channel.bits;
    return widths;
  };
  const std::map<StageKind, int> paper = widths_of("cello");
  EXPECT_EQ(paper.at(StageKind::reader), 50) << "state, amount, energy, heat";
  for (const StageKind stage : {StageKind::conduction, StageKind::exchange, StageKind::melt})
    EXPECT_EQ(paper.at(stage), 50 + 1) << name_of(stage) << ": beside a wall";
  EXPECT_EQ(paper.at(StageKind::gravity), 50);
  EXPECT_EQ(paper.at(StageKind::pattern), 50 + 8);
  EXPECT_EQ(paper.at(StageKind::apply), 50);
  EXPECT_EQ(widths_of("lesson_gravity").at(StageKind::walls), 34 + 1);
  const std::map<StageKind, int> viscous = widths_of("cello_viscous");
  EXPECT_EQ(viscous.at(StageKind::reader), 34) << "state, amount, heat";
  EXPECT_EQ(viscous.at(StageKind::settle), 34 + 1 + 24 + 22 + 14 + 25 + 1)
      << "in a run; head, mobility, limit, dead, shut";
  EXPECT_EQ(viscous.at(StageKind::gravity), 34);
}

}  // namespace
}  // namespace voxmelt::hwmodel
