// A feed streams to a stage what the host has computed beside the pipeline: irradiance, or which cells fall.
// It is plain C++ that runs one cycle at a time.
#pragma once

#include <cstdint>
#include <deque>

#include "hwmodel/pipeline/model/fall_stream.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/stage.h"
#include "hwmodel/pipeline/model/stream_memory.h"

namespace voxmelt::hwmodel {

// `Stream` lies in memory, and `Reader` makes tokens of it.
template <class Stream, class Reader, class Value>
class Feed {
 public:
  // The memory knows the feed by its `number`. Irradiance has that of its time step.
  Feed(const Shape& shape, int number, Fifo<Value>& out)
      : shape_(shape), number_(number), out_(out), reader_(shape.lanes) {}

  // `stream` is null if the time step does not work.
  void begin_pass(const Stream* stream, int tile) {
    stream_ = stream;
    passes_ = 0;
    next_.clear();
    begin_tile(tile);
  }
  // Adds another tile for which the time step works, with the same stream.
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
    if (dram_ != nullptr && !dram_->may_feed(number_, reader_.needs() * reader_.word_bits(), now)) {
      ++cycles_.memory;
      return;
    }
    const std::int64_t before = reader_.used();
    reader_.next(out_.put(), place_, fault_, number_, passes_);
    bits_ += (reader_.used() - before) * reader_.word_bits();
    place_.next(shape_);
    if (dram_ != nullptr)
      dram_->fed(number_, reader_.used() * reader_.word_bits(), place_.ordinal == shape_.tokens(), now);
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
  int number_;
  Fifo<Value>& out_;
  StreamMemory* dram_ = nullptr;  // memory that the feed waits for; null: none
  const Stream* stream_ = nullptr;
  Reader reader_;
  Place place_;
  std::deque<int> next_;  // the tiles that follow
  std::int64_t passes_ = 0, bits_ = 0;
  FeedFault* fault_ = nullptr;
  StageCycles cycles_;
};

using IrradianceFeed = Feed<IrradianceStream, IrradianceReader, UInt<16>>;
using FallFeed = Feed<FallStream, FallReader, UInt<1>>;

}  // namespace voxmelt::hwmodel
