// The checker compares all that it should, and names the cause: software, widths or channels.
#include "hwmodel/pipeline/check/checker.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/automaton/state/fields.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"

namespace voxmelt::hwmodel {
namespace {

// Finds a world with every stage but the source, in which `strikes` holds.
Start warm_start(const std::function<bool(const Start&)>& strikes = [](const Start&) { return true; }) {
  for (std::uint64_t seed = 0;; ++seed) {
    Start start = hostile_start(seed, rule::Law::paper, {7, 6, 5});
    const rule::Heat& heat = start.parameters.heat;
    if (!heat.enabled || heat.neighbours != 26 || heat.convection == 0 || !heat.air || heat.radiation)
      continue;
    start.parameters.vents.clear();
    start.parameters.drains.clear();
    start.parameters.open_border = false;
    start.step = 1;
    if (strikes(start)) return start;
  }
}

// Names the error that the reference makes after a phase of step 3.
enum class Wrong { liquid, amount, heat, books };
void drop_a_liquid_cell(state::Volume& volume) {
  bool done = false;
  worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
    if (done || !volume.liquid.test(x, y, z)) return;
    volume.liquid.set(x, y, z, false);
    done = true;
  });
}
template <Wrong wrong>
class Damaged final : public step::HostStepper {
 public:
  static std::unique_ptr<step::Stepper> create(const rule::Parameters& parameters, state::Grid grid,
                                               const step::Tuning&) {
    return std::make_unique<Damaged>(parameters, grid);
  }
  Damaged(const rule::Parameters& parameters, state::Grid grid) : right_(parameters, grid) {}
  void change_sources(const rule::Parameters& parameters) override { right_.change_sources(parameters); }
  void run(step::Phase phase, step::Moment step, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override {
    right_.run(phase, step, irradiance, volume, ledger);
    if (step.step != 3 || phase != step::Phase::melt) return;
    if (wrong == Wrong::liquid) drop_a_liquid_cell(volume);
    if (wrong == Wrong::amount) ++volume.amount[volume.at(6, 2, 4)];
    if (wrong == Wrong::heat) ++volume.heat[volume.at(6, 2, 4)];
    if (wrong == Wrong::books) ++ledger.energy.melted;
  }

 private:
  scalar::Reference right_;
};

template <Wrong wrong>
std::string field_found_in_software() {
  const Start start = warm_start();
  const step::Implementation damaged{"damaged", "", Damaged<wrong>::create};
  VerifyOptions options;
  options.steps = 6;
  options.configuration.cascade = 2;
  const VerifyReport report = verify(start.parameters, start.volume, start.step, damaged, {}, options);
  if (report.mismatch == nullptr) return "nothing";
  EXPECT_EQ(report.mismatch->kind, Mismatch::Kind::software);
  EXPECT_EQ(report.mismatch->where, "damaged");
  EXPECT_EQ(report.mismatch->phase, step::Phase::melt);
  EXPECT_EQ(report.mismatch->step, 3u);
  EXPECT_EQ(report.steps, 2u) << "of a pass that was not done";
  if (wrong == Wrong::amount || wrong == Wrong::heat) {
    EXPECT_EQ((std::array{report.mismatch->x, report.mismatch->y, report.mismatch->z}),
              (std::array{6, 2, 4}));
  }
  return report.mismatch->field;
}

TEST(Checker, ASoftwareKernelThatDiffersIsNamed) {
  EXPECT_EQ(field_found_in_software<Wrong::liquid>(), "state");
  EXPECT_EQ(field_found_in_software<Wrong::amount>(), "amount");
  EXPECT_EQ(field_found_in_software<Wrong::heat>(), "heat");
  EXPECT_EQ(field_found_in_software<Wrong::books>(), "ledger");
}

TEST(Checker, AMissingStageIsNamed) {
  const Start start = warm_start();
  std::vector<StageKind> stages = stages_of_step({start.parameters, {start.volume.grid, 4}});
  std::erase_if(stages, [](StageKind stage) { return phase_of(stage) == step::Phase::heat; });
  Expectation expectation(start.parameters, start.volume, start.step, run::implementations().widest(), {},
                          stages);
  const std::unique_ptr<Mismatch> found = expectation.step(true).mismatch;
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->kind, Mismatch::Kind::missing);
  EXPECT_EQ(found->phase, step::Phase::heat);
  EXPECT_EQ(found->step, start.step);
}

