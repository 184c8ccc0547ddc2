// The brick ray caster deals tiles to W pipes, which share a memory. There is one SystemC process per pipe,
// one for the memory and one for the tiles. Inside of them are plain two-phase channels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/pipe.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/check/token_source.h"
#include "hwmodel/fabric/memory_port.h"
#include "hwmodel/memory/counts.h"

namespace voxmelt::hwmodel {
class Simulation;
}

namespace voxmelt::hwmodel::raycast {

struct FrameEnd {
  std::int64_t cycles = 0;
  bool complete = false, hangs = false;
};

struct MemoryCounts {
  std::int64_t reads = 0, read_bytes = 0, written_bytes = 0, bus_cycles = 0;
  std::optional<memory::Counts> dram;
};

// Holds what a ray caster shares with other machines: a simulation, and a memory in which its bytes begin at
// `base`.
struct Shares {
  Simulation& simulation;
  memory::Memory& memory;
  std::int64_t base;
};

class RayCaster final : public TokenSource {
 public:
  // Registers and memory belong to the host, who may change both between two frames.
  RayCaster(const Registers& registers, Memory& memory, const Configuration& configuration,
            const PipeMaker& make = make_pipe, const std::optional<Shares>& shares = {});
  ~RayCaster() override;
  RayCaster(const RayCaster&) = delete;
  RayCaster& operator=(const RayCaster&) = delete;

  void watch(const Watchers& watchers);
  void stop() override;  // after the present cycle
  void poll(std::function<void()> poll);
  void each_cycle(std::function<void()> call);  // called when all blocks have run theirs

  // Names the stage in which a value did not fit its wire.
  class StageError : public std::runtime_error {
   public:
    StageError(const std::string& what, std::string failed)
        : std::runtime_error(what), stage(std::move(failed)) {}
    std::string stage;
  };

  // Draws only these pixels from now on. Other pixels keep bytes of no meaning.
  void draw_only(const Window& window);
  // Begins to draw every pixel with one sample, into the frame at Memory::frame.
  void begin_first();
  // Begins to draw pixels that differ by more than `most`, with so many samples, into the frame behind it.
  void begin_again(int samples, int most);
  // The function is called when a pass has ended. It may begin another pass, from the next cycle on.
  void when_ended(std::function<void(const FrameEnd&)> call);
  void run();  // until a pass has ended and begun no other; throws what a stage has thrown
  // Each of these draws one pass alone.
  FrameEnd draw_first();
  FrameEnd draw_again(int samples, int most);

  // The host calls these after an upload: lines of volume i (Pipe::caches) are others, or all is new.
  void forget(std::size_t i, const std::vector<std::int64_t>& lines);
  void forget_all();

  std::int64_t cycle() const override;  // counted from the begin of the present frame
  // Tools see the channels inside of the pipes, and all stages.
  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override;
  std::vector<StageClasses> stage_classes() const override;
  std::vector<std::int64_t> stage_counts() const override;
  int pipes() const;
  const Pipe& pipe(int i) const;
  MemoryCounts memory_counts() const;

 private:
  struct Machine;
  std::unique_ptr<Simulation> own_;  // none if it is in somebody else's
  Simulation& simulation_;
  std::unique_ptr<Machine> machine_;
};

// Returns the bytes of a frame in memory.
std::int64_t frame_bytes(int width, int height);

}  // namespace voxmelt::hwmodel::raycast
