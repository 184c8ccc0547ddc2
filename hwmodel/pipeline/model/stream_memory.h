// When a memory gives the pipeline its tokens and takes them. Bytes do not move here: the pipeline reads and
// writes the volume itself, when it may. What a block is told holds from the begin of the cycle, so that the
// order of the blocks cannot matter.
#pragma once

#include <array>
#include <cstdint>

namespace voxmelt::hwmodel {

class IrradianceStream;
class StoredColumns;

class StreamMemory {
 public:
  virtual ~StreamMemory() = default;

  struct Train {
    int tile = 0;                                   // with which it begins
    int fed = 0;                                    // time steps that read irradiance
    const IrradianceStream* irradiance = nullptr;   // that they read; null: it is dark
    std::array<const StoredColumns*, 2> columns{};  // what the copies of the state hold, where it is coded
  };
  // A train begins with a pass, or with a tile of one; more are added while it runs. Nothing of an older
  // train is under way.
  virtual void begin_train(const Train& train) = 0;
  virtual void add_pass(int tile, int fed) = 0;

  // May the next token be read, fed to time step `t`, or written? A feed needs the first `bits` of a pass. So
  // does the reader of a column, where the state is coded. Only what its tile owns is written.
  virtual bool may_read(std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_feed(int t, std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_write(std::int64_t now) const = 0;
  // It was. The first `bits` of the pass, or column, are not needed any more, or have been written; `ends`:
  // it has no more.
  virtual void read(std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void fed(int t, std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void written(std::int64_t bits, bool ends, std::int64_t now) = 0;

  virtual void cycle(std::int64_t now) = 0;  // once in every cycle of the machine
  // Has the memory all that was written? A train ends no sooner.
  virtual bool settled() const { return true; }
};

}  // namespace voxmelt::hwmodel
