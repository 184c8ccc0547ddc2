// A stream machine is the automaton's stream as its checkers see it. It runs trains of passes over a volume,
// shows the tokens behind every stage, and accounts for every cycle. The SystemC pipeline is one, and a
// simulation of RTL can be another.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hwmodel/check/token_source.h"
#include "hwmodel/pipeline/model/configuration.h"
#include "hwmodel/pipeline/model/fall_stream.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/memory_ports.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/stream_memory.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// Describes a channel. Those of the main stream come first, in its order, and then the feeds.
struct ChannelReport {
  std::string name;  // "step 0: gravity -> pattern"
  StageKind producer = StageKind::reader;
  int cascade = 0;  // position of its producer
  int depth = 0, bits = 0, highest = 0, count = 0;
  std::int64_t entered = 0;             // tokens, in the present train
  std::vector<std::int64_t> occupancy;  // cycles with 0, 1, ... tokens
};

// Holds what the host has computed beside the pipeline, and the feeds stream.
struct Fed {
  Fed(const IrradianceStream* of_heat = nullptr, const FallStream* of_pieces = nullptr)
      : irradiance(of_heat), falls(of_pieces) {}
  const IrradianceStream* irradiance;  // null without radiation
  const FallStream* falls;             // null if nothing falls
};

struct StageReport {
  StageKind kind = StageKind::reader;
  int cascade = 0;
  std::int64_t lag = 0;
  StageCycles cycles;
  std::vector<BufferCost> buffers;
  Units units;
  std::int64_t moved_bits = 0;  // between the memory and a reader, writer or feed
};

// Tells how a train of passes ended.
struct PassEnd {
  std::int64_t cycles = 0;
  int passes = 0;         // passes that began; every tile counts
  bool complete = false;  // false: the watcher stopped it, or it hangs
  bool hangs = false;
  std::int64_t held = 0;  // cycles in which serial dividers held stages (hw.registers)
};

// Reports a value that did not fit its wire, or an address that its memory does not have.
struct StageError : std::runtime_error {
  enum class Kind : std::uint8_t { width, address };
  StageError(const std::string& what, Kind wrong) : std::runtime_error(what), kind(wrong) {}
  Kind kind;
  StageKind stage = StageKind::reader;
  std::uint32_t step = 0;
  Spot spot;
  int cascade = 0;  // position of the stage's time step
  std::int64_t cycle = 0;
};

// Its token channels are those of the main stream, in its order.
class StreamMachine : public TokenSource {
 public:
  virtual const Design& design() const = 0;
  virtual const Configuration& configuration() const = 0;

  // The watcher sees every token of the main stream. If it calls `stop`, the pass ends after the
  // present cycle.
  virtual void watch(FifoWatcher<Cell>* watcher) = 0;
  virtual void watch_columns(ColumnWatcher* watcher) = 0;        // columns that are written with hw.coded
  virtual void watch_feeds(FifoWatcher<UInt<16>>* watcher) = 0;  // channels: kFirstFeedChannel + time step
  virtual void watch_falls(FifoWatcher<UInt<1>>* watcher) = 0;   // the channel of the cells that fall
  static constexpr int kFirstFeedChannel = 1000, kFallChannel = 2000;
  // `watch` is called at the end of every cycle of every block. Then the accounts of all stages include this
  // cycle.
  virtual void each_cycle(std::function<void()> watch) = 0;
  virtual void memory(StreamMemory* memory) = 0;  // null: no token waits for a memory
  // `poll` is called now and then during a pass. An exception from it ends the pass.
  virtual void poll(std::function<void()> poll) = 0;

  // Streams passes over `volume`. Stages that a pass does not use are bypassed. When the last token of a pass
  // has been read, `next` says which pass follows without a gap, if any. It may be the next tile if
  // `tiles_follow` holds. Behind the last tile it may be the first one of a pass that has no more steps, if
  // `passes_overlap` holds (prediction.h). In a pass with `falls`, `fed` has the cells that fall. Throws
  // StageError.
  using Next = std::function<std::optional<Pass>()>;
  virtual PassEnd run_train(const Pass& first, const Next& next, const Fed& fed, state::Volume& volume) = 0;
  virtual const Books& books() const = 0;            // sums of the pass that has been written last
  virtual const state::Volume& written() const = 0;  // volume to which the last token went

  virtual std::vector<ChannelReport> channels() const = 0;
  virtual std::vector<StageReport> stages() const = 0;    // the reader first, the writer last
  virtual std::vector<StageCycles> accounts() const = 0;  // accounts of the same stages
};

}  // namespace voxmelt::hwmodel
