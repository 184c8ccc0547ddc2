// The benchmark programs share their workloads, names that are coordinates, and the check of each result
// before its time counts.
#pragma once

#include <functional>
#include <string>

#include "measure/measure.h"
#include "measure/roof.h"

namespace voxmelt::bench {

struct Benchmark {
  std::string name;
  measure::Workload workload;
  measure::Candidate candidate;
  std::function<double(const measure::Seconds&)> seconds;  // the timed part, per step
  double bytes_per_cell = 0;                               // needed by the definition
};

std::string coordinates(const measure::Workload& workload, const measure::Candidate& candidate);
void add(const Benchmark& benchmark);

// Calls visit(workload, candidate) for all that this processor supports, on one thread and on two.
void register_workloads(
    const std::function<void(const measure::Workload&, const measure::Candidate&)>& visit);

int run(int argc, char** argv);  // exit code 1 if a result was wrong

}  // namespace voxmelt::bench
