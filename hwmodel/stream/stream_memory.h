// When a memory gives the pipeline its tokens and takes them. Bytes do not move here: the pipeline reads and
// writes the volume itself, when it may. What a block is told holds from the begin of the cycle, so that the
// order of the blocks cannot matter.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel {

class StoredColumns;

class StreamMemory {
 public:
  virtual ~StreamMemory() = default;

  // A train begins with one pass of so many tokens, of which `fed` time steps read all of so many bits of
  // irradiance; more passes are added while it runs. Nothing of an older train is under way. `columns`: what
  // the memory holds, where the state is coded; else null.
  virtual void begin_train(std::int64_t tokens, int fed, std::int64_t irradiance_bits,
                           const StoredColumns* columns) = 0;
  virtual void add_pass(int fed) = 0;

  // May the next token be read, fed to time step `t`, or written? A feed needs the first `bits` of a pass. So
  // does the reader of a column, where the state is coded.
  virtual bool may_read(std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_feed(int t, std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_write(std::int64_t now) const = 0;
  // It was. The first `bits` of the pass, or column, are not needed any more, or have been written; `ends`:
  // it has no more.
  virtual void read(std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void fed(int t, std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void written(std::int64_t bits, bool ends, std::int64_t now) = 0;

  virtual void cycle(std::int64_t now) = 0;  // once in every cycle of the machine
};

}  // namespace voxmelt::hwmodel