TEST(Checker, EverySecondStepAndTheLastAreCompared) {
  const Start start = warm_start();
  VerifyOptions options;
  options.steps = 5;
  options.every = 2;
  options.configuration.cascade = 3;
  int polls = 0;
  options.poll = [&] { ++polls; };
  const VerifyReport report =
      verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  ASSERT_EQ(report.mismatch, nullptr);
  const auto cells = static_cast<std::int64_t>(start.volume.grid.cells());
  const std::int64_t stages =
      std::count_if(report.stages.begin(), report.stages.end(),
                    [](const StageReport& s) { return phase_of(s.kind) && s.cascade == 0; });
  EXPECT_EQ(report.compared_cells, 3 * stages * cells) << "steps 2, 4 and 5";
  EXPECT_EQ(report.software_cells, 5 * step::kPhaseCount * cells) << "the software after every phase";
  EXPECT_EQ(report.cell_steps, 5 * cells);
  EXPECT_EQ(report.passes, 2);
  EXPECT_EQ(report.steps, 5u);
  EXPECT_GE(polls, 5) << "once a step at least";
}

// Stands for the stage source, and spoils one token of step 1: the first one that is air, or is not.
class SpoilsAToken final : public Stage {
 public:
  SpoilsAToken(const Design& design, bool of_air, Cell with)
      : Stage(StageKind::source, design, 0), of_air_(of_air), with_(with) {}

 private:
  void advance(const Cell* in, Cell* out) override {
    std::copy(in, in + lanes(), out);
    const bool air = std::all_of(in, in + lanes(), [](const Cell& cell) { return cell.air(); });
    const bool within = came().x + lanes() <= shape().grid.x;
    if (done_ || step() != 1 || air != of_air_ || !within) return;
    std::fill(out, out + lanes(), with_);
    done_ = true;
  }

  bool of_air_, done_ = false;
  Cell with_;
};

std::string field_found_in_a_token(bool of_air, Cell with) {
  Start start = warm_start();
  worlds::for_each({0, 3, 0, 7, 6, 5}, [&](int x, int y, int z) {  // air in its upper half
    state::for_each_field([&](const auto& row) {
      if (!(start.volume.*row.column).empty()) state::set_value(start.volume.*row.column, x, y, z, 0);
    });
  });
  start.parameters.vents.push_back(
      {.region = {}, .from = 1000, .until = 1001});  // so there is a stage for sources
  VerifyOptions options;
  options.steps = 2;
  options.configuration.lanes = 4;  // as many cells as the checker looks at together
  options.make = [&](StageKind kind, const Design& design) -> std::unique_ptr<Stage> {
    if (kind == StageKind::source) return std::make_unique<SpoilsAToken>(design, of_air, with);
    return make_stage(kind, design);
  };
  const VerifyReport report =
      verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  if (report.mismatch == nullptr) return "nothing";
  EXPECT_EQ(report.mismatch->where, "source");
  EXPECT_EQ(report.mismatch->step, 1u);
  return report.mismatch->field;
}

TEST(Checker, AirIsComparedAsWell) {
  Cell empty;
  empty.amount = 0;
  empty.state = State::air;
  EXPECT_EQ(field_found_in_a_token(true, empty), "nothing") << "it was that before";
  EXPECT_EQ(field_found_in_a_token(false, empty), "state") << "what a token held is lost";
  Cell warm = empty;
  warm.heat = 1;
  EXPECT_EQ(field_found_in_a_token(true, warm), "heat");
  Cell given = empty;
  given.pattern = 1;
  EXPECT_EQ(field_found_in_a_token(true, given), "pattern");
}

