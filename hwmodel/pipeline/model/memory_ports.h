// Reader and writer are the blocks between the memory and the stream. They are plain C++ that runs one cycle
// at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>

#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/state_memory.h"
#include "hwmodel/pipeline/model/stream_memory.h"
#include "hwmodel/pipeline/model/volume_port.h"

namespace voxmelt::hwmodel {

// Sums the matter that the writer writes in a pass. Every cell of the grid counts once.
struct Books {
  std::int64_t cells = 0, mass = 0, energy = 0, heat = 0;  // heat: sum of amount x heat

  void add(const Cell& cell) {
    ++cells;
    if (!cell.matter()) return;
    mass += cell.amount;
    energy += cell.energy;
    heat += cell.amount * cell.heat;
  }
};

// Lets a planted fault spoil what passes between the memory and the stream.
class PortFault {
 public:
  virtual ~PortFault() = default;
  // `pass` counts the tiles that have been read, or written, in the present train.
  virtual void reads(std::int64_t pass, const Place& place, const StateMemory& memory, Cell* lanes) = 0;
  // These are called for a token that another tile owns. They return the one lane that is written or counted
  // all the same, or -1 for none.
  virtual int writes(std::int64_t pass, const Place& place, StateMemory& memory, const Cell* lanes) = 0;
  virtual int counts(std::int64_t pass, const Place& place) = 0;
};

// Sees whole columns that have been written with hw.coded.
class ColumnWatcher {
 public:
  virtual ~ColumnWatcher() = default;
  // `place` is in the column.
  virtual void column_written(const Place& place, const std::uint64_t* slot) = 0;
};

inline bool ends_column(const Shape& shape, const Place& place) { return place.y + 1 == shape.grid.y; }

// Streams the result into memory, behind the reader. It writes the cells that a tile owns.
class Writer {
 public:
  Writer(const Shape& shape, StateMemory& memory) : shape_(shape), memory_(memory) {
    if (memory.coded()) column_.emplace(memory.written_code().layout());
  }
  void connect(CellFifo& in) { in_ = &in; }
  void begin_pass(int tile) {
    tiles_ = {tile};
    place_ = begin_of(shape_, tile);
    first_ = written_ = tile * shape_.tokens();
    last_cycle_ = -1;
    passes_ = 0;
  }
  void add_pass(int tile) { tiles_.push_back(tile); }
  void cycle(std::int64_t now) {
    if (done()) {
      ++cycles_.fill_drain;
    } else if (!in_->valid()) {
      ++(written_ == first_ ? cycles_.fill_drain : cycles_.starved);
    } else if (dram_ != nullptr && owns() && !dram_->may_write(now)) {
      ++cycles_.memory;
    } else {
      write(in_->get());
      if (dram_ != nullptr && owns())
        dram_->written(column_ ? column_->bits() : 0, ends_column(shape_, place_), now);
      ++written_;
      last_cycle_ = now;
      ++cycles_.busy;
      place_.next(shape_);
      if (place_.ordinal == shape_.tokens()) end_tile();
    }
  }
  bool done() const { return tiles_.empty(); }
  // Counts the tokens of passes that were written before this cycle, from the begin of that in which the
  // train began. It must not matter which block runs first.
  std::int64_t written_before(std::int64_t now) const { return written_ - (last_cycle_ == now ? 1 : 0); }
  const StageCycles& cycles() const { return cycles_; }
  std::int64_t stored() const { return stored_; }  // tokens that went to memory, each from its owner
  // Returns the volume to which the last token went.
  const state::Volume& written() const { return *last_written_; }
  const Books& books() const { return closed_; }  // sums of the last pass that is written whole
  // Counts the bits that went to memory with hw.coded, in whole bursts.
  std::int64_t coded_bits() const { return coded_bits_; }
  void plant(PortFault* fault) { fault_ = fault; }
  void plant(CodeFault* fault) { code_fault_ = fault; }
  void watch(ColumnWatcher* watcher) { watcher_ = watcher; }
  void dram(StreamMemory* dram) { dram_ = dram; }

 private:
  bool owns() const { return shape_.owns(tiles_.front(), place_.x); }
  void write_coded(const Cell* lanes) {
    CodedState& memory = memory_.written_code();
    std::uint64_t* slot = memory.slot(memory.layout().column_of(place_));
    column_->put(lanes, std::min(shape_.lanes, shape_.grid.x - place_.x), place_, slot, code_fault_, passes_);
    if (!ends_column(shape_, place_)) return;
    coded_bits_ += CodeLayout::up(column_->bits());
    memory.load(shape_, place_, memory_.written(), memory_.written_set());
    if (watcher_ != nullptr) watcher_->column_written(place_, slot);
  }
  void write(const Cell* lanes) {
    const int tile = tiles_.front();
    last_written_ = &memory_.written();
    if (tile == 0 && place_.ordinal == 0) open_ = {};
    if (shape_.owns(tile, place_.x)) {
      ++stored_;
      if (column_)
        write_coded(lanes);
      else
        write_token(lanes, shape_, place_, memory_.written(), memory_.written_set());
      for (int lane = 0; lane < shape_.lanes && place_.x + lane < shape_.grid.x; ++lane)
        open_.add(lanes[lane]);
    } else if (fault_ != nullptr) {
      const int counted = fault_->counts(passes_, place_);
      if (counted >= 0) open_.add(lanes[counted]);
      const int written = fault_->writes(passes_, place_, memory_, lanes);
      if (written >= 0) write_cell(lanes[written], place_.x + written, place_.y, place_.z, memory_.written());
    }
  }
  void end_tile() {
    if (tiles_.front() + 1 == shape_.tiles()) {
      memory_.next_to_write();
      closed_ = open_;
    }
    tiles_.pop_front();
    ++passes_;
    if (!done()) place_ = begin_of(shape_, tiles_.front());
  }

