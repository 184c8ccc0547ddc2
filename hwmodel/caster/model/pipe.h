// A pipe of the ray caster has stages and the channels between them. One SystemC process evaluates all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/leap.h"
#include "hwmodel/caster/model/memory_port.h"
#include "hwmodel/caster/model/tile_stages.h"
#include "hwmodel/caster/model/walk_stage.h"
#include "hwmodel/check/token_source.h"

namespace voxmelt::hwmodel::raycast {

// Names the channels of a pipe, by what fills them.
enum class Channel : std::uint8_t {
  tiles,
  set_up,
  ground,
  walk_asks,
  crossing_asks,
  normal_asks,
  level_asks,
  levels,
  normal_levels,
  walk_levels,
  crossing_levels,
  hits,
  missed,
  crossed,
  met,
  normal,
  height_asks,
  heights,
  paint,
  texel_asks,
  texels,
  texture,
  matter_asks,
  matter_words,
  matter,
  light_asks,
  light_cells,
  light,
  arriving,
  mirror,
  colour,
  pressed,
  pixels,
  to_memory,
  // These are there for clear matter alone.
  stretch_asks,
  stretch_levels,
  exits,
  onward,
  passed
};

// Names the listeners to what leaves a stage. Null means nobody.
struct Watchers {
  FifoWatcher<TileOrder>* tiles = nullptr;
  FifoWatcher<RayToken>* set_up = nullptr;
  FifoWatcher<GroundedRay>* ground = nullptr;
  FifoWatcher<LevelRequest>* asks = nullptr;
  FifoWatcher<Levels>* levels = nullptr;
  FifoWatcher<LevelToken>* samples = nullptr;
  FifoWatcher<HitToken>* hits = nullptr;
  FifoWatcher<MetToken>* met = nullptr;
  FifoWatcher<Surface>* surfaces = nullptr;
  FifoWatcher<PressedToken>* pressed = nullptr;
  FifoWatcher<PixelToken>* pixels = nullptr;
  FifoWatcher<LineRequest>* written = nullptr;
  // These watch the channels of a pipe to dealer and memory.
  FifoWatcher<TileJob>* jobs = nullptr;
  FifoWatcher<LineRequest>* requests = nullptr;
  FifoWatcher<LineReply>* replies = nullptr;
  // These watch channels that only clear matter has.
  FifoWatcher<PassedToken>* passed = nullptr;
  FifoWatcher<OnwardToken>* onward = nullptr;
  LeapWatcher* leaps = nullptr;  // sees the leaps of rays, of which no token tells
};

class Pipe {
 public:
  Pipe() = default;
  virtual ~Pipe() = default;
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  virtual void connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies) = 0;
  virtual void watch(const Watchers& watchers) = 0;
  // Runs one cycle, and returns how many stages moved.
  virtual int cycle() = 0;
  virtual void end_pass() = 0;

  virtual const std::vector<Stage*>& stages() const = 0;
  virtual const Stage& running() const = 0;
  virtual const WalkCounts& walked() const = 0;
  struct CacheReport {
    std::string name;
    CacheCounts counts;
    int line_bytes;
  };
  virtual std::vector<CacheReport> caches() const = 0;
  // The host calls these between two pictures. The memory has other lines of volume i, in the order of
  // `caches`, or all is new.
  virtual void forget(std::size_t i, const std::vector<std::int64_t>& lines) = 0;
  virtual void forget_all() = 0;
  struct ChannelState {
    std::string name;
    int number, count, depth;
    bool ready;  // takes a token now
    std::int64_t entered;
  };
  virtual std::vector<ChannelState> channels() const = 0;
  // Returns the channels in the same order, with numbers of their own.
  virtual std::vector<TokenChannel> token_channels() const = 0;
  virtual void probe(ChannelProbe* probe) = 0;
};

// Makes pipe number `number`.
using PipeMaker = std::function<std::unique_ptr<Pipe>(const Registers&, const FrameRegisters&, const Memory&,
                                                      const Configuration&, int number)>;
// Makes a pipe without faults.
std::unique_ptr<Pipe> make_pipe(const Registers& registers, const FrameRegisters& frame, const Memory& memory,
                                const Configuration& c, int number);

}  // namespace voxmelt::hwmodel::raycast
