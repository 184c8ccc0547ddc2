// A pipe of the ray caster consists of its stages, with the faults of a policy, and the channels between
// them.
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

#include "hwmodel/caster/model/channel_wires.h"
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

// Opaque and clear scenes have these stages of their own. They have the other stages in common.
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

// Lists the channels of a pipe by what enters them. The last five are there for clear matter alone.
struct PipeChannels {
  Fifo<TileOrder>* orders;
  Fifo<RayToken>* set_up;
  Fifo<GroundedRay>* ground;
  Fifo<LevelRequest>*walk_asks, *crossing_asks, *normal_asks, *level_asks;
  Fifo<Levels>*levels, *normal_levels;
  Fifo<LevelToken>*walk_levels, *crossing_levels;
  Fifo<HitToken>* hits;
  Fifo<MetToken>*missed, *crossed;
  Fifo<Surface>*met, *normal, *paint, *texture, *matter, *light, *arriving, *mirror, *colour;
  Fifo<ClampedRequest>*height_asks, *texel_asks, *light_asks;
  Fifo<ColumnGather::Out>* heights;
  Fifo<TexelGather::Out>* texels;
  Fifo<MatterRequest>* matter_asks;
  Fifo<MatterGather::Out>* matter_words;
  Fifo<LightGather::Out>* light_cells;
  Fifo<PressedToken>* pressed;
  Fifo<PixelToken>* pixels;
  Fifo<LineRequest>*level_lines, *matter_lines, *light_lines, *column_lines, *texel_lines, *tile_lines,
      *written;
  Fifo<LevelRequest>* stretch_asks = nullptr;
  Fifo<LevelToken>* stretch_levels = nullptr;
  Fifo<HitToken>* exits = nullptr;
  Fifo<OnwardToken>* onward = nullptr;
  Fifo<PassedToken>* passed = nullptr;
};

template <class Faults>
class PipeOf final : public Pipe {
 public:
  static constexpr int kWaiting = 16;   // surfaces in a stage that fetches
  static constexpr int kSearches = 32;  // rays in the search for the ground

  PipeOf(const Registers& registers, const FrameRegisters& frame, const Memory& memory,
         const Configuration& c, int number, Faults faults = {});

  void connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies) override;
  void watch(const Watchers& watchers) override {
    watch_(watchers);
    ground_.watch(watchers.leaps);
    walk_.watch(watchers.leaps);
  }
  int cycle() override;
  void end_pass() override;

  const std::vector<Stage*>& stages() const override { return stages_; }
  const Stage& running() const override { return *running_; }
  const WalkCounts& walked() const override { return walk_.counts(); }
  std::vector<CacheReport> caches() const override;
  void forget(std::size_t i, const std::vector<std::int64_t>& lines) override;
  void forget_all() override;
  std::vector<ChannelState> channels() const override;
  std::vector<TokenChannel> token_channels() const override;
  void probe(ChannelProbe* probe) override;

 private:
  // Numbers the clients of the memory port.
  enum Client : int { kLevels, kMatter, kLight, kColumns, kTexels, kTiles };

  template <class Word>
  Fifo<Word>& channel(Channel which, const char* name, int depth = 0);
  template <class Word>
  void show(Channel which, Fifo<Word>& fifo);
  void list_stages();
  PipeChannels make_channels();
  void connect_rays(const PipeChannels& c, Fifo<TileJob>& tiles);
  void connect_levels(const PipeChannels& c);
  void connect_surfaces(const PipeChannels& c);
  static void watch_channels(const PipeChannels& c, const Watchers& w);

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
  std::vector<std::function<TokenChannel()>> types_;
  std::vector<std::function<void(ChannelProbe*)>> probes_;
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
      levels_("levels", c.levels, memory.levels, kLevels, kAir, 5, faults),
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
  // The order is from the end to the beginning, and matters to no one but the reader of a waveform.
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
  show(which, made);
  owned_.push_back(std::move(fifo));
  return made;
}

template <class Faults>
template <class Word>
void PipeOf<Faults>::show(Channel which, Fifo<Word>& fifo) {
  const int number = 100 * number_ + static_cast<int>(types_.size());
  const ContextBits bits{bits_for(configuration_.rays - 1), bits_for(configuration_.tiles - 1),
                         clear_.has_value()};
  types_.push_back([which, number, bits, &fifo] {
    return TokenChannel{fifo.name(), number, fifo.depth(), type_of<Word>(which, bits)};
  });
  probes_.push_back([&fifo, numbered = std::make_shared<NumberedProbe>(number)](ChannelProbe* probe) {
    numbered->tell(probe);
    fifo.probe(probe == nullptr ? nullptr : numbered.get());
  });
}