// Without stalls, a token is at a stage when all stages before it have waited for their lags.
TEST(Checker, AMismatchHasItsLaneItsCycleAndTheStateBefore) {
  const Configuration c{4, 3, 2, 0};
  VerifyReport report;
  const Start start = warm_start([&](const Start& world) {
    report = lockstep(world, c, 6, Fault::convection_downwards, 3);
    return report.strike.has_value();
  });
  ASSERT_TRUE(report.mismatch != nullptr && report.found_where_planted());
  const Mismatch& m = *report.mismatch;
  ASSERT_EQ(m.where, "convection");
  ASSERT_EQ(m.step, 3u);
  EXPECT_EQ(m.cascade, 2) << "the third step of the first pass";
  EXPECT_EQ(m.lane, m.x % c.lanes);
  const Shape shape{start.volume.grid, c.lanes};
  std::int64_t cycle = stream_order(shape, m.x, m.y, m.z) / c.lanes;
  for (const StageReport& stage : report.stages) {
    if (!phase_of(stage.kind)) continue;
    cycle += stage.lag + 1;
    if (stage.cascade == m.cascade && name_of(stage.kind) == m.where) break;
  }
  EXPECT_EQ(m.cycle, cycle);
  EXPECT_EQ(report.cycles, m.cycle + 1) << "the pass ends with the cycle of the first mismatch";

  // The state before convection is that of step 3 after its conduction.
  run::Simulation simulation(start.parameters, start.volume, worlds::implementation("reference"));
  simulation.begin_at(start.step);
  worlds::steps(simulation, 2);
  rule::Parameters only_conduction = start.parameters;
  only_conduction.heat.convection = 0;
  only_conduction.heat.air = false;
  run::Simulation before(only_conduction, simulation.volume(), worlds::implementation("reference"));
  before.begin_at(3);
  for (const step::Phase phase : {step::Phase::source, step::Phase::heat}) before.run_phase(phase);
  EXPECT_EQ(m.neighbourhood, neighbourhood(before.volume(), m.x, m.y, m.z));
}

// The lines around a mismatch show the state that its stage was given. If waves are kept, the pipeline goes
// on, and its later results are wrong, too: the lines stay those of the first cell.
TEST(Checker, TheCellsAroundAMismatchAreThoseBeforeItsStage) {
  const auto verified = [](const Start& start) {
    return lockstep(start, {4, 1, 2, 0}, 1, Fault::gravity_one_more, start.step);
  };
  const Start start = warm_start([&](const Start& s) { return verified(s).strike.has_value(); });
  const VerifyReport report = verified(start);
  ASSERT_TRUE(report.mismatch != nullptr && report.found_where_planted());
  const Mismatch& m = *report.mismatch;
  ASSERT_EQ(m.where, "gravity");
  run::Simulation before(start.parameters, start.volume, worlds::implementation("reference"));
  before.begin_at(start.step);
  for (const step::Phase phase : {step::Phase::source, step::Phase::heat, step::Phase::melt})
    before.run_phase(phase);
  const std::vector<std::string> around = neighbourhood(before.volume(), m.x, m.y, m.z);
  before.run_phase(step::Phase::gravity);
  ASSERT_NE(around, neighbourhood(before.volume(), m.x, m.y, m.z)) << "before and after look alike";
  EXPECT_EQ(m.neighbourhood, around);

  VerifyOptions options;
  options.steps = 1;
  options.configuration = {4, 1, 2, 0};
  options.fault = Fault::gravity_one_more;
  options.fault_step = start.step;
  options.waves = true;
  const VerifyReport kept =
      verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  ASSERT_TRUE(kept.mismatch != nullptr && !kept.waves.empty());
  EXPECT_EQ(kept.mismatch->neighbourhood, around);
}

// In steps that are not compared behind the stages, the written volume still is compared.
TEST(Checker, TheWrittenVolumeIsComparedAfterEveryPass) {
  VerifyOptions options;
  options.steps = options.every = 6;
  options.configuration = {4, 1, 2, 0};
  options.fault = Fault::apply_flow_lost;
  options.fault_step = 2;
  const auto verified = [&](const Start& start) {
    return verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  };
  const Start start = warm_start([&](const Start& s) { return verified(s).strike.has_value(); });
  const VerifyReport report = verified(start);
  ASSERT_TRUE(report.strike && report.mismatch != nullptr);
  EXPECT_EQ(report.mismatch->kind, Mismatch::Kind::memory);
  EXPECT_EQ(report.mismatch->where, "writer");
  EXPECT_EQ(report.mismatch->step, report.strike->step);
  run::Simulation simulation(start.parameters, start.volume, worlds::implementation("reference"));
  simulation.begin_at(start.step);
  while (simulation.step_number() <= report.strike->step) simulation.step();
  EXPECT_NE(report.digest, state::digest(simulation.volume()))
      << "the digest is the model's, not the software's";
}

