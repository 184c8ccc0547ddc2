// Settle and viscous spread against the reference. Spread reads what settle shows, so the two run together.
#include "tests/hwmodel/stage_run.h"

namespace voxmelt::hwmodel {
namespace {

using step::Phase;

void make_excess(const Design& design, Stages& stages, FedStage*&) { stages.push_back(make_settle(design)); }
void make_both(const Design& design, Stages& stages, FedStage*& fed) {
  make_excess(design, stages, fed);
  stages.push_back(make_viscous_spread(design));
}

TEST(ViscousStages, SettleIsTheReferences) {
  for (const std::uint64_t seed : {0u, 1'000'000u, 2'000'000u})
    expect_phase(rule::Law::viscous, Phase::excess, make_excess, 200, 3, seed);
}

TEST(ViscousStages, SpreadIsTheReferences) {
  for (const std::uint64_t seed : {0u, 3'000'000u, 4'000'000u})
    expect_phases(rule::Law::viscous, Phase::excess, Phase::spread, make_both, 200, 3, seed);
}

}  // namespace
}  // namespace voxmelt::hwmodel
