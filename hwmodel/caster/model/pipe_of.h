// A pipe of the ray caster: its stages, with the faults of a policy, and the channels between them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/crossing_stage.h"
#include "hwmodel/caster/model/ground_stage.h"
#include "hwmodel/caster/model/light_stage.h"
#include "hwmodel/caster/model/memory_port.h"
#include "hwmodel/caster/model/met_stage.h"
#include "hwmodel/caster/model/normal_stage.h"
#include "hwmodel/caster/model/paint_stage.h"
#include "hwmodel/caster/model/passed_stage.h"
#include "hwmodel/caster/model/pipe.h"
#include "hwmodel/caster/model/sample_stage.h"
#include "hwmodel/caster/model/setup_stage.h"
#include "hwmodel/caster/model/shade_stage.h"
#include "hwmodel/caster/model/stretch_stage.h"
#include "hwmodel/caster/model/tile_stages.h"
#include "hwmodel/caster/model/walk_stage.h"

namespace voxmelt::hwmodel::raycast {

// Of two kinds of scenes, which have the other stages in common.
template <class Faults>
struct OpaqueStages {
  OpaqueStages(const Registers& registers, Faults faults)
      : met(registers, faults), press(registers, faults) {}
  MetStage<Faults> met;
  PressStage<Faults> press;
};
template <class Faults>
struct ClearStages {
  ClearStages(const Registers& registers, WalkStage<Faults>& walk, int rays, Faults faults)
      : passed(registers, walk, rays, faults),
        stretch(registers, passed, rays, faults),
        press(registers, faults) {}
  PassedStage<Faults> passed;
  StretchStage<Faults> stretch;
  ClearPressStage<Faults> press;
};

template <class Faults>
class PipeOf final : public Pipe {
 public:
  static constexpr int kWaiting = 16;   // surfaces in a stage that fetches
  static constexpr int kSearches = 32;  // rays in the search for the ground

  PipeOf(const Registers& registers, const FrameRegisters& frame, const Memory& memory,
         const Configuration& c, int number, Faults faults = {});

  void connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies) override;
  void watch(const Watchers& watchers) override { watch_(watchers); }
  int cycle() override;
  void end_pass() override;

  const std::vector<Stage*>& stages() const override { return stages_; }
  const Stage& running() const override { return *running_; }
  const WalkCounts& walked() const override { return walk_.counts(); }
  std::vector<CacheReport> caches() const override;
  void forget(std::size_t i, const std::vector<std::int64_t>& lines) override;
  void forget_all() override;
  std::vector<ChannelState> channels() const override;

 private:
  // Of the memory port.
  enum Client : int { kLevels, kMatter, kLight, kColumns, kTexels, kTiles };

  template <class Word>
  Fifo<Word>& channel(Channel which, const char* name, int depth = 0);
  void list_stages();

  const Configuration& configuration_;
  const Memory& memory_;
  [[no_unique_address]] Faults faults_;
  int number_;
  TileBuffers buffers_;
  TileStage<Faults> tiles_;
  SetupStage<Faults> set_up_;
  GroundStage<Faults> ground_;
  WalkStage<Faults> walk_;
  CrossingStage<Faults> crossing_;
  AskStage<LevelRequest> ask_;
  Gather<LevelRequest, std::int16_t, 27, Faults> levels_;
  SampleStage<Faults> sample_;
  NormalStage<Faults> normal_;
  PaintStage<Faults> paint_;
  ColumnGather columns_;
  TextureStage<Faults> texture_;
  TexelGather texels_;
  MatterStage<Faults> matter_;
  MatterGather matter_words_;
  LightStage<Faults> light_;
  LightGather light_cells_;
  ArrivingStage<Faults> arriving_;
  MirrorStage<Faults> mirror_;
  ColourStage<Faults> colour_;
  PixelStage<Faults> pixel_;
  WriteStage<Faults> write_;
  MemoryPort port_;
  std::optional<OpaqueStages<Faults>> opaque_;
  std::optional<ClearStages<Faults>> clear_;
  std::vector<Stage*> stages_;
  const Stage* running_ = nullptr;
  std::vector<std::shared_ptr<void>> owned_;
  std::vector<std::function<ChannelState()>> states_;
  std::function<void(const Watchers&)> watch_;
  std::vector<void (*)(void*)> commits_;
  std::vector<void*> committed_;
};

