#include "measure/machine.h"

#include <unistd.h>

#include <algorithm>
#include <barrier>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <thread>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "measure/lane_loops.h"

namespace voxmelt::measure {
namespace {

constexpr double kTrialSeconds = 0.001;  // shorter than a time slice of the scheduler
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Returns the best rate of several trials. All threads start together, and a trial ends when the last one is
// done. `piece(thread)` does one piece of work and returns its amount.
double best_rate(int threads, const Rounds& trials, const std::function<double(int)>& piece) {
  double best = 0;
  const RoundClock clock(trials);
  for (int trial = 0; clock.more(trial); ++trial) {
    std::barrier ready(threads);
    std::vector<double> rates(threads);
    const auto work = [&](int thread) {
      piece(thread);  // warms up
      ready.arrive_and_wait();
      const Clock::time_point start = Clock::now();
      double done = 0, seconds = 0;
      while (seconds < kTrialSeconds) {
        done += piece(thread);
        seconds = seconds_since(start);
      }
      rates[thread] = done / seconds;
    };
    std::vector<std::jthread> others;
    for (int thread = 1; thread < threads; ++thread) others.emplace_back(work, thread);
    work(0);
    others.clear();
    double sum = 0;
    for (const double rate : rates) sum += rate;
    best = std::max(best, sum);
  }
  return best;
}

LaneLoops loops(cpu::InstructionSet set) {
  LaneLoops found;
  cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
    if (kSet == set) found = loops_for<cpu::ArchOf<kSet>>();
  });
  return found;
}

LaneLoops widest_loops() {
  LaneLoops widest = loops(cpu::kInstructionSets.front().set);
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (row.supported()) widest = loops(row.set);
  return widest;
}

struct alignas(64) Line {
  std::uint16_t lanes[32] = {};
};

std::size_t cache_bytes(int name) {
  const long bytes = ::sysconf(name);
  return bytes > 0 ? bytes : 0;
}

std::string processor_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "unknown";
}

}  // namespace

MachineText describe_machine() {
  return {processor_name(),
          static_cast<int>(std::max(1u, std::thread::hardware_concurrency())),
          cache_bytes(_SC_LEVEL1_DCACHE_SIZE),
          cache_bytes(_SC_LEVEL2_CACHE_SIZE),
          cache_bytes(_SC_LEVEL3_CACHE_SIZE),
          cache_bytes(_SC_PHYS_PAGES) * cache_bytes(_SC_PAGESIZE)};
}

double load_average() {
  double last_minute = 0;
  return ::getloadavg(&last_minute, 1) == 1 ? last_minute : 0;
}

std::size_t Machine::rounded(std::size_t footprint) {
  return std::bit_ceil(std::clamp(footprint, std::size_t{1} << 18, std::size_t{1} << 29));
}

Bandwidth Machine::measure(std::size_t footprint, int threads) const {
  // There is one block of whole cache lines; every thread has its own part of it.
  std::vector<Line> block(footprint / sizeof(Line));
  const std::size_t part = block.size() / threads / 2 * 2;
  const auto own = [&](int thread) { return block.data() + thread * part; };
  const auto bytes = static_cast<double>(part * sizeof(Line));
  const LaneLoops widest = widest_loops();

  Bandwidth result;
  result.copy = best_rate(threads, trials_, [&](int thread) {
    std::memcpy(own(thread), own(thread) + part / 2, part / 2 * sizeof(Line));
    asm volatile("" : : "r"(own(thread)) : "memory");
    return bytes;  // half of them read, half of them written
  });
  result.update = best_rate(threads, trials_, [&](int thread) {
    widest.update(own(thread)->lanes, part * 32);
    return 2 * bytes;
  });
  return result;
}

LaneRates Machine::measure(cpu::InstructionSet set, int threads) const {
  const LaneLoops loop = loops(set);
  constexpr std::uint64_t kRounds = 20000;
  const auto rate = [&](std::uint64_t (*run)(std::uint64_t, std::uint16_t*)) {
    return best_rate(threads, trials_, [run](int) {
      alignas(64) std::uint16_t sink[32];
      return static_cast<double>(run(kRounds, sink));
    });
  };
  return {rate(loop.multiply), rate(loop.add)};
}

// With more threads no bound is lower than with fewer, since the others may rest.
Bandwidth Machine::bandwidth(std::size_t footprint, int threads) {
  const std::pair key{rounded(footprint), threads};
  if (!bandwidths_.contains(key)) bandwidths_[key] = measure(key.first, threads);
  Bandwidth best;
  for (const auto& [other, found] : bandwidths_)
    if (other.first == key.first && other.second <= threads)
      best = {std::max(best.copy, found.copy), std::max(best.update, found.update)};
  return best;
}

LaneRates Machine::lane_rates(cpu::InstructionSet set, int threads) {
  const std::pair key{set, threads};
  if (!rates_.contains(key)) rates_[key] = measure(set, threads);
  LaneRates best;
  for (const auto& [other, found] : rates_)
    if (other.first == set && other.second <= threads)
      best = {std::max(best.multiply, found.multiply), std::max(best.add, found.add)};
  return best;
}

void Machine::refresh_rates() {
  for (auto& [key, known] : rates_) {
    const LaneRates now = measure(key.first, key.second);
    known = {std::max(known.multiply, now.multiply), std::max(known.add, now.add)};
  }
}

void Machine::refresh_all() {
  refresh_rates();
  for (auto& [key, known] : bandwidths_) {
    const Bandwidth now = measure(key.first, key.second);
    known = {std::max(known.copy, now.copy), std::max(known.update, now.update)};
  }
}

}  // namespace voxmelt::measure