template <class Faults>
PipeChannels PipeOf<Faults>::make_channels() {
  const int rays = configuration_.rays;  // depth of queues in which every ray has a place
  PipeChannels c{};
  c.orders = &channel<TileOrder>(Channel::tiles, "tiles -> set-up");
  c.set_up = &channel<RayToken>(Channel::set_up, "set-up -> ground");
  c.ground = &channel<GroundedRay>(Channel::ground, "ground -> walk");
  c.walk_asks = &channel<LevelRequest>(Channel::walk_asks, "walk -> ask");
  c.crossing_asks = &channel<LevelRequest>(Channel::crossing_asks, "crossing -> ask");
  c.normal_asks = &channel<LevelRequest>(Channel::normal_asks, "normal -> ask");
  c.level_asks = &channel<LevelRequest>(Channel::level_asks, "ask -> levels");
  c.levels = &channel<Levels>(Channel::levels, "levels -> sample");
  c.normal_levels = &channel<Levels>(Channel::normal_levels, "levels -> normal");
  c.walk_levels = &channel<LevelToken>(Channel::walk_levels, "sample -> walk");
  c.crossing_levels = &channel<LevelToken>(Channel::crossing_levels, "sample -> crossing");
  c.hits = &channel<HitToken>(Channel::hits, "walk -> crossing", rays);
  c.missed = &channel<MetToken>(Channel::missed, clear_ ? "walk -> stretch" : "walk -> met");
  c.crossed = &channel<MetToken>(Channel::crossed, clear_ ? "crossing -> stretch" : "crossing -> met");
  c.met = &channel<Surface>(Channel::met, clear_ ? "stretch -> normal" : "met -> normal");
  c.normal = &channel<Surface>(Channel::normal, "normal -> paint");
  c.height_asks = &channel<ClampedRequest>(Channel::height_asks, "ground -> heights");
  c.heights = &channel<ColumnGather::Out>(Channel::heights, "heights -> ground");
  c.paint = &channel<Surface>(Channel::paint, "paint -> texture");
  c.texel_asks = &channel<ClampedRequest>(Channel::texel_asks, "texture -> texels");
  c.texels = &channel<TexelGather::Out>(Channel::texels, "texels -> texture");
  c.texture = &channel<Surface>(Channel::texture, "texture -> matter");
  c.matter_asks = &channel<MatterRequest>(Channel::matter_asks, "matter -> matter words");
  c.matter_words = &channel<MatterGather::Out>(Channel::matter_words, "matter words -> matter");
  c.matter = &channel<Surface>(Channel::matter, "matter -> light");
  c.light_asks = &channel<ClampedRequest>(Channel::light_asks, "light -> light cells");
  c.light_cells = &channel<LightGather::Out>(Channel::light_cells, "light cells -> light");
  c.light = &channel<Surface>(Channel::light, "light -> arriving");
  c.arriving = &channel<Surface>(Channel::arriving, "arriving -> mirror");
  c.mirror = &channel<Surface>(Channel::mirror, "mirror -> colour");
  c.colour = &channel<Surface>(Channel::colour, clear_ ? "colour -> passed" : "colour -> press");
  c.pressed = &channel<PressedToken>(Channel::pressed, "press -> pixel");
  c.pixels = &channel<PixelToken>(Channel::pixels, "pixel -> write");
  const auto line = [&](const char* name) { return &channel<LineRequest>(Channel::to_memory, name); };
  c.level_lines = line("levels -> memory port");
  c.matter_lines = line("matter words -> memory port");
  c.light_lines = line("light cells -> memory port");
  c.column_lines = line("heights -> memory port");
  c.texel_lines = line("texels -> memory port");
  c.tile_lines = line("tiles -> memory port");
  c.written = line("write -> memory port");
  if (!clear_) return c;
  c.stretch_asks = &channel<LevelRequest>(Channel::stretch_asks, "stretch -> ask");
  c.stretch_levels = &channel<LevelToken>(Channel::stretch_levels, "sample -> stretch");
  c.exits = &channel<HitToken>(Channel::exits, "stretch -> crossing", rays);
  c.onward = &channel<OnwardToken>(Channel::onward, "stretch -> walk", rays);
  c.passed = &channel<PassedToken>(Channel::passed, "passed -> press");
  return c;
}

template <class Faults>
void PipeOf<Faults>::connect(Fifo<TileJob>& tiles, Fifo<LineRequest>& to_memory, Fifo<LineReply>& replies) {
  faults_.connected(number_, tiles, replies, kColumns, kTexels);
  const PipeChannels c = make_channels();
  connect_rays(c, tiles);
  connect_levels(c);
  connect_surfaces(c);
  port_.connect(
      {c.level_lines, c.matter_lines, c.light_lines, c.column_lines, c.texel_lines, c.tile_lines, c.written},
      to_memory, replies, {&levels_, &matter_words_, &light_cells_, &columns_, &texels_, &tiles_});
  watch_ = [c](const Watchers& watchers) { watch_channels(c, watchers); };
}

