// The program times single phases of the dense workloads, for Google Benchmark.
#include <cstddef>
#include <string>

#include "bench/registered.h"

int main(int argc, char** argv) {
  using namespace voxmelt;
  bench::register_workloads([](const measure::Workload& workload, const measure::Candidate& candidate) {
    const auto phase = [&](step::Phase which, measure::Subject subject) {
      const std::size_t index = index_of(which);
      bench::add({std::string(step::kPhaseNames[index]) + "/" + bench::coordinates(workload, candidate),
                  workload, candidate,
                  [index](const measure::Seconds& seconds) { return seconds.phase[index]; },
                  measure::work_of(subject, workload.parameters).bytes});
    };
    if (workload.times_flow) {
      phase(step::Phase::gravity, measure::Subject::gravity);
      phase(step::Phase::spread, measure::Subject::spread);
      if (workload.parameters.flow.law == rule::Law::viscous)
        phase(step::Phase::excess, measure::Subject::spread);
    }
    if (workload.times_heat) phase(step::Phase::heat, measure::Subject::heat);
  });
  return bench::run(argc, argv);
}
