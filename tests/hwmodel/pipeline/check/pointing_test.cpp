// The checker points to the stage that is wrong: side bands, lanes beyond the grid, memories, cycles.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/no_faults.h"
#include "hwmodel/pipeline/model/settle_stage.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

// Finds a world under the given law with walls that matter.
Start start_with_sides(rule::Law law, bool hot, state::Grid grid) {
  for (std::uint64_t seed = 0;; ++seed) {
    Start start = hostile_start(seed, law, grid);
    rule::Heat& heat = start.parameters.heat;
    if (heat.enabled != hot || heat.radiation) continue;
    start.parameters.flow.fall.hang = 2000;
    start.parameters.open_border = false;  // many drops hang beside the border
    return start;
  }
}

VerifyReport verified(const Start& start, const Configuration& configuration, std::uint32_t steps,
                      const StageMaker& make) {
  VerifyOptions options;
  options.steps = steps;
  options.configuration = configuration;
  options.make = make;
  return verify(start.parameters, start.volume, start.step, worlds::implementation("reference"), {}, options);
}

// Hands cells on, and lets a function change a token.
class Odd final : public Stage {
 public:
  using Strange = std::function<void(std::int64_t ordinal, Cell* out)>;
  Odd(StageKind kind, const Design& design, Strange strange)
      : Stage(kind, design, 0), strange_(std::move(strange)) {}
  std::int64_t rests_before = -1;  // the stage has no second input for one cycle before this token

 protected:
  void advance(const Cell* in, Cell* out) override {
    std::copy_n(in, lanes(), out);
    if (strange_) strange_(came().ordinal, out);
  }
  bool side_input_ready() override {
    if (came().ordinal != rests_before) return true;
    rests_before = -1;
    return false;
  }

 private:
  Strange strange_;
};

// Nothing melts in a world without matter, and where nothing freezes, so `melt` only hands on.
Start empty_start() {
  Start start = start_with_sides(rule::Law::paper, true, {6, 3, 3});
  start.parameters.vents.clear();
  start.parameters.drains.clear();
  start.parameters.material.freezing_point = 0;
  start.volume = state::Volume({6, 3, 3});
  return start;
}
StageMaker with_odd_melt(const Odd::Strange& strange, std::int64_t rests_before = -1) {
  return [=](StageKind kind, const Design& design) -> std::unique_ptr<Stage> {
    if (kind != StageKind::melt) return make_stage(kind, design);
    auto odd = std::make_unique<Odd>(kind, design, strange);
    odd->rests_before = rests_before;
    return odd;
  };
}

TEST(Pointing, ALaneBeyondTheGridMustHoldTheBorder) {
  const Start start = empty_start();
  ASSERT_EQ(verified(start, {4, 1, 2, 0}, 2, with_odd_melt({})).mismatch, nullptr);
  const VerifyReport report =
      verified(start, {4, 1, 2, 0}, 2, with_odd_melt([](std::int64_t ordinal, Cell* out) {
                 if (ordinal == 4) out[3].amount = 7;  // x = 7 of 6
               }));
  ASSERT_NE(report.mismatch, nullptr);
  EXPECT_EQ(report.mismatch->where, "melt");
  EXPECT_EQ(report.mismatch->field, "amount");
  EXPECT_EQ(report.mismatch->expected, 2048) << "the border is flat";
  EXPECT_EQ(report.mismatch->x, 7);
  EXPECT_EQ(report.mismatch->y, 1);
  EXPECT_EQ(report.mismatch->lane, 3);
}

TEST(Pointing, EveryBandIsComparedBehindTheStageThatMakesIt) {
  const Start start = empty_start();
  const std::vector<std::pair<std::string, void (*)(Cell&)>> changes{
      {"pattern", [](Cell& cell) { cell.pattern = 1; }},
      {"exposed axes", [](Cell& cell) { cell.exposed_axes = 1; }},
      {"beside a wall", [](Cell& cell) { cell.beside_wall = 1 - cell.beside_wall; }},
      {"touches", [](Cell& cell) { cell.touches = 1; }},
      {"set", [](Cell& cell) { cell.set = 1; }},
      {"in a run", [](Cell& cell) { cell.in_run = 1; }},
      {"head", [](Cell& cell) { cell.head = 1; }},
      {"limit", [](Cell& cell) { cell.limit = 1; }},
      {"mobility", [](Cell& cell) { cell.mobility = 1; }},
      {"dead zone", [](Cell& cell) { cell.dead = 1; }},
      {"shut", [](Cell& cell) { cell.shut = 1; }}};
  for (const auto& one : changes) {
    const std::string& field = one.first;
    const VerifyReport report =
        verified(start, {4, 1, 2, 0}, 1, with_odd_melt([&](std::int64_t ordinal, Cell* out) {
                   if (ordinal == 4) one.second(out[1]);
                 }));
    ASSERT_NE(report.mismatch, nullptr) << field;
    EXPECT_EQ(report.mismatch->where, "melt");
    EXPECT_EQ(report.mismatch->field, field);
    EXPECT_EQ(report.mismatch->x, 5);
  }
}

