#include "hwmodel/explore/sweep.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <memory>
#include <tuple>

#include "hwmodel/explore/chain.h"
#include "hwmodel/explore/dram_time.h"
#include "hwmodel/memory/energy.h"
#include "hwmodel/memory/ratio.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Counts everything but the memories of stages and ports.
struct Fixed {
  Amounts amounts{};
  std::int64_t lutram = 0, ports = 0;
};

Fixed fixed_of(const PartList& parts, const Configuration& hw, const Family& f) {
  const std::int64_t lanes = hw.lanes, steps = hw.cascade, depth = hw.fifo_depth;
  Fixed fixed;
  fixed.ports = 2 + (parts.fed ? steps : 0) + (parts.falls ? 1 : 0);
  std::int64_t &lut = fixed.amounts[0], &ff = fixed.amounts[1], &dsp = fixed.amounts[2];
  const Logic step = logic_of(parts, f);
  lut = f.base.lut.value + steps * step.lut + fixed.ports * f.port.lut.value;
  ff = f.base.ff.value + steps * step.ff + fixed.ports * f.port.ff.value;
  dsp = steps * parts.dsp;
  const auto channel = [&](std::int64_t times, std::int64_t bits) {
    lut += times * f.channel.lut.value;
    ff += times * f.channel.ff.value;
    if (depth <= f.register_words)
      ff += times * depth * bits * lanes;
    else
      fixed.lutram += times * luts_to_hold(depth, bits * lanes, f);
  };
  channel(1, parts.design.cell_bits());
  for (const StagePart& stage : parts.stages) channel(steps, stage.output_bits);
  if (parts.fed) channel(steps, 16);
  if (parts.falls) channel(1, 1);
  if (hw.coded) {
    lut += 2 * f.coder.lut.value;
    ff += 2 * f.coder.ff.value;
    const CodeLayout layout(parts.design);
    for (const auto& buffers : {reader_buffers(layout), writer_buffers(layout)})
      for (const BufferCost& one : buffers)
        if (one.words <= f.register_words)
          ff += one.total();
        else
          fixed.lutram += luts_to_hold(one.words, one.bits, f);
  }
  lut += fixed.lutram;
  return fixed;
}

template <class Visit>  // visit(amounts, lutram) for every choice of memories
void each_choice(const PartList& parts, const Configuration& hw, const Family& f, Visit&& visit) {
  const Fixed fixed = fixed_of(parts, hw, f);
  for (const MemoryUse& port : ways_to_hold(f.port_words, f.port_bits, f))
    for (const MemoryUse& step : parts.memories) {
      const MemoryUse use = hw.cascade * step + fixed.ports * port;
      Amounts amounts = fixed.amounts;
      amounts[kLut] += use.lutram;
      amounts[kBram] = (use.parts + f.bram_parts - 1) / f.bram_parts;
      amounts[kUram] = use.uram;
      visit(amounts, fixed.lutram + use.lutram);
    }
}

double share_of(std::int64_t used, std::int64_t there) {
  if (used == 0) return 0;
  return there == 0 ? std::numeric_limits<double>::infinity() : ratio(used, there);
}

bool better_choice(const Taken& a, const Taken& b) {
  return std::tie(a.fullest, a.amounts[kLut], a.amounts[kBram], a.amounts[kUram]) <
         std::tie(b.fullest, b.amounts[kLut], b.amounts[kBram], b.amounts[kUram]);
}

}  // namespace

Taken taken_by(const PartList& parts, const Configuration& hw, const Device& device,
               std::optional<Resource> relaxed) {
  const Amounts usable = device.usable();
  Taken best;
  bool first = true;
  each_choice(parts, hw, device.family, [&](const Amounts& amounts, std::int64_t lutram) {
    Taken taken{amounts, lutram, 0, kLut};
    for (const Resource r : kEachResource) {
      if (relaxed == r) continue;
      double share = share_of(amounts[r], usable[r]);
      if (r == kLut) share = std::max(share, share_of(lutram, device.lutram));
      if (share > taken.fullest) {
        taken.fullest = share;
        taken.most = r;
      }
    }
    if (first || better_choice(taken, best)) best = taken;
    first = false;
  });
  return best;
}

bool too_large(const PartList& parts, const Configuration& hw, const Device& device) {
  const Amounts usable = device.usable();
  const Fixed fixed = fixed_of(parts, hw, device.family);
  return fixed.lutram > device.lutram ||
         std::any_of(kEachResource.begin(), kEachResource.end(),
                     [&](Resource r) { return fixed.amounts[r] > usable[r]; });
}

std::optional<std::int64_t> least_of(Resource resource, const PartList& parts, const Configuration& hw,
                                     const Device& device) {
  const Amounts usable = device.usable();
  std::optional<std::int64_t> least;
  each_choice(parts, hw, device.family, [&](const Amounts& amounts, std::int64_t lutram) {
    if (resource != kLut && lutram > device.lutram) return;
    for (std::size_t r = 0; r < kResources; ++r)
      if (r != resource && amounts[r] > usable[r]) return;
    least = std::min(least.value_or(amounts[resource]), amounts[resource]);
  });
  return least;
}

