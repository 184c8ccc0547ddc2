// What the memories of a stage hold is what docs/hardware.md says: bits per cell of a plane, and how many
// cells.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <ostream>
#include <string>

#include "hwmodel/stream/pipeline.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel {
namespace {

struct Memory {
  std::int64_t plane = 0,
               beside = 0;  // bits: of a word of the plane memory; of the others, per cell of a column
  friend bool operator==(const Memory&, const Memory&) = default;
};
void PrintTo(const Memory& memory, std::ostream* out) {
  *out << memory.plane << " (" << memory.beside << ")";
}

// Of every stage that has any; also sees that what a stage delays is what its memories hold.
std::map<std::string, Memory> memories_of(const std::string& scene_name) {
  constexpr int kLanes = 4;
  const scene::Scene scene =
      scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene_name + ".toml"), {});
  const Shape shape{scene.initial.grid, kLanes};
  std::map<std::string, Memory> memories;
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
    if (memory != Memory{} && stage.name != "gravity") memories[stage.name] = memory;
    const std::int64_t scan = stage.name == "settle" ? 1 : 0;  // of its lag: a look ahead, no memory
    if (stage.name != "exchange") {
      EXPECT_EQ(cells, kLanes * (stage.lag - scan)) << stage.name;
    }
  }
  return memories;
}

TEST(MemoryCost, OfThePaperLawWithHeat) {
  EXPECT_EQ(memories_of("cello"),
            (std::map<std::string, Memory>{
                {"conduction", {67, 67}}, {"pattern", {53, 122}}, {"apply", {113, 188}}}));
}

TEST(MemoryCost, OfTheSidesWithoutHeat) {
  EXPECT_EQ(memories_of("lesson_gravity").at("walls"), (Memory{34 + 1, 0}));
}

TEST(MemoryCost, OfTheViscousLawWithHeat) {
  EXPECT_EQ(
      memories_of("cello_viscous"),
      (std::map<std::string, Memory>{{"conduction", {50, 50}}, {"settle", {0, 98}}, {"spread", {106, 170}}}));
}

TEST(MemoryCost, OfTheAirOneTemperaturePerHeight) {
  rule::Parameters parameters;
  parameters.heat.enabled = parameters.heat.air = true;
  parameters.heat.air_temperature.resize(9);
  for (const StageReport& stage : Pipeline(parameters, {5, 9, 3}, {}).stages()) {
    if (stage.name != "exchange") continue;
    ASSERT_EQ(stage.buffers.size(), 1u);
    EXPECT_EQ(stage.buffers.front().total(), 9 * 16);
    return;
  }
  ADD_FAILURE() << "no exchange";
}

// A channel is as wide as a cell and what its producer adds to it.
TEST(MemoryCost, ChannelsAreAsWideAsWhatTheyCarry) {
  const auto widths_of = [](const std::string& scene_name) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (scene_name + ".toml"), {});
    std::map<std::string, int> widths;
    for (const ChannelReport& channel : Pipeline(scene.parameters, scene.initial.grid, {}).channels())
      widths[channel.producer] = channel.bits;
    return widths;
  };
  const std::map<std::string, int> paper = widths_of("cello");
  EXPECT_EQ(paper.at("reader"), 50) << "state, amount, energy, heat";
  for (const char* stage : {"conduction", "exchange", "melt"})
    EXPECT_EQ(paper.at(stage), 50 + 1) << stage << ": beside a wall";
  EXPECT_EQ(paper.at("gravity"), 50);
  EXPECT_EQ(paper.at("pattern"), 50 + 8);
  EXPECT_EQ(paper.at("apply"), 50);
  EXPECT_EQ(widths_of("lesson_gravity").at("walls"), 34 + 1);
  const std::map<std::string, int> viscous = widths_of("cello_viscous");
  EXPECT_EQ(viscous.at("reader"), 34) << "state, amount, heat";
  EXPECT_EQ(viscous.at("settle"), 34 + 1 + 23 + 14 + 14 + 25) << "in a run; head, mobility, exposed, dead";
  EXPECT_EQ(viscous.at("gravity"), 34);
}

}  // namespace
}  // namespace voxmelt::hwmodel