// A visitor may end the run before any step has been compared behind its stages.
TEST(Checker, AVisitorMayEndTheRunEarly) {
  const Start start = warm_start();
  VerifyOptions options;
  options.steps = options.every = 6;
  options.visit_every = 2;
  options.visit = [](const state::Volume&, const VerifyReport&) { return false; };
  const VerifyReport report =
      verify(start.parameters, start.volume, start.step, run::implementations().widest(), {}, options);
  EXPECT_EQ(report.mismatch, nullptr);
  EXPECT_EQ(report.steps, 2u);
}

// A vent brings more energy than a cell can hold. No scene file can say so, but the wire would notice.
TEST(Checker, AValueTooWideForItsWireIsReportedWithItsStage) {
  Start start = hostile_start(3, rule::Law::paper, {4, 4, 4});
  start.parameters.heat = {};
  start.parameters.drains.clear();
  start.parameters.open_border = false;
  start.parameters.vents = {{{{24, 24, 24}, 400}, 60000, 0, 8000, 2, 9}};
  start.volume = state::Volume({4, 4, 4});
  worlds::put_solid(start.volume, 0, 0, 0);
  VerifyOptions options;
  options.steps = 4;
  options.configuration.cascade = 4;
  const VerifyReport report =
      verify(start.parameters, start.volume, 0, worlds::implementation("reference"), {}, options);
  ASSERT_NE(report.mismatch, nullptr);
  EXPECT_EQ(report.mismatch->kind, Mismatch::Kind::width);
  EXPECT_EQ(report.mismatch->where, "source");
  EXPECT_EQ(report.mismatch->phase, step::Phase::source);
  EXPECT_EQ(report.mismatch->step, 2u);
  EXPECT_EQ(report.mismatch->cascade, 2);
  EXPECT_EQ(text_of(*report.mismatch),
            "first mismatch (width): source\n"
            "  step 2, phase source, cascade position 2, lane 1, cycle 55\n"
            "  cell (1, 0, 0): the value 117187 does not fit into 16 bits\n");
}

TEST(Checker, TheFailingStageIsNotTheFirst) {
  Start start = hostile_start(3, rule::Law::paper, {3, 3, 3});
  start.parameters.materials.clear();  // else weights lie in their tables
  start.parameters.heat = {};
  start.parameters.heat.enabled = true;
  start.parameters.heat.weight_face = 65535;  // no scene file can say so
  start.parameters.materials.clear();
  start.parameters.vents = {{{{24, 24, 24}, 0}, 1, 0, 0, 50, 51}};
  start.parameters.drains.clear();
  start.parameters.open_border = false;
  start.volume = state::Volume({3, 3, 3});
  worlds::for_each(worlds::whole(start.volume.grid),
                   [&](int x, int y, int z) { worlds::put_solid(start.volume, x, y, z, 4096, 65535); });
  worlds::put_solid(start.volume, 1, 1, 1, 4096, 0);
  VerifyOptions options;
  options.steps = 1;
  const VerifyReport report =
      verify(start.parameters, start.volume, 0, worlds::implementation("reference"), {}, options);
  ASSERT_NE(report.mismatch, nullptr);
  EXPECT_EQ(report.mismatch->kind, Mismatch::Kind::width);
  EXPECT_EQ(report.mismatch->where, "conduction");
  EXPECT_EQ(report.mismatch->phase, step::Phase::heat);
}

// If a token leaves a channel changed, in any field or side band, the checker notices it there.
TEST(Checker, AChannelThatChangesAnythingIsNamed) {
  const Start start = warm_start();
  const std::vector<std::pair<std::string, void (*)(Cell&)>> changes{
      {"state", [](Cell& cell) { cell.state = State::solid; }},
      {"amount", [](Cell& cell) { cell.amount = 1; }},
      {"energy", [](Cell& cell) { cell.energy = 1; }},
      {"heat", [](Cell& cell) { cell.heat = 1; }},
      {"pattern", [](Cell& cell) { cell.pattern = 1; }},
      {"beside a wall", [](Cell& cell) { cell.beside_wall = 1; }},
      {"head", [](Cell& cell) { cell.head = 1; }}};
  for (const auto& [field, change] : changes)
    for (const bool last : {false, true}) {  // the last channel is before the writer
      Pipeline pipeline(start.parameters, start.volume.grid, {4, 2, 2, 0});
      const int channel = last ? static_cast<int>(pipeline.channels().size()) - 1 : 2;
      Checker checker(pipeline);
      checker.begin_train();
      checker.add_pass({{.first = 30}, {}, nullptr, {}, nullptr});
      std::vector<Cell> lanes(4);
      checker.entered(channel, 0, lanes.data());
      checker.left(channel, 0, lanes.data());
      EXPECT_EQ(checker.mismatch(), nullptr);
      checker.entered(channel, 1, lanes.data());
      change(lanes[3]);
      checker.left(channel, 1, lanes.data());
      ASSERT_NE(checker.mismatch(), nullptr) << field;
      EXPECT_EQ(checker.mismatch()->kind, Mismatch::Kind::channel) << field;
      EXPECT_EQ(checker.mismatch()->where, pipeline.channels()[static_cast<std::size_t>(channel)].name);
      EXPECT_EQ(checker.mismatch()->field, field);
      EXPECT_EQ(checker.mismatch()->lane, 3);
      EXPECT_EQ(checker.mismatch()->y, 1);
    }
}

