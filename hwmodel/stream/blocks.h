// The blocks of the pipeline as plain C++: what one of them does in one cycle. pipeline.cpp gives each a
// SystemC process.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/stream/stages.h"
#include "hwmodel/stream/stream_memory.h"
#include "hwmodel/stream/volume_port.h"

namespace voxmelt::hwmodel {

// Streams the result into memory, behind the reader.
class Writer {
 public:
  explicit Writer(const Shape& shape) : shape_(shape) {}
  void connect(CellFifo& in) { in_ = &in; }
  void begin_pass(state::Volume& volume) {
    volume_ = &volume, place_ = {};
    to_write_ = shape_.tokens(), written_ = 0, last_cycle_ = -1;
  }
  void add_pass() { to_write_ += shape_.tokens(); }
  void cycle(std::int64_t now) {
    if (done()) {
      ++cycles_.fill_drain;
    } else if (!in_->valid()) {
      ++(written_ == 0 ? cycles_.fill_drain : cycles_.starved);
    } else if (memory_ != nullptr && !memory_->may_write(now)) {
      ++cycles_.blocked;
    } else {
      if (memory_ != nullptr) memory_->written(now);
      write_token(in_->get(), shape_, place_, *volume_);
      place_.next(shape_);
      if (place_.ordinal == shape_.tokens()) place_ = {};
      ++written_, last_cycle_ = now;
      ++cycles_.busy;
    }
  }
  void memory(StreamMemory* memory) { memory_ = memory; }
  bool done() const { return written_ == to_write_; }
  // Tokens written before this cycle: it must not matter which block runs first.
  std::int64_t written_before(std::int64_t now) const { return written_ - (last_cycle_ == now ? 1 : 0); }
  const StageCycles& cycles() const { return cycles_; }

 private:
  Shape shape_;
  CellFifo* in_ = nullptr;
  StreamMemory* memory_ = nullptr;
  state::Volume* volume_ = nullptr;
  Place place_;
  std::int64_t to_write_ = 0, written_ = 0, last_cycle_ = -1;
  StageCycles cycles_;
};

// Streams a volume out of memory. In a pass that follows without a gap, a token may be read only when the
// writer has written it: the writer gives the reader a credit per token.
class Reader {
 public:
  explicit Reader(const Shape& shape) : shape_(shape) {}
  void connect(CellFifo& out, const Writer& writer) { out_ = &out, writer_ = &writer; }
  void begin_pass(const state::Volume& volume) { volume_ = &volume, place_ = {}, passes_before_ = 0; }
  // True with the last token of a pass: another one may follow now.
  bool cycle(std::int64_t now) {
    if (place_.ordinal == shape_.tokens()) {
      ++cycles_.fill_drain;
    } else if (!may_read(now)) {
      ++cycles_.starved;
    } else if (!out_->ready()) {
      ++cycles_.blocked;
    } else {
      if (memory_ != nullptr) memory_->read(now);
      read_token(*volume_, shape_, place_, out_->put());
      place_.next(shape_);
      ++cycles_.busy;
      return place_.ordinal == shape_.tokens();
    }
    return false;
  }
  void add_pass() { ++passes_before_, place_ = {}; }
  void memory(StreamMemory* memory) { memory_ = memory; }
  const StageCycles& cycles() const { return cycles_; }

 private:
  bool may_read(std::int64_t now) const {
    if (memory_ != nullptr && !memory_->may_read(now)) return false;
    if (passes_before_ == 0) return true;
    return writer_->written_before(now) > (passes_before_ - 1) * shape_.tokens() + place_.ordinal;
  }

  Shape shape_;
  CellFifo* out_ = nullptr;
  const Writer* writer_ = nullptr;
  StreamMemory* memory_ = nullptr;
  const state::Volume* volume_ = nullptr;
  Place place_;
  std::int64_t passes_before_ = 0;  // of the train
  StageCycles cycles_;
};

// Streams irradiance to one time step.
class Feed {
 public:
  Feed(const Shape& shape, HeatFifo& out) : shape_(shape), out_(out) {}
  void begin_pass(const state::Field<std::uint16_t>* field) {
    field_ = field, place_ = {};
    passes_left_ = 0;
  }
  // Another pass in which the time step works, with the same irradiance.
  void add_pass() { ++passes_left_; }
  void memory(StreamMemory* memory, int t) { memory_ = memory, step_ = t; }
  void cycle(std::int64_t now) {
    if (place_.ordinal == shape_.tokens() && passes_left_ > 0) --passes_left_, place_ = {};
    if (field_ == nullptr || place_.ordinal == shape_.tokens()) {
      ++(field_ == nullptr ? cycles_.bypassed : cycles_.fill_drain);
      return;
    }
    if (!out_.ready()) {
      ++cycles_.blocked;
      return;
    }
    if (memory_ != nullptr && !memory_->may_feed(step_, now)) {
      ++cycles_.starved;
      return;
    }
    if (memory_ != nullptr) memory_->fed(step_, now);
    UInt<16>* lanes = out_.put();
    for (int lane = 0; lane < shape_.lanes; ++lane) {
      const int x = place_.x + lane;
      lanes[lane] = x < shape_.grid.x ? (*field_)[field_->layout().at(x, place_.y, place_.z)] : 0;
    }
    place_.next(shape_);
    ++cycles_.busy;
  }
  const StageCycles& cycles() const { return cycles_; }

 private:
  Shape shape_;
  HeatFifo& out_;
  const state::Field<std::uint16_t>* field_ = nullptr;
  StreamMemory* memory_ = nullptr;
  int step_ = 0;  // that it feeds
  Place place_;
  int passes_left_ = 0;
  StageCycles cycles_;
};

// The stages of one time step and the channels between them.
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
  // The first pass of a train begins with an empty machine; further ones are added.
  void begin_pass(const Pass& pass, int position, bool first) {
    const std::uint32_t step = pass.first + static_cast<std::uint32_t>(position);
    int copy = -1;
    for (const auto& stage : stages_) {
      if (stage->kind() == StageKind::settle) ++copy;
      const bool works = position < pass.steps && pass.uses(stage->kind(), copy);
      const step::Moment moment{step, pass.substep + std::max(copy, 0), pass.substeps};
      first ? stage->begin_pass(moment, !works) : stage->add_pass(moment, !works);
    }
  }

  const Stage& running() const { return *running_; }  // the last one that was evaluated

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
