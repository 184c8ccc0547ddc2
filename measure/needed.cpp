#include "measure/needed.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/fields.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

template <class T>
bool differ(const state::Field<T>& a, const state::Field<T>& b, std::size_t begin, std::size_t count) {
  if (a.empty()) return false;  // a field that the scene does not use
  return !std::ranges::equal(a.stored().subspan(begin, count), b.stored().subspan(begin, count));
}
bool differ(const state::BitPlane&, const state::BitPlane&, std::size_t, std::size_t) {
  return false;  // masks are no vectors of numbers
}

// Rows begin at multiples of 64 stored cells, so no vector holds cells of two rows.
std::int64_t changed_vectors(const state::Volume& before, const state::Volume& after, std::size_t lanes) {
  std::int64_t changed = 0;
  for (std::size_t begin = 0; begin < before.amount.layout().cells(); begin += lanes) {
    bool any = false;
    state::for_each_field(
        [&](const auto& row) { any = any || differ(before.*row.column, after.*row.column, begin, lanes); });
    changed += any;
  }
  return changed;
}

double& part_of(Needed& needed, step::Phase phase) {
  using enum step::Phase;
  return phase == gravity ? needed.gravity : phase == spread || phase == excess ? needed.spread : needed.heat;
}

}  // namespace

std::vector<Needed> needed_vectors(const Workload& workload, const std::vector<int>& lanes) {
  run::Simulation simulation(workload.parameters, workload.start, run::implementations().all().front());
  std::vector<Needed> result(lanes.size());
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  for (int i = 0; i < workload.steps; ++i) {
    simulation.begin_step();
    for (const step::Phase phase : simulation.phases()) {
      const state::Volume before = simulation.volume();
      simulation.run_phase(phase);
      if (phase == step::Phase::source) continue;
      for (std::size_t k = 0; k < lanes.size(); ++k)
        part_of(result[k], phase) +=
            static_cast<double>(changed_vectors(before, simulation.volume(), lanes[k])) / workload.steps;
    }
    simulation.end_step();
  }
  return result;
}

LeastSeconds least_seconds(const Needed& needed, int lanes, int threads, const FullVolume& flow,
                           const std::optional<FullVolume>& heat) {
  const auto one = [&](double vectors, double seconds, double cells) {
    return vectors * lanes * seconds / cells / threads;
  };
  const double gravity = flow.step.phase[index_of(step::Phase::gravity)];
  LeastSeconds least;
  least.flow =
      one(needed.gravity, gravity, flow.cells) + one(needed.spread, flow.step.flow() - gravity, flow.cells);
  if (heat) least.heat = one(needed.heat, heat->step.heat(), heat->cells);
  return least;
}

}  // namespace voxmelt::measure
