#include "kernel/engine/scalar/substeps.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>

#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/cells.h"

namespace voxmelt::scalar {
namespace {

class Runs {
 public:
  Runs(const rule::Parameters& parameters, const state::Volume& volume)
      : parameters_(parameters), volume_(volume), cells_(volume) {}

  // Returns the number of sub-steps that the run beginning here needs.
  std::int64_t need(int x, int bottom, int z) const {
    std::int64_t mass = 0;
    std::uint64_t content = 0;
    std::int32_t n = 0;
    std::int32_t next = cells_.amount(x, bottom, z);
    do {
      const std::int32_t top = next;
      mass += top;
      content += content_of(top, volume_.heat[cells_.at(x, bottom + n, z)]);
      ++n;
      if (cells_.blocked(x, bottom + n, z)) break;
      next = cells_.amount(x, bottom + n, z);
      if (!rule::run_continues(mass, n, top, next)) break;
    } while (true);
    const auto mean = static_cast<std::int32_t>(content / mass);
    return rule::needed_substeps(mass, n, mean, parameters_.flow);
  }

  // Calls visit(x, y, z) for each cell in which a run begins: liquid directly above a blocked cell.
  template <class Visit>
  void for_each_begin(Visit&& visit) const {
    const state::Volume& v = volume_;
    for (int z = 0; z < v.grid.z; ++z)
      for (int y = 0; y < v.grid.y; ++y)
        for (int w = 0; w < std::ssize(v.liquid.row(y, z)); ++w) {
          std::uint64_t begins = v.liquid.row(y, z)[w];
          if (begins != 0 && y > 0) begins &= v.solid.row(y - 1, z)[w] | v.inert.row(y - 1, z)[w];
          for (; begins != 0; begins &= begins - 1) visit(64 * w + std::countr_zero(begins), y, z);
        }
  }

 private:
  const rule::Parameters& parameters_;
  const state::Volume& volume_;
  const Cells cells_;
};

}  // namespace

step::Cadence count_substeps(const rule::Parameters& parameters, const state::Volume& volume) {
  const rule::ViscousLaw& law = parameters.flow.viscous;
  if (!law.counts_substeps() && !law.relaxes()) return {law.substeps};
  const Runs runs(parameters, volume);
  std::int64_t most = 1;
  runs.for_each_begin([&](int x, int y, int z) { most = std::max(most, runs.need(x, y, z)); });
  const std::int64_t substeps =
      law.counts_substeps() ? std::min<std::int64_t>(most, law.substeps_max) : law.substeps;
  return {static_cast<int>(substeps), rule::stages_for((most + substeps - 1) / substeps, law.stages_max)};
}

}  // namespace voxmelt::scalar
