// The coded state on a DRAM (hwmodel/stream/coded_state.h): bursts of a column are asked for when the bits of
// its tokens have come, and tell how many there are. So the begins of columns are read ahead.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "hwmodel/memory/dram.h"
#include "hwmodel/stream/coded_state.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kBurstsAhead = 128;  // of a stream's buffer: 8 KiB

// Reads columns in their order, pass after pass. Cycles are stamps: what happens in a cycle is seen in the
// next one.
class CodedInput {
 public:
  void begin(const CodeLayout& layout, const StoredColumns& memory, memory::Dram& dram);
  void add_pass() { wanted_ += columns_; }

  // Have the first `bits` of the present column come?
  bool has(std::int64_t bits, std::int64_t now) const;
  // They are not needed any more; `ends`: nor is the column.
  void use(std::int64_t bits, bool ends, std::int64_t now);
  // Takes what has come, and asks for more: of the first `readable` columns.
  void cycle(std::int64_t readable, std::int64_t now);

 private:
  struct Column {
    std::int64_t bursts = 0;  // 0: not known yet
    std::int64_t asked = 0;
    std::vector<std::int64_t> come;  // in which cycle each burst came
  };
  bool ask(Column& column, std::int64_t number);
  std::int64_t freed_before(std::int64_t now) const { return last_used_ == now ? freed_before_ : freed_; }
  std::int64_t done_before(std::int64_t now) const { return last_done_ == now ? done_ - 1 : done_; }

  memory::Dram* dram_ = nullptr;
  const StoredColumns* memory_ = nullptr;
  int port_ = -1;
  std::int64_t columns_ = 0, head_bursts_ = 0, slot_bytes_ = 0;
  std::int64_t wanted_ = 0, done_ = 0, last_done_ = -1;  // columns of the train; the cycle of the last one
  std::deque<Column> ahead_;                             // some that are done, the present one, further ones
  std::int64_t first_ = 0;                               // number of the first of these
  std::deque<std::int64_t> under_way_;                   // the column of each burst that has been asked for
  std::int64_t asked_ = 0, freed_ = 0, freed_before_ = 0, freed_of_column_ = 0, last_used_ = -1;  // bursts
};

// Writes columns. Bursts go when they are full, those with the bits of the tokens when the column ends.
class CodedOutput {
 public:
  void begin(const CodeLayout& layout, memory::Dram& dram);

  bool may_write(std::int64_t now) const { return waiting_[now & 1] <= kBurstsAhead; }
  void written(std::int64_t bits, bool ends, std::int64_t now) { events_.push_back({bits, ends, now}); }
  void cycle(std::int64_t now);
  std::int64_t handed() const { return handed_; }  // columns, whole

 private:
  struct Event {
    std::int64_t bits;  // of the present column so far
    bool ends;
    std::int64_t cycle;
  };
  struct Burst {
    std::int64_t address;
    bool last;  // of its column
  };
  void fill(const Event& event);

  memory::Dram* dram_ = nullptr;
  int port_ = -1;
  std::int64_t columns_ = 0, head_bursts_ = 0, slot_bytes_ = 0;
  std::int64_t column_ = 0, full_ = 0, handed_ = 0;  // of the train; bursts of it that have gone
  std::deque<Event> events_;
  std::deque<Burst> bursts_;
  std::int64_t waiting_[2] = {0, 0};  // bursts, at the begin of even and of odd cycles
};

}  // namespace voxmelt::hwmodel
