// Every fault that can be planted in the ray caster is found: the first difference names its stage, pixel and
// sample. Some need pictures that are made for them.
#include "hwmodel/caster/faults/faults.h"

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "hwmodel/caster/check/verify_picture.h"
#include "tests/hwmodel/caster/faults/fault_pictures.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel::raycast {

void PrintTo(const FaultInfo& fault, std::ostream* out) { *out << fault.name; }  // names the test's parameter

namespace {

using namespace fault_pictures;

PictureReport verify(const Case& one, Fault fault) {
  PictureOptions options;
  options.configuration = one.configuration;
  options.fault = fault;
  const test::HostilePicture& p = one.picture;
  return verify_picture({p.volume, p.look, p.light, p.terrain, p.camera, p.setting}, options);
}

std::string text_of(const PictureReport& report) {
  std::string text;
  if (report.strike)
    text += "planted in " + report.strike->stage + ", pixel " + std::to_string(report.strike->x) + ' ' +
            std::to_string(report.strike->y) + ", sample " + std::to_string(report.strike->sample) + '\n';
  return text + (report.difference ? text_of(*report.difference) : "") + report.hang +
         std::to_string(report.different_bytes) + " pixels differ";
}

class PlantedInCaster : public testing::TestWithParam<FaultInfo> {};

TEST_P(PlantedInCaster, IsFoundWhereItWasPlanted) {
  const FaultInfo& fault = GetParam();
  int struck = 0;
  const auto look_at = [&](const Case& one, const std::string& where) {
    const PictureReport report = verify(one, fault.fault);
    if (!report.strike) {
      ASSERT_TRUE(report.good()) << where << ": nothing struck, but " << text_of(report);
      return;
    }
    ++struck;
    ASSERT_FALSE(report.good()) << where << ": struck and not found";
    EXPECT_EQ(report.strike->stage, fault.stage);
    ASSERT_TRUE(report.found_where_planted()) << where << ": " << text_of(report);
  };
  for (const Made& made : made_for(fault.fault)) {
    look_at(made.picture, made.name);
    if (HasFatalFailure()) return;
  }
  for (int seed = 0; seed < 150 && struck < 3 && !HasFatalFailure(); ++seed)
    look_at(hostile(seed, is_of_clear_matter(fault.fault)), "seed " + std::to_string(seed));
  EXPECT_GE(struck, 3) << "hardly any picture in which the fault can strike";
}

INSTANTIATE_TEST_SUITE_P(Some, PlantedInCaster, testing::ValuesIn(some_of(all_faults())),
                         [](const auto& chosen) {
                           std::string name;
                           for (const char c : chosen.param.name) name += c == '-' ? '_' : c;
                           return name;
                         });

// Without a fault these pictures are good. So this test fails if someone plants these bugs in the sources.
TEST(PlantedInCaster, PicturesThatWereMadeForThemAreGood) {
  for (const Fault fault : {Fault::walk_box, Fault::walk_block, Fault::crossing_stale, Fault::cache_tag_bits})
    for (const Made& made : made_for(fault)) {
      const PictureReport report = verify(made.picture, Fault::none);
      EXPECT_TRUE(report.good()) << made.name << ": " << text_of(report);
      EXPECT_GT(report.compared, 5000) << made.name;
    }
}

TEST(PlantedInCaster, ThereAreAtLeastFifty) { EXPECT_GE(all_faults().size(), 50u); }

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