template <class Faults>
PipeOf<Faults>::PipeOf(const Registers& registers, const FrameRegisters& frame, const Memory& memory,
                       const Configuration& c, int number, Faults faults)
    : configuration_(c),
      memory_(memory),
      faults_(faults),
      number_(number),
      buffers_(c.tiles_in_turn(registers.look.clear)),
      tiles_(registers, frame, buffers_, kTiles, faults),
      set_up_(registers, c.tiles_in_turn(registers.look.clear), faults),
      ground_(registers, kSearches, c.searchers, faults),
      walk_(registers, c.rays, c.walkers, faults),
      crossing_(walk_, c.rays, faults),
      ask_("ask"),
      levels_("levels", c.levels, memory.levels, kLevels, static_cast<std::int16_t>(kAir), 5, faults),
      sample_(faults),
      normal_(kWaiting, faults),
      paint_(registers, faults),
      columns_("heights", c.ground, memory.heights, kColumns, Column{}, 1),
      texture_(registers, kWaiting, faults),
      texels_("texels", c.ground, memory.texels, kTexels, Texel{}, 1),
      matter_(registers, kWaiting, faults),
      matter_words_("matter words", c.matter, memory.matter, kMatter, 0, 5),
      light_(registers, kWaiting, faults),
      light_cells_("light cells", c.light, memory.light, kLight, LightWord{}, 5),
      arriving_(registers, faults),
      mirror_(registers, faults),
      colour_(registers, faults),
      pixel_(registers, buffers_, faults),
      write_(frame, buffers_, faults),
      port_(memory) {
  if (registers.look.clear)
    clear_.emplace(registers, walk_, c.rays, faults);
  else
    opaque_.emplace(registers, faults);
  list_stages();
}

template <class Faults>
void PipeOf<Faults>::list_stages() {
  const auto add = [&](std::initializer_list<Stage*> more) {
    stages_.insert(stages_.end(), more.begin(), more.end());
  };
  // From the end to the begin, so that it matters to no one but the reader of a waveform.
  add({&port_, &write_, &pixel_});
  if (clear_)
    add({&clear_->press, &clear_->passed});
  else
    add({&opaque_->press});
  add({&colour_, &mirror_, &arriving_, &light_, &light_cells_.data, &light_cells_.tags, &matter_,
       &matter_words_.data, &matter_words_.tags, &texture_, &texels_.data, &texels_.tags, &paint_, &normal_});
  if (clear_)
    add({&clear_->stretch});
  else
    add({&opaque_->met});
  add({&crossing_, &sample_, &levels_.data, &levels_.tags, &ask_, &walk_, &ground_, &columns_.data,
       &columns_.tags, &set_up_, &tiles_});
}

template <class Faults>
template <class Word>
Fifo<Word>& PipeOf<Faults>::channel(Channel which, const char* name, int depth) {
  const int number = 100 * number_ + static_cast<int>(which);
  auto fifo = std::make_shared<Fifo<Word>>(name, number, 1, std::max(depth, configuration_.fifo_depth),
                                           configuration_.stall_seed);
  Fifo<Word>& made = *fifo;
  faults_.made(made);
  commits_.push_back([](void* f) { static_cast<Fifo<Word>*>(f)->commit(); });
  committed_.push_back(&made);
  states_.push_back([&made] {
    return ChannelState{made.name(),  made.channel(), made.count(),
                        made.depth(), made.ready(),   made.entered()};
  });
  owned_.push_back(std::move(fifo));
  return made;
}

