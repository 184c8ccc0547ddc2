// Both machines run in one simulation on one memory. Every fault of either, planted there, is found where it
// was planted.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/machine/machine.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/faults/faults.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "tests/hwmodel/caster/faults/fault_pictures.h"

namespace voxmelt::hwmodel {

void PrintTo(const FaultInfo& fault, std::ostream* out) { *out << fault.name; }
namespace raycast {
void PrintTo(const FaultInfo& fault, std::ostream* out) { *out << fault.name; }
}  // namespace raycast

namespace {

std::string identifier(std::string_view name) {
  std::string text;
  for (const char c : name) text += c == '-' ? '_' : c;
  return text;
}

// Plants the pipeline's faults in a proving ground, with pictures of 16 x 16.
class PlantedInStream : public testing::TestWithParam<FaultInfo> {};

MachineReport prove(const std::string& name, Fault fault, bool on_dram) {
  const std::filesystem::path scenes(VOXMELT_SCENES_FOLDER);
  const std::filesystem::path folder =
      is_of_materials(fault) ? scenes.parent_path() / "tests/hwmodel/mutants/scenes" : scenes;
  scene::Scene scene = scene::load(folder / (name + ".toml"), {});
  scene.camera.width = scene.camera.height = 16;
  MachineOptions options;
  options.steps.steps = 8;
  options.steps.fault = fault;
  options.steps.fault_step = 4;
  options.steps.configuration = {.lanes = 4, .cascade = 2, .stall_seed = 1};
  if (is_of_tiles(fault)) options.steps.configuration = {.lanes = 1, .stall_seed = 1, .tile = 16};
  options.steps.configuration.coded = is_of_the_code(fault);
  scene.parameters.pieces.fall = is_of_pieces(fault);
  options.picture.frames = 2;
  if (on_dram) options.picture.configuration.dram = load_memory("ddr4-2400", "test");
  return verify_machine(
      {scene.parameters,
       0,
       *run::implementations().find("reference"),
       {},
       {scene.initial, scene.look, scene.light, scene.terrain, scene.camera, render::Setting::fast}},
      options);
}

TEST_P(PlantedInStream, IsFoundWhereItWasPlanted) {
  const FaultInfo& fault = GetParam();
  int struck = 0;
  const bool materials = is_of_materials(fault.fault);
  for (const char* name : {materials ? "materials" : "proving_ground",
                           materials ? "materials_viscous" : "proving_ground_viscous"}) {
    const MachineReport report = prove(name, fault.fault, struck == 0);
    EXPECT_TRUE(report.pictures.good()) << name;
    if (!report.steps.strike) {
      EXPECT_TRUE(report.good()) << name;
      continue;
    }
    ++struck;
    ASSERT_NE(report.steps.mismatch, nullptr) << name << ": struck and not found";
    EXPECT_TRUE(report.steps.found_where_planted()) << name << ": " << text_of(*report.steps.mismatch);
  }
  EXPECT_GT(struck, 0) << "it strikes nowhere";
}

// Empties air. A picture may be drawn of anything, but the automaton knows no air that holds something.
state::Volume with_empty_air(state::Volume volume) {
  worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
    if (volume.solid.test(x, y, z) || volume.liquid.test(x, y, z) || volume.inert.test(x, y, z)) return;
    const state::Slot at = volume.at(x, y, z);
    volume.amount[at] = 0;
    volume.heat[at] = 0;
  });
  return volume;
}

// Plants the ray caster's faults in pictures in which they strike. The pipeline computes two steps of their
// matter.
class PlantedInScreen : public testing::TestWithParam<raycast::FaultInfo> {};

TEST_P(PlantedInScreen, IsFoundWhereItWasPlanted) {
  using namespace raycast::fault_pictures;
  const raycast::FaultInfo& fault = GetParam();
  const auto report_of = [&](const Case& one) {
    MachineOptions options;
    options.steps.steps = 2;
    options.picture.configuration = one.configuration;
    options.picture.fault = fault.fault;
    const test::HostilePicture& p = one.picture;
    return verify_machine({rule::Parameters{},
                           0,
                           *run::implementations().find("reference"),
                           {},
                           {with_empty_air(p.volume), p.look, p.light, p.terrain, p.camera, p.setting}},
                          options);
  };
  bool struck = false;
  const auto look_at = [&](const Case& one, const std::string& where) {
    const MachineReport report = report_of(one);
    ASSERT_EQ(report.steps.mismatch, nullptr) << where << text_of(*report.steps.mismatch);
    if (!report.pictures.strike) {
      ASSERT_TRUE(report.good()) << where;
      return;
    }
    struck = true;
    ASSERT_FALSE(report.pictures.good()) << where << ": struck and not found";
    EXPECT_TRUE(report.pictures.found_where_planted()) << where;
  };
  for (const Made& made : made_for(fault.fault))
    if (!struck) look_at(made.picture, made.name);
  for (int seed = 0; seed < 150 && !struck && !HasFatalFailure(); ++seed)
    look_at(hostile(seed, is_of_clear_matter(fault.fault)), "seed " + std::to_string(seed));
  EXPECT_TRUE(struck) << "it strikes nowhere";
}

// Chooses one fault of eight, for the quick tests.
template <class Info>
std::vector<Info> each_eighth(std::span<const Info> faults) {
  std::vector<Info> chosen;
  for (std::size_t i = 0; i < faults.size(); i += 8) chosen.push_back(faults[i]);
  return chosen;
}

INSTANTIATE_TEST_SUITE_P(Some, PlantedInStream, testing::ValuesIn(each_eighth<FaultInfo>(all_faults())),
                         [](const auto& chosen) { return identifier(chosen.param.name); });
INSTANTIATE_TEST_SUITE_P(Some, PlantedInScreen,
                         testing::ValuesIn(each_eighth<raycast::FaultInfo>(raycast::all_faults())),
                         [](const auto& chosen) { return identifier(chosen.param.name); });
INSTANTIATE_TEST_SUITE_P(Long, PlantedInStream, testing::ValuesIn(all_faults().begin(), all_faults().end()),
                         [](const auto& chosen) { return identifier(chosen.param.name); });
INSTANTIATE_TEST_SUITE_P(Long, PlantedInScreen,
                         testing::ValuesIn(raycast::all_faults().begin(), raycast::all_faults().end()),
                         [](const auto& chosen) { return identifier(chosen.param.name); });

}  // namespace
}  // namespace voxmelt::hwmodel