  Shape shape_;
  StateMemory& memory_;
  StreamMemory* dram_ = nullptr;  // memory that the writer waits for; null: none
  CellFifo* in_ = nullptr;
  std::deque<int> tiles_;  // tiles still to be written
  Place place_;
  std::int64_t first_ = 0, written_ = 0, stored_ = 0, last_cycle_ = -1, passes_ = 0;
  const state::Volume* last_written_ = nullptr;
  Books open_, closed_;
  std::optional<ColumnWriter> column_;  // with hw.coded
  std::int64_t coded_bits_ = 0;
  PortFault* fault_ = nullptr;
  CodeFault* code_fault_ = nullptr;
  ColumnWatcher* watcher_ = nullptr;
  StageCycles cycles_;
};

// Streams a volume out of memory. In a pass that follows without a gap, a token may be read only when the
// writer has written it. The writer gives the reader a credit per token, and with hw.coded per column.
class Reader {
 public:
  Reader(const Shape& shape, StateMemory& memory) : shape_(shape), memory_(memory) {
    if (memory.coded()) column_.emplace(memory.read_code().layout());
  }
  void connect(CellFifo& out, const Writer& writer) {
    out_ = &out;
    writer_ = &writer;
  }
  void begin_pass(int tile) {
    place_ = begin_of(shape_, tile);
    passes_ = grids_before_ = 0;
  }
  // Returns true with the last token of a tile. Another tile may follow then.
  bool cycle(std::int64_t now) {
    if (place_.ordinal == shape_.tokens()) {
      ++cycles_.fill_drain;
    } else if (!may_read(now)) {
      ++cycles_.starved;
    } else if (!memory_gives(now)) {
      ++cycles_.memory;
    } else if (!out_->ready()) {
      ++cycles_.blocked;
    } else {
      Cell* lanes = out_->put();
      if (column_)
        read_coded(lanes);
      else
        read_token(memory_.read(), shape_, place_, lanes, memory_.read_set());
      if (dram_ != nullptr) dram_->read(column_ ? column_->used() : 0, ends_column(shape_, place_), now);
      if (fault_ != nullptr) fault_->reads(passes_, place_, memory_, lanes);
      place_.next(shape_);
      ++cycles_.busy;
      return place_.ordinal == shape_.tokens();
    }
    return false;
  }
  void add_pass(int tile) {
    ++passes_;
    if (tile == 0) {
      ++grids_before_;
      memory_.next_to_read();
    }
    place_ = begin_of(shape_, tile);
  }
  const StageCycles& cycles() const { return cycles_; }
  // Counts the bits that came from memory with hw.coded, in whole bursts.
  std::int64_t coded_bits() const { return coded_bits_; }
  void plant(PortFault* fault) { fault_ = fault; }
  void plant(CodeFault* fault) { code_fault_ = fault; }
  void dram(StreamMemory* dram) { dram_ = dram; }

 private:
  bool may_read(std::int64_t now) const {  // the token has been written
    if (grids_before_ > 0) {
      const std::int64_t before = (grids_before_ - 1) * shape_.tiles() * shape_.tokens();
      const int y = column_ ? shape_.grid.y - 1 : place_.y;
      if (writer_->written_before(now) <= before + owned_ordinal(shape_, place_.x, y, place_.z)) return false;
    }
    return true;
  }
  bool memory_gives(std::int64_t now) const {
    return dram_ == nullptr || dram_->may_read(column_ ? column_->needs(place_, slot()) : 0, now);
  }
  const std::uint64_t* slot() const {
    const CodedState& memory = memory_.read_code();
    return memory.slot(memory.layout().column_of(place_));
  }
  void read_coded(Cell* lanes) {
    column_->get(lanes, std::min(shape_.lanes, shape_.grid.x - place_.x), place_, slot(), code_fault_,
                 passes_);
    if (ends_column(shape_, place_)) coded_bits_ += CodeLayout::up(column_->used());
  }

  Shape shape_;
  StateMemory& memory_;
  StreamMemory* dram_ = nullptr;  // memory that the reader waits for; null: none
  CellFifo* out_ = nullptr;
  const Writer* writer_ = nullptr;
  Place place_;
  std::int64_t passes_ = 0, grids_before_ = 0;  // tiles, and whole grids, that the train has read before
  std::optional<ColumnReader> column_;          // with hw.coded
  std::int64_t coded_bits_ = 0;
  PortFault* fault_ = nullptr;
  CodeFault* code_fault_ = nullptr;
  StageCycles cycles_;
};

}  // namespace voxmelt::hwmodel
