// The streaming pipeline: reader, T cascaded time steps, writer, under SystemC. One process per block; inside
// a block plain two-phase registers.
//
//   memory -> reader -> [step t] -> [step t + 1] -> ... -> writer -> memory
//                          ^             ^
//                        feed          feed        (irradiance, where the scene has radiation)
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "hwmodel/check/token_source.h"
#include "hwmodel/pipeline/model/configuration.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/memory_ports.h"
#include "hwmodel/pipeline/model/stages.h"
#include "hwmodel/pipeline/model/stream_memory.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// A channel: those of the main stream in its order, then the feeds.
struct ChannelReport {
  std::string name;  // "step 0: gravity -> pattern"
  StageKind producer = StageKind::reader;
  int cascade = 0;  // position of its producer
  int depth = 0, bits = 0, highest = 0, count = 0;
  std::int64_t entered = 0;             // tokens, in the present train
  std::vector<std::int64_t> occupancy;  // cycles with 0, 1, ... tokens
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

// How a train of passes ended.
struct PassEnd {
  std::int64_t cycles = 0;
  int passes = 0;         // that began; of a grid in tiles, every tile counts
  bool complete = false;  // else it was stopped by the watcher, or it hangs
  bool hangs = false;
};

class Simulation;

class Pipeline final : public TokenSource {
 public:
  // `make` makes its stages, which may have planted faults. `simulation`: with other machines in it, which go
  // on while a train runs; null: one of its own.
  Pipeline(const rule::Parameters& parameters, state::Grid grid, const Configuration& configuration,
           const StageMaker& make = make_stage, Simulation* simulation = nullptr);
  ~Pipeline() override;
  Pipeline(const Pipeline&) = delete;
  Pipeline& operator=(const Pipeline&) = delete;

  // The watcher sees every token of the main stream. If it calls `stop`, the pass ends after the
  // present cycle.
  void watch(FifoWatcher<Cell>* watcher);
  void stop() override;
  std::vector<CellFifo*> channels_behind_stages(int cascade);  // of one time step, for faults to be planted
  void plant(PortFault* fault);                                // null: none
  void plant(FeedFault* fault);
  void plant(CodeFault* fault);
  void watch_columns(ColumnWatcher* watcher);        // that are written with hw.coded
  void watch_feeds(FifoWatcher<UInt<16>>* watcher);  // their channels: kFirstFeedChannel + time step
  static constexpr int kFirstFeedChannel = 1000;
  const Books& books() const;            // of the pass that has been written last
  const state::Volume& written() const;  // where the last token went
  // Called at the end of every cycle of every block: then the accounts of all stages include this cycle.
  void each_cycle(std::function<void()> watch);
  void memory(StreamMemory* memory);      // null: it always answers
  void poll(std::function<void()> poll);  // called now and then during a pass; what it throws ends the pass

  // Where a value did not fit its wire, or an address its memory.
  class StageError : public std::runtime_error {
   public:
    enum class Kind : std::uint8_t { width, address };
    StageError(const std::string& what, Kind wrong, const Stage& failed, int position, std::int64_t when)
        : std::runtime_error(what),
          kind(wrong),
          stage(failed.kind()),
          step(failed.working_step()),
          spot(failed.spot()),
          cascade(position),
          cycle(when) {}
    Kind kind;
    StageKind stage;
    std::uint32_t step;
    Spot spot;
    int cascade;
    std::int64_t cycle;
  };

  // Streams a tile of `volume` once; what the pass does not use is bypassed. `irradiance`: null without
  // radiation. Throws StageError.
  PassEnd run_pass(const Pass& pass, const Irradiance* irradiance, state::Volume& volume);
  // A train: when the last token of a pass has been read, `next` says which pass follows without a gap, if
  // any: the next tile, where `tiles_follow` holds, or behind the last tile the first one of a pass that has
  // no more steps, where `passes_overlap` does (prediction.h).
  using Next = std::function<std::optional<Pass>()>;
  PassEnd run_train(const Pass& first, const Next& next, const IrradianceStream* irradiance,
                    state::Volume& volume);

  const Design& design() const;
  const Configuration& configuration() const;
  std::int64_t cycle() const override;  // of the present train
  // As tools see it: the channels of the main stream, and all stages.
  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override;
  std::vector<StageClasses> stage_classes() const override;
  std::vector<std::int64_t> stage_counts() const override;
  std::vector<ChannelReport> channels() const;
  std::vector<StageReport> stages() const;           // the reader first, the writer last
  std::vector<const Stage*> working_stages() const;  // without the reader, the feeds and the writer
  std::vector<StageCycles> accounts() const;         // of the same

 private:
  struct Machine;
  std::unique_ptr<Simulation> own_;  // none: it is in somebody else's
  Simulation& simulation_;
  std::unique_ptr<Machine> machine_;
};

}  // namespace voxmelt::hwmodel
