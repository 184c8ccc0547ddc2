#include "hwmodel/explore/chain.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "hwmodel/explore/dram_time.h"
#include "hwmodel/memory/energy.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Writes what comes over a link, too.
void write_halos(Train& train) {
  train.work.written_bits = train.work.read_bits;
  for (ColumnBursts& column : train.placement.work.columns) column.writes = column.reads;
}

// The tiles of one pass, each on a device of its own.
struct ChainPass {
  std::vector<Train> tiles;
  std::int64_t times = 0, steps = 0;
};

std::vector<ChainPass> passes_of(const Design& design, Configuration hw, const Question& question,
                                 std::int64_t steps, const Content& content) {
  hw.overlap = false;  // then each tile of each pass is a train
  std::vector<ChainPass> passes;
  for (Train& train : kinds_of_trains(design, hw, question.first_step, steps, content)) {
    if (train.list.front().tile == 0) passes.push_back({{}, train.times, 0});
    write_halos(train);
    passes.back().steps += train.steps;
    passes.back().tiles.push_back(std::move(train));
  }
  return passes;
}

// Returns the time of one pass, `cycles_of(train)` being that of a device.
template <class CyclesOf>
std::int64_t longest(const ChainPass& pass, double halos, double latency, const CyclesOf& cycles_of) {
  double most = 0;
  for (const Train& train : pass.tiles)
    most = std::max(most, linked_cycles(static_cast<double>(cycles_of(train)),
                                        static_cast<double>(train.work.lag), halos, latency));
  return std::llround(most);
}

}  // namespace

bool is_for_chain(const Design& design, int devices) {
  const Shape& shape = design.shape;
  if (shape.tiles() != devices) return false;
  for (int k = 0; k + 1 < devices; ++k)
    if (shape.first_block(k + 1) < shape.owned_begin(k) ||
        shape.first_block(k) + shape.blocks() > shape.owned_end(k + 1))
      return false;
  return true;
}

std::int64_t halo_bits(const Design& design) {
  const Shape& shape = design.shape;
  std::int64_t blocks = 0;
  for (int k = 0; k + 1 < shape.tiles(); ++k) {
    const int cut = shape.owned_end(k);
    blocks = std::max<std::int64_t>(blocks, shape.first_block(k) + shape.blocks() - cut);
    blocks = std::max<std::int64_t>(blocks, cut - shape.first_block(k + 1));
  }
  return blocks * shape.lanes * shape.grid.y * shape.grid.z * design.cell_bits();
}

double linked_cycles(double pass, double lag, double halos, double latency) {
  return std::max(pass, lag + halos) + latency;
}

std::vector<RunTime> times_on_chain(const PartList& parts, const Configuration& hw,
                                    const std::vector<int>& clocks, const Question& question,
                                    std::int64_t steps) {
  std::vector<RunTime> times(clocks.size());
  const Design design = design_of(question.parameters, question.grid, hw);
  const std::int64_t bits = halo_bits(design);
  for (const ChainPass& pass : passes_of(design, hw, question, steps, *parts.content))
    for (std::size_t i = 0; i < clocks.size(); ++i) {
      const double mhz = clocks[i];
      const double halos = static_cast<double>(bits) * mhz / (1000. * question.device.link_gbit);
      const double latency = 1e-3 * mhz * question.device.link_ns;
      const auto always = [](const Train& train) { return train.work.cycles; };
      const auto on_memory = [&](const Train& train) {
        if (!question.memory) return train.work.cycles;
        return cycles_on(train.work, *question.memory, clocks[i], train.placement);
      };
      const std::int64_t cycles = longest(pass, halos, latency, on_memory);
      RunEnergy energy;
      for (const Train& train : pass.tiles) {
        energy.operations += energy_of_tokens(train, parts, hw.coded);
        if (question.memory)
          energy.memory +=
              1000 *
              memory::energy_of(counts_of(train.work, cycles, clocks[i], *question.memory), *question.memory)
                  .all();
      }
      times[i].cycles += pass.times * longest(pass, halos, latency, always);
      times[i].on_memory += pass.times * cycles;
      times[i].steps += pass.times * pass.steps;
      times[i].energy += static_cast<double>(pass.times) * energy;
    }
  return times;
}

}  // namespace voxmelt::hwmodel::explore
