// A stream memory decides when the pipeline may read its tokens, and when it may write them. Bytes do not
// move here. The pipeline reads and writes the volume itself, when it may. All answers hold from the begin of
// the cycle, so that the order of the blocks cannot matter.
#pragma once

#include <array>
#include <cstdint>

namespace voxmelt::hwmodel {

class FallStream;
class IrradianceStream;
class StoredColumns;

class StreamMemory {
 public:
  virtual ~StreamMemory() = default;

  struct Train {
    int tile = 0;                                   // first tile
    int fed = 0;                                    // time steps that read irradiance
    const IrradianceStream* irradiance = nullptr;   // irradiance that they read; null: it is dark
    std::array<const StoredColumns*, 2> columns{};  // contents of the copies of the state, if it is coded
    const FallStream* falls = nullptr;              // cells that fall; null: no cell does
  };
  // A train begins with a pass, or with a tile of one. More are added while it runs. Nothing of an older
  // train is under way.
  virtual void begin_train(const Train& train) = 0;
  virtual void add_pass(int tile, int fed) = 0;

  // Tell if the next token may be read, fed to time step `t`, or written. The feed of pieces has the number
  // behind those of all time steps. A feed needs the first `bits` of a pass. If the state is coded, so does
  // the reader of a column. Only the cells that a tile owns are written.
  virtual bool may_read(std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_feed(int t, std::int64_t bits, std::int64_t now) const = 0;
  virtual bool may_write(std::int64_t now) const = 0;
  // Report that this was done. The first `bits` of the pass, or column, are not needed any more, or have been
  // written. `ends` says that it has no more.
  virtual void read(std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void fed(int t, std::int64_t bits, bool ends, std::int64_t now) = 0;
  virtual void written(std::int64_t bits, bool ends, std::int64_t now) = 0;

  virtual void cycle(std::int64_t now) = 0;  // once in every cycle of the machine
  // Returns true if the memory has all that was written. A train ends no sooner.
  virtual bool settled() const { return true; }
  // Returns true while the memory works on a request, so that who waits for it does not hang.
  virtual bool works() const { return false; }
};

}  // namespace voxmelt::hwmodel
