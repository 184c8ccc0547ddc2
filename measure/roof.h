// The roof tells how fast the automaton could be at most on this machine. It sets the needs of its definition
// for a cell against the measured rates of the machine.
//
// The needs are counted from docs/automaton.md, not from voxmelt's instructions. The roof is an upper bound:
// operations that a clever implementation might avoid are counted only if the definition asks for their
// results.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "measure/machine.h"

namespace voxmelt::measure {

enum class Subject { gravity, spread, flow, heat };  // flow: gravity + spread + excess; heat: heat + melt

std::string_view name_of(Subject subject);

struct Count {
  std::string what;
  double multiplies = 0, others = 0;  // operations on 16-bit lanes
};

struct Work {
  std::vector<Count> counts;  // the derivation, term by term
  double multiplies = 0, others = 0;
  double bytes = 0;  // read + written, every field once per step
  std::string bytes_text;

  double operations() const { return multiplies + others; }
};

// Counts for a cell in which everything happens: it gives, takes and, with heat.enabled, mixes.
Work work_of(Subject subject, const rule::Parameters& parameters);

struct Roof {
  double operations = 0, bytes = 0;  // cells per second
  double multiplies = 0;             // cells per second, if every operation were as slow as a multiply
  double cells() const { return operations < bytes ? operations : bytes; }
};
Roof roof_of(const Work& work, const LaneRates& rates, const Bandwidth& bandwidth);

}  // namespace voxmelt::measure
