// The kinds of stages have the names and phases of docs/hardware/pipeline.md. Only stages of a time step can
// be made.

#include <cstddef>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "tests/hwmodel/pipeline/model/stage_run.h"

namespace voxmelt::hwmodel {
namespace {

struct Known {
  StageKind kind;
  const char *name, *phase;
};
constexpr Known kKnown[] = {{StageKind::reader, "reader", ""},
                            {StageKind::fall, "fall", ""},
                            {StageKind::source, "source", "source"},
                            {StageKind::conduction, "conduction", "heat"},
                            {StageKind::edges, "edges", "heat"},
                            {StageKind::corners, "corners", "heat"},
                            {StageKind::convection, "convection", "heat"},
                            {StageKind::exchange, "exchange", "heat"},
                            {StageKind::melt, "melt", "melt"},
                            {StageKind::walls, "walls", "gravity"},
                            {StageKind::gravity, "gravity", "gravity"},
                            {StageKind::pattern, "pattern", "spread"},
                            {StageKind::apply, "apply", "spread"},
                            {StageKind::settle, "settle", "excess"},
                            {StageKind::viscous_spread, "spread", "spread"},
                            {StageKind::feed, "feed", ""},
                            {StageKind::fall_feed, "fall feed", ""},
                            {StageKind::writer, "writer", ""}};

Design design_with_everything() {
  Design design{{}, {{3, 4, 2}, 2}};
  design.parameters.heat.enabled = design.parameters.heat.air = true;
  design.parameters.heat.air_temperature.resize(4);
  return design;
}

// Every value that has a name is a kind, and stands above.
TEST(StageKinds, AreAllKnownHere) {
  using Value = std::underlying_type_t<StageKind>;
  std::size_t named = 0;
  for (int value = 0; value <= std::numeric_limits<Value>::max(); ++value)
    named += name_of(static_cast<StageKind>(value)).empty() ? 0 : 1;
  EXPECT_EQ(named, std::size(kKnown));
}

TEST(StageKinds, NamesAndPhasesAreThePages) {
  for (const Known& known : kKnown) {
    EXPECT_EQ(name_of(known.kind), known.name);
    EXPECT_EQ(name_of(phase_of(known.kind)), known.phase) << known.name;
  }
}

TEST(StageKinds, AStageIsOfTheKindThatWasAskedFor) {
  const Design design = design_with_everything();
  int made = 0;
  for (const Known& known : kKnown) {
    if (!is_stage(known.kind)) {
      EXPECT_THROW(make_stage(known.kind, design), std::logic_error) << known.name;
      continue;
    }
    EXPECT_EQ(make_stage(known.kind, design)->name(), known.name);
    ++made;
  }
  EXPECT_EQ(made, 14);
}

TEST(StageKinds, WithoutFaultsAStageHoldsNothingForThem) { EXPECT_TRUE(std::is_empty_v<NoFaults>); }

}  // namespace
}  // namespace voxmelt::hwmodel
