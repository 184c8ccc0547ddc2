// The program times whole steps of the dense and the sleeping workloads, for the filters, repetitions and
// comparison tools of Google Benchmark. Ratios to the paper's program, and the roofs, are in `voxmelt bench`.
#include "bench/registered.h"

int main(int argc, char** argv) {
  using namespace voxmelt;
  bench::register_workloads([](const measure::Workload& workload, const measure::Candidate& candidate) {
    bench::add({"step/" + bench::coordinates(workload, candidate), workload, candidate,
                [](const measure::Seconds& seconds) { return seconds.total(); },
                measure::work_of(workload.times_flow ? measure::Subject::flow : measure::Subject::heat,
                                 workload.parameters)
                    .bytes});
  });
  return bench::run(argc, argv);
}
