#include "kernel/run/trial/trial.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <thread>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"

namespace voxmelt::run {
namespace {

constexpr int kRounds = 6, kSteps = 3;

rule::Parameters melt() {
  rule::Parameters p;
  p.flow.paper.threshold = 0;
  p.flow.paper.share = 8192;
  p.flow.paper.margin = 64;
  p.flow.paper.alpha_liquid = 62915;
  p.flow.paper.alpha_solid = p.flow.paper.alpha_floor = 60293;
  p.heat.enabled = true;
  p.heat.weight_face = 2086;
  p.material.melting_point = 60000;
  return p;
}

// Makes liquid of any height and temperature, `depth` cells deep.
state::Volume pool(state::Grid grid, int depth) {
  state::Volume volume(grid);
  std::uint64_t number = 0;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < depth; ++y)
      for (int x = 0; x < grid.x; ++x) {
        const std::uint64_t bits = state::mixed_bits(++number);
        const state::Slot i = volume.at(x, y, z);
        volume.amount[i] = static_cast<std::uint16_t>(rule::kOne / 2 + bits % rule::kOne);
        volume.energy[i] = static_cast<std::uint16_t>(1 + (bits >> 16) % (rule::kOne / 2));
        volume.heat[i] = static_cast<std::uint16_t>((bits >> 32) % 50000);
        volume.liquid.set(x, y, z, true);
      }
  return volume;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Times an implementation. The first step is not timed, because a fresh stepper does not know what sleeps.
double timed(const step::Implementation& implementation, const state::Volume& start) {
  Simulation simulation(melt(), start, implementation);
  simulation.step();
  const double begin = thread_seconds();
  for (int step = 0; step < kSteps; ++step) simulation.step();
  return thread_seconds() - begin;
}

// Times whole steps as a run has them, the first one not. It is infinite if the device fails.
double timed_steps(const step::Implementation& implementation, const state::Volume& start) {
  constexpr int kWholeSteps = 16;
  const int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  try {
    auto simulation =
        std::make_unique<Simulation>(melt(), start, implementation, step::Tuning{.threads = threads});
    try {
      simulation->step();
      simulation->ledger();
      const auto begin = std::chrono::steady_clock::now();
      for (int step = 0; step < kWholeSteps; ++step) simulation->step();
      simulation->ledger();
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    } catch (const step::DeviceLost&) {
      static_cast<void>(simulation.release());  // the driver may still write into its memory
      throw;
    }
  } catch (const step::DeviceError&) {
    return std::numeric_limits<double>::infinity();
  }
}

}  // namespace

std::vector<TrialTime> trial_of_steps(const std::vector<const step::Implementation*>& implementations) {
  const state::Volume dense = pool({128, 48, 96}, 48), thin = pool({256, 48, 128}, 4);
  std::vector<TrialTime> times;
  for (const step::Implementation* one : implementations) {
    const double first = timed_steps(*one, dense);
    if (!std::isfinite(first)) continue;  // who waits for a driver that hangs does so once
    const double seconds = std::sqrt(first * timed_steps(*one, thin));
    if (std::isfinite(seconds)) times.push_back({one, seconds});
  }
  return times;
}

std::vector<TrialTime> trial(const std::vector<const step::Implementation*>& implementations) {
  const state::Volume dense = pool({64, 24, 48}, 24), thin = pool({128, 24, 64}, 2);
  struct Least {
    double dense = std::numeric_limits<double>::infinity(), thin = dense;
  };
  std::vector<Least> least(implementations.size());
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t i = 0; i < least.size(); ++i) {
      least[i].dense = std::min(least[i].dense, timed(*implementations[i], dense));
      least[i].thin = std::min(least[i].thin, timed(*implementations[i], thin));
    }
  std::vector<TrialTime> times;
  for (std::size_t i = 0; i < least.size(); ++i)
    times.push_back({implementations[i], std::sqrt(least[i].dense * least[i].thin)});
  return times;
}

}  // namespace voxmelt::run