namespace {

std::vector<RunTime> times_of(const PartList& parts, const Configuration& hw, const std::vector<int>& clocks,
                              const Question& question, std::int64_t steps) {
  if (question.device.chain > 1) return times_on_chain(parts, hw, clocks, question, steps);
  std::vector<RunTime> times(clocks.size());
  const Design design = design_of(question.parameters, question.grid, hw);
  for (const Train& train : kinds_of_trains(design, hw, question.first_step, steps, *parts.content)) {
    std::vector<std::int64_t> on_memory(clocks.size(), train.work.cycles);
    if (question.memory) on_memory = cycles_on(train.work, *question.memory, clocks, train.placement);
    const double tokens = energy_of_tokens(train, parts, hw.coded);
    for (std::size_t i = 0; i < clocks.size(); ++i) {
      RunEnergy energy{tokens};
      if (question.memory) {
        const memory::Counts counts = counts_of(train.work, on_memory[i], clocks[i], *question.memory);
        energy.memory = 1000 * memory::energy_of(counts, *question.memory).all();
      }
      times[i].energy += static_cast<double>(train.times) * energy;
      times[i].cycles += train.times * train.work.cycles;
      times[i].on_memory += train.times * on_memory[i];
      times[i].steps += train.times * train.steps;
    }
  }
  return times;
}

}  // namespace

RunTime time_of(const PartList& parts, const Configuration& hw, int clock_mhz, const Question& question,
                std::int64_t steps) {
  return times_of(parts, hw, {clock_mhz}, question, steps).front();
}

std::int64_t speed_of(const Question& question, const RunTime& time, int clock_mhz) {
  const double cell_steps = static_cast<double>(question.grid.cells()) * static_cast<double>(time.steps);
  return std::llround(cell_steps * clock_mhz * 1e3 / static_cast<double>(time.on_memory));
}

std::int64_t per_cell_step(const Question& question, std::int64_t steps, double picojoules) {
  return std::llround(1000 * picojoules /
                      (static_cast<double>(question.grid.cells()) * static_cast<double>(steps)));
}

namespace {

// Adds the points for all values of the other axes.
void add_points(Swept& swept, std::size_t at, Configuration hw, const Question& question, const Axes& axes) {
  const PartList& parts = swept.parts[at];
  std::map<std::array<int, 3>, std::vector<RunTime>> known;  // deeper channels take the same time
  for (const int depth : axes.fifo_depth) {
    hw.fifo_depth = depth;
    for (const int coded : axes.coded) {
      hw.coded = coded == 1;
      const Taken taken = taken_by(parts, hw, question.device);
      for (const int overlap : axes.overlap) {
        hw.overlap = overlap == 1;
        std::vector<RunTime>& times = known[{hw.interval(), coded, overlap}];
        if (times.empty()) times = times_of(parts, hw, axes.clock_mhz, question, question.steps);
        for (std::size_t i = 0; i < times.size(); ++i) {
          const RunTime& time = times[i];
          swept.points.push_back({hw, at, axes.clock_mhz[i], time.cycles, time.on_memory,
                                  speed_of(question, time, axes.clock_mhz[i]), taken,
                                  per_cell_step(question, time.steps, time.energy.all()),
                                  per_cell_step(question, time.steps, time.energy.memory)});
        }
      }
    }
  }
}

}  // namespace

Swept sweep(const Question& question, const Axes& axes, const std::function<void()>& poll) {
  const auto begin = std::chrono::steady_clock::now();
  Swept swept;
  for (const int lanes : axes.lanes) {
    const auto content = std::make_shared<Content>(
        content_of({question.parameters, {question.grid, lanes}, 1}, question.irradiance, question.volume));
    content->falls = question.falls;
    content->substeps = {question.substeps};
    for (const int substeps : axes.substeps) {
      std::map<int, std::size_t> parts_of;  // keyed by the blocks of a tile
      for (const int cascade : axes.cascade) {
        Configuration hw;
        hw.lanes = lanes;
        hw.cascade = cascade;
        hw.substeps = substeps;
        for (const int tile : tiles_of(axes, question, hw)) {
          hw.tile = tile;
          const Design design = design_of(question.parameters, question.grid, hw);
          if (const int chain = question.device.chain; chain > 1 && !is_for_chain(design, chain)) continue;
          const auto [known, added] = parts_of.try_emplace(design.shape.blocks(), swept.parts.size());
          if (added) {
            swept.parts.push_back(part_list(design, question.device.family));
            swept.parts.back().content = content;
          }
          if (poll) poll();
          add_points(swept, known->second, hw, question, axes);
        }
      }
    }
  }
  swept.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return swept;
}

}  // namespace voxmelt::hwmodel::explore
