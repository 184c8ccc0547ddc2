// The table of the keys of [hw] is tested: each row reads and writes its own value.
#include "hwmodel/pipeline/model/configuration.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "hwmodel/explore/size_fifos.h"
#include "hwmodel/machine/presets/presets.h"
#include "kernel/scene/text/error.h"

namespace voxmelt::hwmodel {
namespace {

// These values are those of docs/hardware/pipeline.md.
const std::map<std::string, std::int64_t> kUsual{{"lanes", 4},      {"cascade", 1},    {"substeps", 1},
                                                 {"overlap", 1},    {"tile", 0},       {"coded", 0},
                                                 {"fifo_depth", 4}, {"stall_seed", 0}, {"registers", 0}};
const std::map<std::string, std::int64_t> kOthers{{"lanes", 8},      {"cascade", 3},     {"substeps", 2},
                                                  {"overlap", 0},    {"tile", 24},       {"coded", 1},
                                                  {"fifo_depth", 5}, {"stall_seed", 77}, {"registers", 1}};

std::map<std::string, std::int64_t> values_of(const Configuration& c) {
  std::map<std::string, std::int64_t> values;
  for (const HwKey& key : kHwKeys) values[std::string(key.name)] = key.get(c);
  return values;
}

TEST(Configuration, RowsReadAndWriteTheirNumbers) {
  EXPECT_EQ(values_of({}), kUsual);
  Configuration c;
  for (const HwKey& key : kHwKeys) key.set(c, kOthers.at(std::string(key.name)));
  EXPECT_EQ(values_of(c), kOthers);
  EXPECT_EQ(c.lanes, 8);
  EXPECT_EQ(c.cascade, 3);
  EXPECT_EQ(c.substeps, 2);
  EXPECT_FALSE(c.overlap);
  EXPECT_EQ(c.tile, 24);
  EXPECT_TRUE(c.coded);
  EXPECT_TRUE(c.registers);
  EXPECT_EQ(c.fifo_depth, 5);
  EXPECT_EQ(c.stall_seed, 77u);
}

TEST(Configuration, OverridesGoByTheTable) {
  std::vector<std::string> sets;
  sets.reserve(kOthers.size());
  for (const auto& [name, value] : kOthers) sets.push_back("hw." + name + '=' + std::to_string(value));
  EXPECT_EQ(values_of(load_preset({}, sets).configuration), kOthers);
  for (const HwKey& key : kHwKeys) {
    const std::string name = "hw." + std::string(key.name) + '=';
    EXPECT_THROW(load_preset({}, {name + std::to_string(key.low - 1)}), scene::InputError) << name;
    if (key.high < INT64_MAX) {
      EXPECT_THROW(load_preset({}, {name + std::to_string(key.high + 1)}), scene::InputError) << name;
    }
  }
  EXPECT_EQ(load_preset({}, {"hw.lanes=3", "hw.tile=21"}).configuration.lanes, 3);
  EXPECT_THROW(load_preset({}, {"hw.lanes=8", "hw.tile=20"}), scene::InputError);
}

// The file that --size-fifos writes describes the whole machine, with its tiles.
TEST(Configuration, AFileOfSizedChannelsHasTheWholeMachine) {
  Configuration c;
  for (const HwKey& key : kHwKeys) key.set(c, kOthers.at(std::string(key.name)));
  const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "voxmelt_sized.toml";
  std::ofstream(file) << explore::toml_of({}, c, "sized");
  auto wanted = kOthers;
  wanted["fifo_depth"] = Configuration{}.fifo_depth;  // its channels have depths of their own
  EXPECT_EQ(values_of(load_preset(file, {}).configuration), wanted);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace voxmelt::hwmodel
