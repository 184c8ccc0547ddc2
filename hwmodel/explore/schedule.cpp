#include "hwmodel/explore/schedule.h"

#include <algorithm>

#include "hwmodel/stream/prediction.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Time steps of the pass that begins with this one. None reaches beyond a step of visibility.
int steps_of_pass(const Design& design, const Configuration& c, std::uint32_t step, std::int64_t left) {
  const rule::Heat& heat = design.parameters.heat;
  const bool counted = !design.paper() && design.parameters.flow.viscous.counts_substeps();
  std::int64_t steps = std::min<std::int64_t>(left, counted ? 1 : c.cascade);
  if (heat.radiates())
    steps = std::min<std::int64_t>(steps, heat.visibility_every - heat.visibility_age(step));
  return static_cast<int>(steps);
}

void add_pass(Train& train, const Design& design, const Configuration& c, const Pass& pass,
              const Content& content) {
  const Shape& shape = design.shape;
  const std::int64_t cells = shape.tokens() * shape.lanes;
  ++train.passes;
  train.list.push_back(pass);
  train.work.tokens += shape.tokens();
  const std::int64_t state_bits = c.coded ? content.coded_bits : cells * design.cell_bits();
  train.work.read_bits += state_bits;
  train.work.written_bits += state_bits;
  if (design.hot() && design.parameters.heat.radiation && pass.begins())
    train.work.fed_bits += content.irradiance_bits * pass.steps;
}

void end_train(Train& train, const Design& design, const Configuration& c, const Pass& first) {
  train.work.passes = 1;
  train.work.cycles = predicted_cycles(design, c, first, train.passes);
  train.work.lag = train.work.cycles - (c.fifo_depth == 1 ? 2 : 1) * train.work.tokens;
}

// One time step with more sub-steps than the machine has copies of settle and spread: pass after pass.
void add_substeps(std::vector<Train>& trains, const Design& design, const Configuration& c, Pass pass,
                  const Content& content) {
  for (; pass.substep < pass.substeps; pass.substep += pass.count) {
    pass.count = std::min(pass.count, pass.substeps - pass.substep);
    Train& train = trains.emplace_back();
    add_pass(train, design, c, pass, content);
    train.steps = pass.ends() ? 1 : 0;
    end_train(train, design, c, pass);
  }
}

}  // namespace

std::vector<Train> trains_of(const Design& design, const Configuration& c, std::uint32_t first_step,
                             std::int64_t steps, const Content& content) {
  const rule::Heat& heat = design.parameters.heat;
  const int substeps = design.paper() ? 1 : design.parameters.flow.viscous.substeps;
  std::vector<Train> trains;
  for (std::int64_t done = 0; done < steps;) {
    Pass pass{.first = first_step + static_cast<std::uint32_t>(done)};
    pass.substeps = substeps == 0 ? c.substeps : substeps;
    pass.count = std::min(pass.substeps, c.substeps);
    if (!pass.ends()) {
      add_substeps(trains, design, c, pass, content);
      ++done;
      continue;
    }
    Train train;
    pass.steps = steps_of_pass(design, c, pass.first, steps - done);
    const Pass first = pass;
    while (true) {
      add_pass(train, design, c, pass, content);
      train.steps += pass.steps;
      done += pass.steps;
      const std::uint32_t step = first_step + static_cast<std::uint32_t>(done);
      if (done == steps || substeps == 0 || !passes_overlap(design, c, pass) ||
          (heat.radiates() && heat.visibility_age(step) == 0))
        break;
      pass.first = step;
      pass.steps = steps_of_pass(design, c, step, steps - done);
    }
    end_train(train, design, c, first);
    trains.push_back(train);
  }
  return trains;
}

}  // namespace voxmelt::hwmodel::explore