template <class Faults>
void PipeOf<Faults>::connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies) {
  faults_.connected(number_, tiles, replies, kColumns, kTexels);
  const int rays = configuration_.rays;  // of queues in which every ray has a place
  auto& orders = channel<TileOrder>(Channel::tiles, "tiles -> set-up");
  auto& set_up = channel<RayToken>(Channel::set_up, "set-up -> ground");
  auto& ground = channel<GroundedRay>(Channel::ground, "ground -> walk");
  auto& walk_asks = channel<LevelRequest>(Channel::walk_asks, "walk -> ask");
  auto& crossing_asks = channel<LevelRequest>(Channel::crossing_asks, "crossing -> ask");
  auto& normal_asks = channel<LevelRequest>(Channel::normal_asks, "normal -> ask");
  auto& level_asks = channel<LevelRequest>(Channel::level_asks, "ask -> levels");
  auto& levels = channel<Levels>(Channel::levels, "levels -> sample");
  auto& normal_levels = channel<Levels>(Channel::normal_levels, "levels -> normal");
  auto& walk_levels = channel<LevelToken>(Channel::walk_levels, "sample -> walk");
  auto& crossing_levels = channel<LevelToken>(Channel::crossing_levels, "sample -> crossing");
  auto& hits = channel<HitToken>(Channel::hits, "walk -> crossing", rays);
  auto& missed = channel<MetToken>(Channel::missed, clear_ ? "walk -> stretch" : "walk -> met");
  auto& crossed = channel<MetToken>(Channel::crossed, clear_ ? "crossing -> stretch" : "crossing -> met");
  auto& met = channel<Surface>(Channel::met, clear_ ? "stretch -> normal" : "met -> normal");
  auto& normal = channel<Surface>(Channel::normal, "normal -> paint");
  auto& height_asks = channel<ClampedRequest>(Channel::height_asks, "ground -> heights");
  auto& heights = channel<ColumnGather::Out>(Channel::heights, "heights -> ground");
  auto& paint = channel<Surface>(Channel::paint, "paint -> texture");
  auto& texel_asks = channel<ClampedRequest>(Channel::texel_asks, "texture -> texels");
  auto& texels = channel<TexelGather::Out>(Channel::texels, "texels -> texture");
  auto& texture = channel<Surface>(Channel::texture, "texture -> matter");
  auto& matter_asks = channel<MatterRequest>(Channel::matter_asks, "matter -> matter words");
  auto& matter_words = channel<MatterGather::Out>(Channel::matter_words, "matter words -> matter");
  auto& matter = channel<Surface>(Channel::matter, "matter -> light");
  auto& light_asks = channel<ClampedRequest>(Channel::light_asks, "light -> light cells");
  auto& light_cells = channel<LightGather::Out>(Channel::light_cells, "light cells -> light");
  auto& light = channel<Surface>(Channel::light, "light -> arriving");
  auto& arriving = channel<Surface>(Channel::arriving, "arriving -> mirror");
  auto& mirror = channel<Surface>(Channel::mirror, "mirror -> colour");
  auto& colour = channel<Surface>(Channel::colour, clear_ ? "colour -> passed" : "colour -> press");
  auto& pressed = channel<PressedToken>(Channel::pressed, "press -> pixel");
  auto& pixels = channel<PixelToken>(Channel::pixels, "pixel -> write");
  const auto line = [&](const char* name) -> Fifo<LineRequest>& {
    return channel<LineRequest>(Channel::to_memory, name);
  };
  auto& level_lines = line("levels -> memory port");
  auto& matter_lines = line("matter words -> memory port");
  auto& light_lines = line("light cells -> memory port");
  auto& column_lines = line("heights -> memory port");
  auto& texel_lines = line("texels -> memory port");
  auto& tile_lines = line("tiles -> memory port");
  auto& written = line("write -> memory port");

  tiles_.connect(tiles, tile_lines, orders);
  set_up_.connect(orders, set_up);
  ground_.connect(set_up, height_asks, heights, ground);
  columns_.connect(height_asks, column_lines);
  columns_.connect_out({&heights});
  walk_.connect(ground, walk_asks, walk_levels, hits, missed);
  crossing_.connect(hits, crossing_asks, crossing_levels, crossed);
  levels_.connect(level_asks, level_lines);
  levels_.connect_out({&levels, &normal_levels});
  sample_.connect(levels, walk_levels, crossing_levels);
  std::vector<Fifo<LevelRequest>*> askers{&normal_asks, &crossing_asks, &walk_asks};
  Fifo<LevelToken>* stretch_levels = nullptr;
  Fifo<HitToken>* exits = nullptr;
  Fifo<PassedToken>* passed = nullptr;
  Fifo<OnwardToken>* onward = nullptr;
  if (clear_) {
    auto& stretch_asks = channel<LevelRequest>(Channel::stretch_asks, "stretch -> ask");
    stretch_levels = &channel<LevelToken>(Channel::stretch_levels, "sample -> stretch");
    exits = &channel<HitToken>(Channel::exits, "stretch -> crossing", rays);
    onward = &channel<OnwardToken>(Channel::onward, "stretch -> walk", rays);
    passed = &channel<PassedToken>(Channel::passed, "passed -> press");
    askers.insert(askers.end() - 1, &stretch_asks);
    sample_.connect_stretch(*stretch_levels);
    crossing_.connect_exits(*exits);
    walk_.connect_onward(*onward);
    clear_->stretch.connect(missed, crossed, stretch_asks, *stretch_levels, *exits, *onward, met);
    clear_->passed.connect(colour, *passed);
    clear_->press.connect(*passed, pressed);
  } else {
    opaque_->met.connect(missed, crossed, met);
    opaque_->press.connect(colour, pressed);
  }
  ask_.connect(std::move(askers), level_asks);
  normal_.connect(met, normal_asks, normal_levels, normal);
  paint_.connect(normal, paint);
  texture_.connect(paint, texel_asks, texels, texture);
  texels_.connect(texel_asks, texel_lines);
  texels_.connect_out({&texels});
  matter_.connect(texture, matter_asks, matter_words, matter);
  matter_words_.connect(matter_asks, matter_lines);
  matter_words_.connect_out({&matter_words});
  light_.connect(matter, light_asks, light_cells, light);
  light_cells_.connect(light_asks, light_lines);
  light_cells_.connect_out({&light_cells});
  arriving_.connect(light, arriving);
  mirror_.connect(arriving, mirror);
  colour_.connect(mirror, colour);
  pixel_.connect(pressed, pixels);
  write_.connect(pixels, written);
  port_.connect(
      {&level_lines, &matter_lines, &light_lines, &column_lines, &texel_lines, &tile_lines, &written},
      to_memory, replies, {&levels_, &matter_words_, &light_cells_, &columns_, &texels_, &tiles_});

  watch_ = [orders = &orders, written = &written, set_up = &set_up, ground = &ground, asks = &level_asks,
            levels = &levels, normal_levels = &normal_levels, walk_levels = &walk_levels,
            crossing_levels = &crossing_levels, hits = &hits, missed = &missed, crossed = &crossed,
            surfaces =
                std::vector{&met, &normal, &paint, &texture, &matter, &light, &arriving, &mirror, &colour},
            pressed = &pressed, pixels = &pixels, stretch_levels, exits, passed, onward](const Watchers& w) {
    orders->watch(w.tiles), written->watch(w.written), set_up->watch(w.set_up), ground->watch(w.ground),
        asks->watch(w.asks);
    levels->watch(w.levels), normal_levels->watch(w.levels);
    walk_levels->watch(w.samples), crossing_levels->watch(w.samples);
    hits->watch(w.hits), missed->watch(w.met), crossed->watch(w.met);
    for (Fifo<Surface>* fifo : surfaces) fifo->watch(w.surfaces);
    pressed->watch(w.pressed), pixels->watch(w.pixels);
    if (passed == nullptr) return;
    stretch_levels->watch(w.samples), exits->watch(w.hits), passed->watch(w.passed);
    onward->watch(w.onward);
  };
}

