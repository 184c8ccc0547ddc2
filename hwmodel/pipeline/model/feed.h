// A feed streams irradiance to one time step. It is plain C++ that runs one cycle at a time.
#pragma once

#include <cstdint>
#include <deque>

#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/stage.h"
#include "hwmodel/pipeline/model/stream_memory.h"

namespace voxmelt::hwmodel {

class Feed {
 public:
  Feed(const Shape& shape, int step, HeatFifo& out)
      : shape_(shape), step_(step), out_(out), reader_(shape.lanes) {}

  // `stream` is null if the time step does not work.
  void begin_pass(const IrradianceStream* stream, int tile) {
    stream_ = stream;
    passes_ = 0;
    next_.clear();
    begin_tile(tile);
  }
  // Adds another tile for which the time step works, with the same irradiance.
  void add_pass(int tile) { next_.push_back(tile); }
  void dram(StreamMemory* dram) { dram_ = dram; }
  void plant(FeedFault* fault) { fault_ = fault; }

  void cycle(std::int64_t now) {
    if (place_.ordinal == shape_.tokens() && !next_.empty()) {
      ++passes_;
      begin_tile(next_.front());
      next_.pop_front();
    }
    if (stream_ == nullptr || place_.ordinal == shape_.tokens()) {
      ++(stream_ == nullptr ? cycles_.bypassed : cycles_.fill_drain);
      return;
    }
    if (!out_.ready()) {
      ++cycles_.blocked;
      return;
    }
    if (dram_ != nullptr && !dram_->may_feed(step_, reader_.needs() * IrradianceStream::kWordBits, now)) {
      ++cycles_.memory;
      return;
    }
    const std::int64_t before = reader_.used();
    reader_.next(out_.put(), place_, fault_, step_, passes_);
    bits_ += (reader_.used() - before) * IrradianceStream::kWordBits;
    place_.next(shape_);
    if (dram_ != nullptr)
      dram_->fed(step_, reader_.used() * IrradianceStream::kWordBits, place_.ordinal == shape_.tokens(), now);
    ++cycles_.busy;
  }
  const StageCycles& cycles() const { return cycles_; }
  std::int64_t bits() const { return bits_; }  // bits taken from memory

 private:
  void begin_tile(int tile) {
    place_ = begin_of(shape_, tile);
    if (stream_ != nullptr) reader_.begin(stream_->words(tile));
  }

  Shape shape_;
  int step_;  // the time step that it feeds
  HeatFifo& out_;
  StreamMemory* dram_ = nullptr;  // memory that the feed waits for; null: none
  const IrradianceStream* stream_ = nullptr;
  IrradianceReader reader_;
  Place place_;
  std::deque<int> next_;  // the tiles that follow
  std::int64_t passes_ = 0, bits_ = 0;
  FeedFault* fault_ = nullptr;
  StageCycles cycles_;
};

}  // namespace voxmelt::hwmodel