// Returns the checker's complaint about one correct step of the pipeline, when the checker expects another
// result.
std::unique_ptr<Mismatch> said_of(void (*spoil)(state::Volume& left, state::Holdings& held), bool coded) {
  const Start start = hostile_start(4, rule::Law::paper, {6, 7, 5});
  run::Simulation software(start.parameters, start.volume, worlds::implementation("reference"));
  software.step();
  auto left = std::make_shared<state::Volume>(software.volume());
  state::Holdings held = state::holdings(*left);
  spoil(*left, held);
  Configuration configuration{4, 1, 2, 0};
  configuration.coded = coded;
  Pipeline pipeline(start.parameters, start.volume.grid, configuration);
  Checker checker(pipeline);
  pipeline.watch(&checker);
  const Pass pass{.first = 0};
  checker.begin_train();
  checker.add_pass({pass, {{}}, nullptr, held, left});
  state::Volume volume = start.volume;
  std::optional<IrradianceStream> light;
  if (software.irradiance() != nullptr) light.emplace(*software.irradiance(), pipeline.design().shape);
  pipeline.run_train(
      pass, [] { return std::nullopt; }, light ? &*light : nullptr, volume);
  return checker.mismatch() == nullptr ? nullptr : std::make_unique<Mismatch>(*checker.mismatch());
}

TEST(Checker, EachOfTheBooksIsCompared) {
  EXPECT_EQ(said_of([](state::Volume&, state::Holdings&) {}, false), nullptr);
  const std::vector<std::pair<std::string, void (*)(state::Volume&, state::Holdings&)>> wrong{
      {"mass", [](state::Volume&, state::Holdings& held) { ++held.liquid; }},
      {"mass", [](state::Volume&, state::Holdings& held) { --held.solid; }},
      {"energy", [](state::Volume&, state::Holdings& held) { ++held.energy; }},
      {"heat", [](state::Volume&, state::Holdings& held) { ++held.heat; }}};
  for (const auto& [field, spoil] : wrong) {
    const auto mismatch = said_of(spoil, false);
    ASSERT_NE(mismatch, nullptr) << field;
    EXPECT_EQ(mismatch->kind, Mismatch::Kind::books);
    EXPECT_EQ(mismatch->field, field);
    EXPECT_EQ(std::abs(mismatch->expected - mismatch->actual), 1);
  }
}

// A coded column arrives as a whole, and is compared later. The mismatch still names the cycle of its token.
TEST(Checker, AWrongMemoryNamesTheCycleOfItsToken) {
  const auto spoil = [](state::Volume& left, state::Holdings&) { ++left.amount[left.at(5, 3, 1)]; };
  const auto plain = said_of(spoil, false), coded = said_of(spoil, true);
  ASSERT_TRUE(plain != nullptr && coded != nullptr);
  for (const auto* mismatch : {plain.get(), coded.get()}) {
    EXPECT_EQ(mismatch->kind, Mismatch::Kind::memory);
    EXPECT_EQ(mismatch->field, "amount");
    EXPECT_EQ(mismatch->x, 5);
    EXPECT_EQ(mismatch->y, 3);
    EXPECT_EQ(mismatch->z, 1);
  }
  EXPECT_EQ(coded->cycle, plain->cycle);
}

}  // namespace
}  // namespace voxmelt::hwmodel
