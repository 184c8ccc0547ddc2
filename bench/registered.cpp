#include "bench/registered.h"

#include <benchmark/benchmark.h>

#include <cstdint>
#include <map>
#include <vector>

#include "kernel/run/simulation.h"

namespace voxmelt::bench {
namespace {

bool wrong = false;

// The reference runs once per workload, when the first of its benchmarks does.
std::uint64_t expected(const measure::Workload& workload) {
  static std::map<std::string, std::uint64_t> known;
  const auto found = known.find(workload.name);
  if (found != known.end()) return found->second;
  return known[workload.name] = measure::expected_digest(workload);
}

void time_it(benchmark::State& state, const Benchmark& one) {
  const auto cells = static_cast<double>(one.workload.start.grid.cells());
  const std::uint64_t digest = expected(one.workload);
  double steps = 0;
  for ([[maybe_unused]] auto _ : state) {
    try {
      const measure::Steps run = measure::timed_run(one.workload, one.candidate, digest);
      state.SetIterationTime(one.seconds(measure::mean(run)));
      ++steps;
    } catch (const measure::Mismatch& error) {
      wrong = true;
      state.SkipWithError(error.what());
      break;
    }
  }
  state.counters["cells/s"] = benchmark::Counter(cells * steps, benchmark::Counter::kIsRate);
  state.counters["bytes/cell"] = one.bytes_per_cell;
}

}  // namespace

std::string coordinates(const measure::Workload& workload, const measure::Candidate& candidate) {
  return candidate.implementation->name + "/" + workload.name +
         "/threads:" + std::to_string(candidate.threads);
}

void add(const Benchmark& one) {
  benchmark::RegisterBenchmark(one.name.c_str(), [one](benchmark::State& state) { time_it(state, one); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(9);  // one step each, on a fresh simulation made outside of the clock
}

void register_workloads(
    const std::function<void(const measure::Workload&, const measure::Candidate&)>& visit) {
  std::vector<measure::Workload> workloads;
  for (const bool heat : {false, true}) {
    workloads.push_back(measure::dense_paper(64, heat));
    workloads.push_back(measure::dense_viscous(64, heat));
  }
  workloads.push_back(measure::dense_heat(64, 6));
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    workloads.push_back(measure::asleep({64, 64, 64}, 32, law));
  for (const measure::Workload& workload : workloads)
    for (const step::Implementation& implementation : run::implementations().all())
      for (const int threads : {1, 2}) {
        const bool scalar = implementation.name == "reference";
        if (!implementation.supported || (scalar && threads > 1)) continue;
        visit(workload, {&implementation, threads});
      }
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  // Debian's library says "Library was built as DEBUG": that is about its own few functions, not about the
  // timed code.
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return wrong ? 1 : 0;
}

}  // namespace voxmelt::bench
