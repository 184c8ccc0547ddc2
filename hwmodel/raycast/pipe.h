// A pipe of the ray caster: its stages and the channels between them. One SystemC process evaluates all of
// it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hwmodel/raycast/configuration.h"
#include "hwmodel/raycast/crossing_stage.h"
#include "hwmodel/raycast/ground_stage.h"
#include "hwmodel/raycast/light_stage.h"
#include "hwmodel/raycast/memory_port.h"
#include "hwmodel/raycast/met_stage.h"
#include "hwmodel/raycast/normal_stage.h"
#include "hwmodel/raycast/paint_stage.h"
#include "hwmodel/raycast/sample_stage.h"
#include "hwmodel/raycast/setup_stage.h"
#include "hwmodel/raycast/shade_stage.h"
#include "hwmodel/raycast/tile_stages.h"
#include "hwmodel/raycast/walk_stage.h"

namespace voxmelt::hwmodel::raycast {

// The channels of a pipe, by what fills them.
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
  search_asks,
  paint_asks,
  height_asks,
  search_heights,
  paint_heights,
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
  to_memory
};

// Who listens to what leaves a stage. Null: nobody.
struct Watchers {
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
};

class Pipe {
 public:
  Pipe(const Registers& registers, const FrameRegisters& frame, const Memory& memory, const Configuration& c,
       int number);
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  void connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies);
  void watch(const Watchers& watchers);
  // One cycle: how many stages moved.
  int cycle();
  void end_pass();

  const std::vector<Stage*>& stages() const { return stages_; }
  const Stage& running() const { return *running_; }
  const WalkCounts& walked() const { return walk_.counts(); }
  struct CacheReport {
    std::string name;
    CacheCounts counts;
    int line_bytes;
  };
  std::vector<CacheReport> caches() const;
  // Between two pictures: the memory has other lines of volume i, in the order of `caches`; or all is new.
  void forget(std::size_t i, const std::vector<std::int64_t>& lines);
  void forget_all();
  struct ChannelState {
    std::string name;
    int count, depth;
    std::int64_t entered;
  };
  std::vector<ChannelState> channels() const;

 private:
  template <class Word>
  Fifo<Word>& channel(Channel which, const char* name, int depth = 0);

  const Configuration& configuration_;
  const Memory& memory_;
  int number_;
  TileBuffers buffers_;
  TileStage tiles_;
  SetupStage set_up_;
  GroundStage ground_;
  WalkStage walk_;
  CrossingStage crossing_;
  AskStage<LevelRequest> ask_;
  LevelGather levels_;
  SampleStage sample_;
  MetStage met_;
  NormalStage normal_;
  PaintStage paint_;
  AskStage<ClampedRequest> height_ask_;
  ColumnGather columns_;
  TextureStage texture_;
  TexelGather texels_;
  MatterStage matter_;
  MatterGather matter_words_;
  LightStage light_;
  LightGather light_cells_;
  ArrivingStage arriving_;
  MirrorStage mirror_;
  ColourStage colour_;
  PressStage press_;
  PixelStage pixel_;
  WriteStage write_;
  MemoryPort port_;
  std::vector<Stage*> stages_;
  const Stage* running_ = nullptr;
  std::vector<std::shared_ptr<void>> owned_;
  std::vector<std::function<ChannelState()>> states_;
  std::function<void(const Watchers&)> watch_;
  std::vector<void (*)(void*)> commits_;
  std::vector<void*> committed_;
};

}  // namespace voxmelt::hwmodel::raycast
