// The state lies on a DRAM column by column if hw.coded is set or the grid is cut into tiles. Each column of
// a block has a slot of its own, which begins with a burst. So a tile reads and writes whole bursts, and no
// burst has two owners.
//
// With the code (hwmodel/pipeline/model/coded_state.h) the begin of a column tells how many bursts follow. So
// begins are read ahead.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hwmodel/fabric/memory_port.h"
#include "hwmodel/pipeline/model/coded_state.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kBurstsAhead = 128;  // buffer of a stream: 8 KiB

// Tells where the columns of a grid lie. A grid in tiles has two copies, and a pass reads one and writes the
// other.
struct ColumnSlots {
  // `base` is the address of the first byte.
  ColumnSlots(const Design& design, bool coded, std::int64_t base = 0);

  std::int64_t address(std::int64_t column, std::int64_t copy) const {
    return base + (copy % copies * columns + column) * slot_bursts * memory::kBurst;
  }
  std::int64_t bytes() const { return copies * columns * slot_bursts * memory::kBurst; }

  Shape shape;
  bool coded;
  std::int64_t base;
  std::int64_t copies, columns;
  std::int64_t head_bursts = 0;  // hold the bits of a column's tokens
  std::int64_t slot_bursts = 0;
};

// Goes through the columns of a train in the order of its stream, tile by tile. It visits all
// columns that a tile reads, or only those that it owns.
class ColumnWalk {
 public:
  void begin(const ColumnSlots& slots, bool owned);
  void add(int tile);  // after those that were added before

  struct Column {
    std::int64_t number = 0, pass = 0;  // number in the grid; passes of the whole grid before this one
  };
  bool done() const { return tiles_.empty(); }
  Column now() const;
  void next();

 private:
  struct Tile {
    int tile;
    std::int64_t pass;
  };
  void begin_row();  // begins the columns of a tile at one z

  Shape shape_;
  bool owned_ = false, any_ = false;
  std::deque<Tile> tiles_;
  std::int64_t passes_ = 0;
  int block_ = 0, end_ = 0, z_ = 0;
};

class ColumnOutput;

// Reads columns. A stamp is a cycle, and what happens in a cycle is seen in the next one.
class ColumnInput {
 public:
  // `stored` tells what the copies hold, with hw.coded.
  void begin(const ColumnSlots& slots, std::array<const StoredColumns*, 2> stored, memory::Memory& memory,
             int port);
  void add(int tile) { walk_.add(tile); }

  // Returns true if the first `bits` of the present column have come.
  bool has(std::int64_t bits, std::int64_t now) const;
  // Says that the first `bits` are not needed any more. `ends` says that the column is not, either.
  void use(std::int64_t bits, bool ends, std::int64_t now);
  // Takes what has come, and asks for more, from columns that have been written.
  void cycle(const ColumnOutput& written, std::int64_t now);
  bool settled() const { return under_way_.empty(); }  // all that was asked for has come

 private:
  struct Column {
    ColumnWalk::Column at;
    std::int64_t bursts = 0;  // 0: not known yet
    std::int64_t asked = 0;
    std::vector<std::int64_t> come{};  // cycle in which each burst came
  };
  void take(std::int64_t now);
  bool room(std::int64_t now) const {
    return asked_ - (last_used_ == now ? freed_before_ : freed_) < kBurstsAhead && memory_->ready(port_);
  }
  void ask(Column& column, std::int64_t number, std::int64_t bursts, std::int64_t now);
  std::int64_t done_before(std::int64_t now) const { return last_done_ == now ? done_ - 1 : done_; }

  memory::Memory* memory_ = nullptr;
  std::optional<ColumnSlots> slots_;
  std::array<const StoredColumns*, 2> stored_{};
  ColumnWalk walk_;  // columns that have not been asked for
  int port_ = -1;
  std::int64_t done_ = 0, last_done_ = -1;  // columns of the train that are done; the cycle of the last one
  std::deque<Column> ahead_;                // some done columns, the present one, further ones
  std::int64_t first_ = 0;                  // number of the first of these
  std::deque<std::int64_t> under_way_;      // the column of each burst that has been asked for
  std::int64_t asked_ = 0, freed_ = 0, freed_before_ = 0, freed_of_column_ = 0, last_used_ = -1;  // bursts
};

// Writes columns. Full bursts go at once, and those with the bits of the tokens go when the column ends.
class ColumnOutput {
 public:
  void begin(const ColumnSlots& slots, memory::Memory& memory, int port);
  void add(int tile) { walk_.add(tile); }

  bool may_write(std::int64_t now) const { return waiting_[now & 1] <= kBurstsAhead; }
  void written(std::int64_t bits, bool ends, std::int64_t now) { events_.push_back({bits, ends, now}); }
  void cycle(std::int64_t now);
  bool settled() const { return events_.empty() && bursts_.empty(); }  // all was handed to the memory
  // Returns the number of passes of the train in which all of this column has been handed to the memory.
  std::int64_t passes(std::int64_t column) const { return passes_[column]; }

 private:
  struct Event {
    std::int64_t bits;  // size of the present column so far
    bool ends;
    std::int64_t cycle;
  };
  struct Burst {
    std::int64_t address;
    std::int64_t column;  // the column that ends with it; -1: none
  };
  void fill(const Event& event);

  memory::Memory* memory_ = nullptr;
  std::optional<ColumnSlots> slots_;
  ColumnWalk walk_;  // the present column, and further ones
  int port_ = -1;
  std::int64_t full_ = 0;  // bursts of the present column that are full
  std::vector<std::int64_t> passes_;
  std::deque<Event> events_;
  std::deque<Burst> bursts_;
  std::array<std::int64_t, 2> waiting_{};  // bursts, at the begin of even and of odd cycles
};

}  // namespace voxmelt::hwmodel
