// Machines are sources of tokens: two models run beside each other, a model beside its trace, and traces lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "hwmodel/check/compare.h"
#include "hwmodel/check/trace.h"
#include "hwmodel/pipeline/faults/planted_stages.h"
#include "hwmodel/pipeline/model/pipeline.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "tests/hwmodel/pipeline/check/lockstep_world.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel {
namespace {

using Kind = TokenDifference::Kind;

// Finds a world of the paper's law in which matter falls, without radiation.
Start falling() {
  for (std::uint64_t seed = 0;; ++seed) {
    Start start = hostile_start(seed, rule::Law::paper, {7, 6, 5});
    if (start.parameters.heat.radiation) continue;
    start.parameters.vents.clear();
    start.parameters.drains.clear();
    start.parameters.open_border = false;
    return start;
  }
}

// Holds a pipeline that runs one pass of two time steps.
struct Streamed {
  explicit Streamed(const Start& the_start, std::uint64_t stall_seed = 0, const StageMaker& make = make_stage)
      : start(the_start),
        configuration{.lanes = 2, .cascade = 2, .fifo_depth = 2, .stall_seed = stall_seed},
        machine(the_start.parameters, the_start.volume.grid, configuration, make) {}
  PassEnd run() {
    state::Volume volume = start.volume;
    return machine.run_pass({.first = start.step, .steps = 2}, nullptr, volume);
  }
  const Start& start;
  Configuration configuration;
  Pipeline machine;
};

TokenTrace trace_of(const Start& start) {
  Streamed streamed(start);
  TraceRecorder recorder(streamed.machine);
  EXPECT_TRUE(streamed.run().complete);
  return recorder.trace();
}

// Writes a trace to a file and reads it back.
TokenTrace copied(const TokenTrace& trace) {
  std::stringstream file;
  write_trace(trace, file);
  return read_trace(file);
}

// Plays a trace in the place of one machine, beside a live one.
std::optional<TokenDifference> beside_machine(const TokenTrace& trace, const Start& start, Compared how) {
  TracePlayer player(trace);
  Streamed live(start);
  TokenComparison comparison(live.machine, player, how);
  live.run();
  player.play();
  const std::optional<TokenDifference> found = comparison.end();
  EXPECT_TRUE(found || comparison.compared() > 300) << comparison.compared();
  return found;
}

TEST(Tokens, StallsChangeTheCyclesAndNotTheTokens) {
  const Start start = falling();
  for (const Compared how : {Compared::in_order, Compared::in_same_cycle}) {
    Streamed calm(start), stalled(start, 5);
    TokenComparison comparison(calm.machine, stalled.machine, how);
    calm.run();
    stalled.run();
    const std::optional<TokenDifference> found = comparison.end();
    if (how == Compared::in_order) {
      EXPECT_FALSE(found) << text_of(*found);
      EXPECT_GT(comparison.compared(), 300);
    } else {
      ASSERT_TRUE(found);
      EXPECT_EQ(found->kind, Kind::cycle) << text_of(*found);
      EXPECT_LT(found->expected_cycle, found->actual_cycle) << "a stall makes nothing earlier";
    }
  }
}

TEST(Tokens, AReplayedTraceIsOneMoreMachine) {
  const Start start = falling();
  const TokenTrace trace = copied(trace_of(start));
  for (const Compared how : {Compared::in_order, Compared::in_same_cycle}) {
    const auto found = beside_machine(trace, start, how);
    EXPECT_FALSE(found) << text_of(*found);
  }
}

TEST(Tokens, OneWrongNumberIsNamed) {
  const Start start = falling();
  const TokenTrace right = trace_of(start);
  for (const std::size_t part : {7U, 3U, 2U}) {
    TokenTrace wrong = right;
    const TokenTrace::Event event = wrong.events[wrong.events.size() / part];
    const TokenType& type = wrong.channels[event.channel].type;
    const std::size_t wire = 1, lane = 1;  // the amount
    std::int64_t& value = wrong.values[event.first + lane * type.wires.size() + wire];
    const std::int64_t before = value++;
    const auto ordinal = std::count_if(
        right.events.begin(), right.events.begin() + static_cast<std::ptrdiff_t>(right.events.size() / part),
        [&](const auto& other) { return other.channel == event.channel && other.enters == event.enters; });
    const auto found = beside_machine(copied(wrong), start, Compared::in_order);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->kind, Kind::value);
    EXPECT_EQ(found->channel, right.channels[event.channel].name);
    EXPECT_EQ(found->enters, event.enters);
    EXPECT_EQ(found->ordinal, ordinal);
    EXPECT_EQ(found->wire, "amount");
    EXPECT_EQ(found->lane, 1);
    EXPECT_EQ(found->expected, before);
    EXPECT_EQ(found->actual, before + 1);
  }
}