template <class Faults>
int PipeOf<Faults>::cycle() {
  int moved = 0;
  for (Stage* stage : stages_) {
    running_ = stage;
    moved += stage->run() ? 1 : 0;
  }
  for (std::size_t i = 0; i < commits_.size(); ++i) commits_[i](committed_[i]);
  return moved;
}

template <class Faults>
void PipeOf<Faults>::end_pass() {
  for (Stage* stage : stages_) stage->end_pass();
}

template <class Faults>
std::vector<Pipe::CacheReport> PipeOf<Faults>::caches() const {
  return {{"levels", levels_.counts(), memory_.levels.line_bytes},
          {"matter", matter_words_.counts(), memory_.matter.line_bytes},
          {"light", light_cells_.counts(), memory_.light.line_bytes},
          {"heights", columns_.counts(), memory_.heights.line_bytes},
          {"texels", texels_.counts(), memory_.texels.line_bytes}};
}

template <class Faults>
void PipeOf<Faults>::forget(std::size_t i, const std::vector<std::int64_t>& lines) {
  for (const std::int64_t line : lines) {
    if (i == 0) levels_.forget(line);
    if (i == 1) matter_words_.forget(line);
    if (i == 2) light_cells_.forget(line);
    if (i == 3) columns_.forget(line);
    if (i == 4) texels_.forget(line);
  }
}

template <class Faults>
void PipeOf<Faults>::forget_all() {
  levels_.forget_all(), matter_words_.forget_all(), light_cells_.forget_all();
  columns_.forget_all(), texels_.forget_all();
}

template <class Faults>
std::vector<Pipe::ChannelState> PipeOf<Faults>::channels() const {
  std::vector<ChannelState> of;
  of.reserve(states_.size());
  for (const auto& state : states_) of.push_back(state());
  return of;
}

}  // namespace voxmelt::hwmodel::raycast
