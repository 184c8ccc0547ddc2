// The blocks of the pipeline are plain C++ that runs one cycle at a time. pipeline.cpp gives each a SystemC
// process.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/memory_ports.h"
#include "hwmodel/pipeline/model/stages.h"

namespace voxmelt::hwmodel {

// Holds the stages of one time step and the channels between them.
class StepBlock {
 public:
  template <class DepthOf>  // depth_of(name of a channel)
  StepBlock(const Design& design, Stages stages, int first_channel, const std::string& prefix,
            const DepthOf& depth_of, std::uint64_t stall_seed)
      : stages_(std::move(stages)), out_channel_(first_channel) {
    for (std::size_t i = 0; i + 1 < stages_.size(); ++i) {
      const std::string name = prefix + stages_[i]->name() + " -> " + stages_[i + 1]->name();
      channels_.push_back(
          std::make_unique<CellFifo>(name, out_channel_++, design.shape.lanes, depth_of(name), stall_seed));
    }
  }

  const Stages& stages() const { return stages_; }
  int out_channel() const { return out_channel_; }  // number of the channel that leaves this block

  void connect(CellFifo& in, CellFifo& out) {
    out_ = &out;
    for (std::size_t i = 0; i < stages_.size(); ++i)
      stages_[i]->connect(i == 0 ? in : *channels_[i - 1], i + 1 == stages_.size() ? out : *channels_[i]);
  }
  void feed(HeatFifo& feed) {
    for (const auto& stage : stages_) stage->feed(feed);
  }
  void feed_falls(FallFifo& feed) {
    for (const auto& stage : stages_) stage->feed_falls(feed);
  }
  // The first pass of a train begins with an empty machine. Further ones are added.
  void begin_pass(const Pass& pass, int position, bool first) {
    const std::uint32_t step = pass.first + position;
    int copy = -1;
    for (const auto& stage : stages_) {
      if (stage->kind() == StageKind::settle) ++copy;
      const bool works = position < pass.steps && pass.uses(stage->kind(), copy);
      const step::Moment moment{step, pass.substep + std::max(copy, 0), {pass.substeps}};
      first ? stage->begin_pass(moment, !works, pass.tile) : stage->add_pass(moment, !works, pass.tile);
    }
  }

  const Stage& running() const { return *running_; }  // the stage that was evaluated last

  // Runs one cycle. Returns the number of stages that moved.
  int cycle() {
    int moved = 0;
    for (const auto& stage : stages_) {
      running_ = stage.get();
      moved += stage->cycle() ? 1 : 0;
    }
    for (const auto& channel : channels_) channel->commit();
    return moved;
  }

  template <class Visit>  // visit(channel, its producer)
  void for_each_output(Visit&& visit) const {
    for (std::size_t i = 0; i < stages_.size(); ++i)
      visit(i + 1 == stages_.size() ? *out_ : *channels_[i], *stages_[i]);
  }

 private:
  Stages stages_;
  int out_channel_;
  std::vector<std::unique_ptr<CellFifo>> channels_;
  CellFifo* out_ = nullptr;
  const Stage* running_ = nullptr;
};

}  // namespace voxmelt::hwmodel
