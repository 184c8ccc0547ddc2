// The closed form of a run on a DRAM is compared with simulation, in configurations drawn at random from all
// that a user may write.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/memory/sheet.h"
#include "tests/hwmodel/explore/memory_runs.h"

namespace voxmelt::hwmodel::explore {
namespace {

struct Drawn {
  Kind kind = Kind::dark;
  TimedRun run;
  memory::Parameters sheet;
  int mhz = 0, nanoseconds = 0;
};

std::string words(const Drawn& drawn) {
  constexpr std::array kKinds{"lit", "dark", "coded", "in tiles"};
  const Configuration& c = drawn.run.configuration;
  const state::Grid g = drawn.run.grid;
  std::ostringstream text;
  text << drawn.sheet.name << ", " << drawn.sheet.channels << " channels, " << drawn.nanoseconds << " ns, "
       << drawn.mhz << " MHz, " << c.lanes << " lanes, " << c.cascade << " steps, depth " << c.fifo_depth
       << ", overlap " << (c.overlap ? 1 : 0) << ", tile " << c.tile << ", " << g.x << " x " << g.y << " x "
       << g.z << " cells, " << drawn.run.steps << " steps, " << kKinds[static_cast<std::size_t>(drawn.kind)];
  return text.str();
}

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  Drawn next() {
    Drawn drawn;
    do {
      drawn.kind = static_cast<Kind>(between(0, 3));
      drawn.run = timed(1 << between(0, 5), between(1, 8), 0);
      drawn.run.grid = {between(40, 128), between(16, 40), between(24, 48)};
      Configuration& c = drawn.run.configuration;
      drawn.run.steps = std::int64_t{c.cascade} * between(1, 3);
      c.overlap = between(0, 3) > 0;
      c.fifo_depth = between(0, 5) == 0 ? 1 : 4;
      c.tile = drawn.kind == Kind::tiles ? c.lanes * between(2, 12) : 0;
    } while (!tile_problem(drawn.run.parameters, drawn.run.grid, drawn.run.configuration).empty());
    const std::vector<MemoryFile>& files = memory_files();
    drawn.sheet = load_memory(files[between(0, static_cast<int>(std::ssize(files)) - 1)].name, "test");
    drawn.sheet.channels = 1 << between(0, 5);
    drawn.nanoseconds = between(5, 400);
    drawn.sheet.interface_cycles = drawn.nanoseconds * drawn.sheet.mhz / 1000;
    drawn.mhz = between(50, 500);
    return drawn;
  }

 private:
  int between(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }
  std::mt19937_64 random_;
};

double percent(std::int64_t part, std::int64_t whole) {
  return 100 * static_cast<double>(part) / static_cast<double>(whole);
}

// Compares so many drawn configurations, and lists the worst ones. Some are beyond the bounds: `explore` says
// so of a design that it has simulated. None may be far beyond.
void compare(int count, std::uint64_t seed, int least_bound, int most_beyond) {
  Draw draw(seed);
  std::vector<std::pair<double, std::string>> errors;
  int bound = 0, beyond = 0;
  for (int i = 0; i < count; ++i) {
    const Drawn drawn = draw.next();
    ASSERT_EQ(beyond_bounds(drawn.sheet, drawn.mhz), "") << words(drawn);
    const MemoryRun run(drawn.run, drawn.kind);
    std::int64_t predicted = 0, free = 0;
    for (const Train& train : run.trains()) {
      predicted += cycles_on(train.work, drawn.sheet, drawn.mhz, train.placement);
      free += train.work.cycles;
    }
    const std::int64_t simulated = run.simulated(drawn.sheet, drawn.mhz), off = predicted - simulated;
    const std::int64_t allowed = allowed_error(simulated, drawn.sheet, drawn.mhz);
    EXPECT_LE(std::abs(off), 3 * allowed) << words(drawn) << ": " << simulated << ", " << predicted;
    beyond += std::abs(off) > allowed ? 1 : 0;
    bound += simulated > free + free / 10 ? 1 : 0;
    std::ostringstream text;
    text << words(drawn) << ": " << simulated << " cycles, without memory " << free << ", predicted "
         << percent(off, simulated) << " %";
    errors.emplace_back(-std::abs(percent(off, simulated)), text.str());
  }
  std::sort(errors.begin(), errors.end());
  std::cout << count << " configurations, " << bound << " of which the memory slows by a tenth or more; "
            << beyond << " are beyond the bounds. The worst:\n";
  for (int i = 0; i < std::min(count, 10); ++i) std::cout << errors[i].second << '\n';
  double sum = 0;
  for (const auto& error : errors) sum -= error.first;
  std::cout << "mean error " << sum / count << " %, median " << -errors[count / 2].first << " %\n";
  EXPECT_GE(bound, least_bound);
  EXPECT_LE(beyond, most_beyond);
}

TEST(DrawnMemories, AFew) { compare(16, 1, 3, 2); }
TEST(DrawnMemories, LongMany) { compare(160, 2, 50, 9); }
// The form of the lateness between channels was chosen by those above, and these were drawn afterwards.
TEST(DrawnMemories, LongOthers) { compare(160, 7, 50, 14); }

// The 128 bursts of a stream's buffer are under way while the first of them needs 400 ns. So no more than 128
// bursts come in that time, however many channels there are.
TEST(DrawnMemories, TheLatencyBoundsTheSpeed) {
  TimedRun timed_run = timed(32, 1, 1);
  timed_run.grid = {128, 64, 64};
  const MemoryRun run(timed_run, Kind::dark);
  memory::Parameters sheet = load_memory("hbm2", "test");
  sheet.channels = 32;
  sheet.interface_cycles = 400;
  const Train train = run.trains().front();
  const std::int64_t predicted = cycles_on(train.work, sheet, 500, train.placement);
  const std::int64_t bursts = train.work.read_bits / (8 * memory::kBurst);
  EXPECT_EQ(bursts, 4 * 64 * 64 * 32 * 50 / 512);
  EXPECT_GT(predicted, bursts / 128 * 200) << "200 cycles for 128 bursts";
  EXPECT_LT(predicted, bursts / 128 * 240) << "and the memory's own latency, and refreshes";
}

}  // namespace
}  // namespace voxmelt::hwmodel::explore