TEST(Pointing, AnAddressOutsideAMemoryNamesItsStage) {
  const VerifyReport report =
      verified(empty_start(), {4, 1, 2, 0}, 1, with_odd_melt([](std::int64_t ordinal, Cell*) {
                 TapLine<Cell> line(4, 3);
                 if (ordinal == 5) line.tap(4);
               }));
  ASSERT_NE(report.mismatch, nullptr);
  const Mismatch& m = *report.mismatch;
  EXPECT_EQ(m.kind, Mismatch::Kind::address);
  EXPECT_EQ(m.where, "melt");
  EXPECT_EQ(m.phase, step::Phase::melt);
  EXPECT_EQ(m.x, 4);
  EXPECT_EQ(m.y, 2);
  EXPECT_EQ(m.detail, "the address 4 lies outside a memory of 4 words");
}

TEST(Pointing, ALostCycleIsADifference) {
  const VerifyReport good = verified(empty_start(), {4, 2, 2, 0}, 2, with_odd_melt({}));
  ASSERT_EQ(good.mismatch, nullptr);
  const VerifyReport late = verified(empty_start(), {4, 2, 2, 0}, 2, with_odd_melt({}, 7));
  ASSERT_NE(late.mismatch, nullptr);
  EXPECT_EQ(late.mismatch->kind, Mismatch::Kind::cycles);
  EXPECT_EQ(late.mismatch->expected, good.cycles);
  EXPECT_GT(late.mismatch->actual, good.cycles);
  EXPECT_NE(late.mismatch->detail.find("melt of time step 0"), std::string::npos);
  const VerifyReport stalled = verified(empty_start(), {4, 2, 2, 9}, 2, with_odd_melt({}, 7));
  EXPECT_EQ(stalled.mismatch, nullptr) << "stalls cost cycles, too";
}

// Settle's second scan works on a column that has been turned round: its top comes first.
struct TooWideBehindTheTurn : NoFaults {
  std::int64_t coming = 0;  // the value is too wide when this token comes
  void lowered(auto& settle) const {
    if (settle.came().ordinal == coming) settle.words_[0].heat = 65536;
  }
};
TEST(Pointing, AValueTooWideBehindATurnNamesItsCell) {
  const Start start = start_with_sides(rule::Law::viscous, false, {6, 3, 3});
  const std::vector<std::pair<std::int64_t, int>> heights{{7, 2}, {8, 1}, {9, 0}};
  for (const auto& [coming, y] : heights) {
    TooWideBehindTheTurn faults;
    faults.coming = coming;
    const VerifyReport report =
        verified(start, {2, 1, 2, 0}, 1, [&](StageKind kind, const Design& design) -> std::unique_ptr<Stage> {
          if (kind != StageKind::settle) return make_stage(kind, design);
          return std::make_unique<Settle<TooWideBehindTheTurn>>(design, faults);
        });
    ASSERT_NE(report.mismatch, nullptr);
    EXPECT_EQ(report.mismatch->kind, Mismatch::Kind::width);
    EXPECT_EQ(report.mismatch->where, "settle");
    EXPECT_EQ(report.mismatch->x, 3) << "the second column of two cells, its last lane";
    EXPECT_EQ(report.mismatch->y, y);
    EXPECT_EQ(report.mismatch->z, 0);
  }
}

// Without stalls the writer takes a token when all stages before it have waited for their lags.
TEST(Pointing, AWrongMemoryNamesTheCycleOfItsToken) {
  VerifyOptions options;
  options.steps = options.every = 3;
  options.configuration = {4, 1, 2, 0};
  options.fault = Fault::gravity_one_more;
  options.fault_step = 1;
  int found = 0;
  for (std::uint64_t seed = 0; seed < 40 && found < 3; ++seed) {
    const Start start = hostile_start(seed, rule::Law::paper, {7, 5, 4});
    const VerifyReport report =
        verify(start.parameters, start.volume, 0, worlds::implementation("reference"), {}, options);
    if (!report.strike || report.mismatch == nullptr) continue;
    const Mismatch& m = *report.mismatch;
    if (m.kind != Mismatch::Kind::memory) continue;
    const Shape shape{start.volume.grid, 4};
    std::int64_t cycle = stream_order(shape, m.x, m.y, m.z) / 4 + 1;  // the reader's channel
    for (const StageReport& stage : report.stages)
      if (phase_of(stage.kind)) cycle += stage.lag + 1;
    EXPECT_EQ(m.cycle, cycle) << "seed " << seed;
    EXPECT_EQ(m.lane, m.x % 4);
    ++found;
  }
  EXPECT_EQ(found, 3);
}

// The same fault strikes in conduction, or in `walls` if the scene is cold.
TEST(Pointing, ASideThatIsMissedIsFoundInTheStageThatLooksRound) {
  std::set<std::string> places;
  for (const bool hot : {false, true}) {
    const Start start = start_with_sides(rule::Law::paper, hot, {9, 6, 5});
    for (const int lanes : {1, 2, 4}) {
      const VerifyReport report = lockstep(start, {lanes, 2, 2, 0}, 4, Fault::side_missed, 1);
      ASSERT_TRUE(report.strike && report.mismatch != nullptr);
      EXPECT_TRUE(report.found_where_planted()) << text_of(*report.mismatch);
      EXPECT_EQ(report.mismatch->field, "beside a wall");
      places.insert(report.strike->where);
    }
  }
  EXPECT_EQ(places, (std::set<std::string>{"conduction", "walls"}));
}

}  // namespace
}  // namespace voxmelt::hwmodel
