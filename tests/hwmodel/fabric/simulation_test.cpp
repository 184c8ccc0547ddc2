// Several machines share one simulation: their jobs, their cycles, and the ends of their jobs.
#include "hwmodel/fabric/simulation.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

namespace voxmelt::hwmodel {
namespace {

// A machine of one block counts its cycles. Its job takes `length` of them.
class Counter {
 public:
  Counter(Simulation& simulation, const char* name) : part(simulation) {
    const Simulation::Scope scope(simulation);
    part.done = [this] { return counted >= length; };
    block_.emplace(name, simulation, part, [this] {
      if (part.cycle() == throws_in) throw std::runtime_error("broken");
      seen.push_back(part.cycle());
      if (part.cycle() < idle_from) ++part.moves;
      ++counted;
    });
    scope_of_ = &simulation;
  }
  ~Counter() {
    const Simulation::Scope scope(*scope_of_);
    block_.reset();
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;

  Part part;
  std::int64_t length = 10, counted = 0, throws_in = -1, idle_from = 1 << 30;
  std::vector<std::int64_t> seen;

 private:
  std::optional<Block> block_;
  Simulation* scope_of_ = nullptr;
};

TEST(Simulation, AJobTakesItsCyclesAndTheOthersGoOn) {
  Simulation simulation;
  Counter a(simulation, "a"), b(simulation, "b"), c(simulation, "c");
  b.length = 25;
  std::int64_t ticks = 0;
  simulation.after_blocks([&] { ++ticks; });
  simulation.begin(a.part);
  simulation.begin(b.part);
  simulation.run(a.part);
  EXPECT_EQ(a.part.end().cycles, 10);
  EXPECT_TRUE(a.part.end().complete);
  EXPECT_EQ(b.counted, 10);
  EXPECT_EQ(c.counted, 0) << "it has no job";
  EXPECT_EQ(ticks, 10);

  a.counted = 0;
  simulation.begin(a.part);  // from the next cycle on; b does not notice
  simulation.run(a.part);
  EXPECT_EQ(a.seen.size(), 20u);
  EXPECT_EQ(a.seen[10], 0) << "its cycles count from 0 again";
  EXPECT_EQ(b.counted, 20);
  simulation.run();
  EXPECT_EQ(b.part.end().cycles, 25);
  EXPECT_EQ(b.seen.back(), 24);
  EXPECT_EQ(a.counted, 10);
  EXPECT_EQ(ticks, 25);
}

TEST(Simulation, WhenAJobEndsAnotherOneMayBegin) {
  Simulation simulation;
  Counter a(simulation, "a"), b(simulation, "b");
  int jobs = 1;
  a.part.ended = [&] {
    if (jobs++ == 3) return;
    a.counted = 0;
    simulation.begin(a.part);
  };
  b.length = 100;
  simulation.begin(a.part);
  simulation.begin(b.part);
  simulation.run(b.part);
  EXPECT_EQ(a.seen.size(), 30u) << "three jobs, without a gap";
  EXPECT_FALSE(a.part.works());
}

TEST(Simulation, AJobEndsWhereItHangsIsStoppedOrBreaks) {
  Simulation simulation;
  Counter a(simulation, "a"), b(simulation, "b"), c(simulation, "c");
  a.length = b.length = c.length = 1 << 30;
  a.idle_from = 5;
  a.part.hang_after = 20;
  b.part.each_cycle = [&] {
    if (b.part.cycle() == 30) b.part.stop();
  };
  c.throws_in = 7;
  for (Counter* one : {&a, &b, &c}) simulation.begin(one->part);
  simulation.run();
  EXPECT_TRUE(a.part.end().hangs);
  EXPECT_EQ(a.part.end().cycles, 5 + 21);
  EXPECT_EQ(b.part.end().cycles, 31);
  EXPECT_FALSE(b.part.end().hangs || b.part.end().complete);
  EXPECT_EQ(c.part.end().cycles, 8);
  EXPECT_THROW(c.part.rethrow(), std::runtime_error);
  EXPECT_NO_THROW(c.part.rethrow()) << "once";
  EXPECT_NO_THROW(b.part.rethrow());
}

// A token that enters a channel in a cycle leaves it in the next one, whichever block runs first.
TEST(Simulation, ChannelsCommitBetweenCycles) {
  for (const bool consumer_first : {false, true}) {
    Simulation simulation;
    const Simulation::Scope scope(simulation);
    Part part(simulation);
    Link<int> link("link", 0, 1, 2, 0);
    std::vector<std::int64_t> came;
    std::vector<std::unique_ptr<Block>> blocks;
    const auto produce = [&] {
      if (link.fifo().ready()) *link.fifo().put() = static_cast<int>(part.cycle());
      link.tick();
    };
    const auto consume = [&] {
      if (link.fifo().valid()) came.push_back(part.cycle() - *link.fifo().get());
    };
    if (consumer_first) blocks.push_back(std::make_unique<Block>("consumer", simulation, part, consume));
    blocks.push_back(std::make_unique<Block>("producer", simulation, part, produce));
    if (!consumer_first) blocks.push_back(std::make_unique<Block>("consumer", simulation, part, consume));
    part.done = [&] { return came.size() == 10; };
    part.each_cycle = [&] { ++part.moves; };
    simulation.begin(part);
    simulation.run(part);
    EXPECT_EQ(came, std::vector<std::int64_t>(10, 1));
    EXPECT_EQ(part.end().cycles, 11);
  }
}

TEST(Simulation, TwoRunInTurn) {
  Simulation one, other;
  Counter a(one, "a"), b(other, "b");
  for (int i = 1; i <= 3; ++i) {
    a.counted = b.counted = 0;
    one.begin(a.part);
    one.run(a.part);
    other.begin(b.part);
    other.run(b.part);
    EXPECT_EQ(a.seen.size(), 10u * i);
    EXPECT_EQ(b.seen.size(), 10u * i);
    EXPECT_EQ(one.cycle(), 10 * i - 1);
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