TEST(Tokens, ALateATooManyAndAMissingTokenAreNamed) {
  const Start start = falling();
  const TokenTrace right = trace_of(start);
  TokenTrace late = right;
  ++late.events.back().cycle;
  EXPECT_FALSE(beside_machine(late, start, Compared::in_order));
  const auto found_late = beside_machine(late, start, Compared::in_same_cycle);
  ASSERT_TRUE(found_late);
  EXPECT_EQ(found_late->kind, Kind::cycle);
  EXPECT_EQ(found_late->actual_cycle, right.events.back().cycle + 1);

  TokenTrace missing = right;
  missing.events.pop_back();
  const auto found_missing = beside_machine(missing, start, Compared::in_order);
  ASSERT_TRUE(found_missing);
  EXPECT_EQ(found_missing->kind, Kind::missing);
  EXPECT_EQ(found_missing->expected_cycle, right.events.back().cycle);

  TokenTrace extra = right;
  extra.events.push_back(right.events.back());
  const auto found_extra = beside_machine(extra, start, Compared::in_order);
  ASSERT_TRUE(found_extra);
  EXPECT_EQ(found_extra->kind, Kind::extra);

  TokenTrace other = right;
  other.channels.back().name = "nobody -> nowhere";
  const auto found_other = beside_machine(other, start, Compared::in_order);
  ASSERT_TRUE(found_other);
  EXPECT_EQ(found_other->kind, Kind::channel);
}

// The machine with a fault runs beside the one without. The first wrong token leaves the stage of the fault.
TEST(Tokens, APlantedFaultShowsBehindItsStage) {
  const Start start = falling();
  int found = 0;
  for (const Fault fault : {Fault::gravity_one_more, Fault::gravity_room, Fault::melt_stuck}) {
    FaultPlan plan(fault, start.step);
    Streamed right(start), wrong(start, 0, planted_stages(plan));
    TokenComparison comparison(right.machine, wrong.machine, Compared::in_order);
    right.run();
    wrong.run();
    const std::optional<TokenDifference> difference = comparison.end();
    EXPECT_EQ(difference.has_value(), plan.struck().has_value());
    if (!difference) continue;
    ++found;
    EXPECT_EQ(difference->kind, Kind::value);
    EXPECT_NE(difference->channel.find(": " + plan.struck()->where + " -> "), std::string::npos)
        << difference->channel;
  }
  EXPECT_GT(found, 0);
}

TEST(Tokens, ALineThatIsNoneHasItsNumber) {
  const std::string begin = "voxmelt trace 1\nchannel 0 1 2 a -> b\nwire 4 u x\n";
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"voxmelt trace 2\n", "line 1: "},
      {begin + "wire 65 u y\n", "line 4: "},
      {begin + "wire 4 x y\n", "line 4: "},
      {begin + "channel 0 1 2 again\n", "line 4: "},
      {begin + "channel 1 0 2 no lanes\n", "line 4: "},
      {begin + "3 0 put 1\n", "line 4: "},
      {begin + "train\n3 0 put 1 2\n", "line 5: "},
      {begin + "train\n3 0 put\n", "line 5: "},
      {begin + "train\n3 0 put x\n", "line 5: "},
      {begin + "train\n3 1 put 1\n", "line 5: "},
      {begin + "train\n3 0 give 1\n", "line 5: "},
      {begin + "train\n3 0 put 1\n2 0 get 1\n", "line 6: "},
      {begin + "train\nchannel 1 1 2 late\n", "line 5: "},
  };
  for (const auto& [text, place] : wrong) {
    std::istringstream file(text);
    try {
      read_trace(file);
      ADD_FAILURE() << text;
    } catch (const TraceError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(place, 0), 0U) << text << error.what();
    }
  }
  std::istringstream file(begin + "train\n3 0 put 1\ntrain\n2 0 get 1\n");
  EXPECT_EQ(read_trace(file).events.size(), 2U) << "cycles begin anew in a train";
}

// The ray caster is another source: a picture is drawn beside its own trace.
class Drawn {
 public:
  explicit Drawn(std::uint64_t seed) : picture_(test::hostile_picture(seed, 500)), uploader_(c_) {
    picture_.look.clear = {};
    field_.update(picture_.volume, picture_.look, picture_.terrain, 1);
    software_.update(field_, picture_.look, picture_.light, picture_.terrain, nullptr, 1);
    uploader_.update(software_.data(render::camera_in_integers(picture_.camera), render::Setting::fast),
                     nullptr);
  }
  raycast::RayCaster caster() { return {uploader_.registers(), uploader_.memory(), c_}; }

 private:
  test::HostilePicture picture_;
  raycast::Configuration c_;
  render::DensityField field_;
  render::Picture software_;
  raycast::Uploader uploader_;
};

TEST(Tokens, TheRayCasterIsASourceToo) {
  Drawn drawn(3);
  TokenTrace trace;
  {
    raycast::RayCaster caster(drawn.caster());
    TraceRecorder recorder(caster);
    ASSERT_TRUE(caster.draw_first().complete);
    trace = copied(recorder.trace());
  }
  raycast::RayCaster again(drawn.caster());
  TracePlayer player(trace);
  TokenComparison comparison(player, again, Compared::in_same_cycle);
  player.play();
  ASSERT_TRUE(again.draw_first().complete);
  const std::optional<TokenDifference> found = comparison.end();
  EXPECT_FALSE(found) << text_of(*found);
  EXPECT_GT(comparison.compared(), 1000);
}

}  // namespace
}  // namespace voxmelt::hwmodel