template <class Faults>
void PipeOf<Faults>::connect_rays(const PipeChannels& c, Fifo<TileJob>& tiles) {
  tiles_.connect(tiles, *c.tile_lines, *c.orders);
  set_up_.connect(*c.orders, *c.set_up);
  ground_.connect(*c.set_up, *c.height_asks, *c.heights, *c.ground);
  columns_.connect(*c.height_asks, *c.column_lines);
  columns_.connect_out({c.heights});
  walk_.connect(*c.ground, *c.walk_asks, *c.walk_levels, *c.hits, *c.missed);
  crossing_.connect(*c.hits, *c.crossing_asks, *c.crossing_levels, *c.crossed);
  if (clear_) {
    crossing_.connect_exits(*c.exits);
    walk_.connect_onward(*c.onward);
    clear_->stretch.connect(*c.missed, *c.crossed, *c.stretch_asks, *c.stretch_levels, *c.exits, *c.onward,
                            *c.met);
  } else {
    opaque_->met.connect(*c.missed, *c.crossed, *c.met);
  }
}

// Connects the levels of cells, which three or four stages ask for.
template <class Faults>
void PipeOf<Faults>::connect_levels(const PipeChannels& c) {
  if (clear_)
    ask_.connect({c.normal_asks, c.crossing_asks, c.stretch_asks, c.walk_asks}, *c.level_asks);
  else
    ask_.connect({c.normal_asks, c.crossing_asks, c.walk_asks}, *c.level_asks);
  levels_.connect(*c.level_asks, *c.level_lines);
  levels_.connect_out({c.levels, c.normal_levels});
  sample_.connect(*c.levels, *c.walk_levels, *c.crossing_levels);
  if (clear_) sample_.connect_stretch(*c.stretch_levels);
}

template <class Faults>
void PipeOf<Faults>::connect_surfaces(const PipeChannels& c) {
  normal_.connect(*c.met, *c.normal_asks, *c.normal_levels, *c.normal);
  paint_.connect(*c.normal, *c.paint);
  texture_.connect(*c.paint, *c.texel_asks, *c.texels, *c.texture);
  texels_.connect(*c.texel_asks, *c.texel_lines);
  texels_.connect_out({c.texels});
  matter_.connect(*c.texture, *c.matter_asks, *c.matter_words, *c.matter);
  matter_words_.connect(*c.matter_asks, *c.matter_lines);
  matter_words_.connect_out({c.matter_words});
  light_.connect(*c.matter, *c.light_asks, *c.light_cells, *c.light);
  light_cells_.connect(*c.light_asks, *c.light_lines);
  light_cells_.connect_out({c.light_cells});
  arriving_.connect(*c.light, *c.arriving);
  mirror_.connect(*c.arriving, *c.mirror);
  colour_.connect(*c.mirror, *c.colour);
  if (clear_) {
    clear_->passed.connect(*c.colour, *c.passed);
    clear_->press.connect(*c.passed, *c.pressed);
  } else {
    opaque_->press.connect(*c.colour, *c.pressed);
  }
  pixel_.connect(*c.pressed, *c.pixels);
  write_.connect(*c.pixels, *c.written);
}

template <class Faults>
void PipeOf<Faults>::watch_channels(const PipeChannels& c, const Watchers& w) {
  c.orders->watch(w.tiles);
  c.written->watch(w.written);
  c.set_up->watch(w.set_up);
  c.ground->watch(w.ground);
  c.level_asks->watch(w.asks);
  for (auto* levels : {c.levels, c.normal_levels}) levels->watch(w.levels);
  for (auto* samples : {c.walk_levels, c.crossing_levels}) samples->watch(w.samples);
  c.hits->watch(w.hits);
  for (auto* met : {c.missed, c.crossed}) met->watch(w.met);
  for (auto* surfaces :
       {c.met, c.normal, c.paint, c.texture, c.matter, c.light, c.arriving, c.mirror, c.colour})
    surfaces->watch(w.surfaces);
  c.pressed->watch(w.pressed);
  c.pixels->watch(w.pixels);
  if (c.passed == nullptr) return;
  c.stretch_levels->watch(w.samples);
  c.exits->watch(w.hits);
  c.passed->watch(w.passed);
  c.onward->watch(w.onward);
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
  levels_.forget_all();
  matter_words_.forget_all();
  light_cells_.forget_all();
  columns_.forget_all();
  texels_.forget_all();
}

template <class Faults>
std::vector<Pipe::ChannelState> PipeOf<Faults>::channels() const {
  std::vector<ChannelState> all;
  all.reserve(states_.size());
  for (const auto& state : states_) all.push_back(state());
  return all;
}

template <class Faults>
std::vector<TokenChannel> PipeOf<Faults>::token_channels() const {
  std::vector<TokenChannel> all;
  all.reserve(types_.size());
  for (const auto& type : types_) all.push_back(type());
  return all;
}

template <class Faults>
void PipeOf<Faults>::probe(ChannelProbe* probe) {
  for (const auto& each : probes_) each(probe);
}

}  // namespace voxmelt::hwmodel::raycast
