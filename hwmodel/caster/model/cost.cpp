#include "hwmodel/caster/model/cost.h"

#include <algorithm>
#include <bit>

#include "hwmodel/caster/model/pipe_of.h"
#include "hwmodel/caster/model/token_wires.h"

namespace voxmelt::hwmodel::raycast {
namespace {

constexpr int kSpots = 3 * (12 + 8);  // cell and weight along three axes
constexpr int kAddress = 32;
constexpr int kColumns = 16, kTexels = 4, kCorners = 8;  // numbers that one answer holds

template <class... Of>
int bits_of_token(const Of&... tokens) {
  int sum = 0;
  wires_of(tokens..., [&](const WireName&, int bits, bool, std::int64_t) { sum += bits; });
  return sum;
}

int log2_of(int power) { return std::countr_zero<unsigned>(power); }
int slots_of(const CacheShape& shape) { return shape.lines() + shape.spare; }
int slot_bits(const CacheShape& shape) { return bits_for(slots_of(shape) - 1); }

std::int64_t lines_of(const Layout& layout) {
  std::int64_t lines = 1;
  if (layout.sparse) {
    const std::int64_t stored = *std::max_element(layout.slots.begin(), layout.slots.end()) + 1;
    return layout.apron ? stored : stored << (3 * (kBrickBits - layout.bits[0]));
  }
  for (const int count : layout.count) lines *= std::max(count, 1);
  return lines;
}

class Costs {
 public:
  Costs(const Configuration& c, const Registers& registers, const Memory& memory)
      : c_(c),
        registers_(registers),
        memory_(memory),
        clear_(registers.look.clear),
        context_{bits_for(c.rays - 1), bits_for(c.tiles - 1), clear_} {}

  PipeCost all() {
    channels();
    caches();
    contexts();
    tables();
    units();
    return cost_;
  }

 private:
  void channel(const char* name, int bits, int depth = 0) {
    cost_.channels.push_back({name, bits, std::max(depth, c_.fifo_depth)});
  }
  void memory(const char* stage, const char* name, std::int64_t words, std::int64_t bits) {
    if (words > 0) cost_.memories.push_back({stage, name, words, bits});
  }
  int surface(Behind stage) const { return bits_of_token(Surface{}, stage, context_); }
  int clamped() const { return kSpots + 1 + bits_for(PipeOf<NoFaults>::kSearches - 1) + 1; }

  void channels() {
    LevelRequest of_normal;
    of_normal.asker = Asker::normal;
    const int ask = bits_of_token(LevelRequest{}, context_);
    channel("tiles -> set-up", bits_of_token(TileOrder{}, context_));
    channel("set-up -> ground", bits_of_token(RayToken{}, context_));
    channel("ground -> walk", bits_of_token(GroundedRay{}, context_));
    channel("walk -> ask", ask);
    channel("crossing -> ask", ask);
    channel("normal -> ask", ask);
    channel("ask -> levels", ask);
    channel("levels -> sample", bits_of_token(Levels{}, context_));
    channel("levels -> normal", bits_of_token(Levels{of_normal, {}}, context_));
    channel("sample -> walk", bits_of_token(LevelToken{}, context_));
    channel("sample -> crossing", bits_of_token(LevelToken{}, context_));
    channel("walk -> crossing", bits_of_token(HitToken{}, context_), c_.rays);
    channel(clear_ ? "walk -> stretch" : "walk -> met", bits_of_token(MetToken{}, context_));
    channel(clear_ ? "crossing -> stretch" : "crossing -> met", bits_of_token(MetToken{}, context_));
    channel(clear_ ? "stretch -> normal" : "met -> normal", surface(Behind::met));
    channel("normal -> paint", surface(Behind::normal));
    channel("ground -> heights", clamped());
    channel("heights -> ground", clamped() + kColumns * 2 * 24);  // drawn and bare
    channel("paint -> texture", surface(Behind::paint));
    channel("texture -> texels", kSpots);
    channel("texels -> texture", kSpots + kTexels * 8 * static_cast<int>(sizeof(Texel)));
    channel("texture -> matter", surface(Behind::texture));
    channel("matter -> matter words", kSpots);
    channel("matter words -> matter", kSpots + kCorners * 24);
    channel("matter -> light", surface(Behind::matter));
    channel("light -> light cells", kSpots);
    channel("light cells -> light", kSpots + kCorners * 13 * 8);
    channel("light -> arriving", surface(Behind::light));
    channel("arriving -> mirror", surface(Behind::arriving));
    channel("mirror -> colour", surface(Behind::mirror));
    channel(clear_ ? "colour -> passed" : "colour -> press", surface(Behind::colour));
    channel("press -> pixel", bits_of_token(PressedToken{}, context_));
    channel("pixel -> write", bits_of_token(PixelToken{}, context_));
    channel("levels -> memory port", slot_bits(c_.levels) + kAddress);
    channel("matter words -> memory port", slot_bits(c_.matter) + kAddress);
    channel("light cells -> memory port", slot_bits(c_.light) + kAddress);
    channel("heights -> memory port", slot_bits(c_.ground) + kAddress);
    channel("texels -> memory port", slot_bits(c_.ground) + kAddress);
    channel("tiles -> memory port", bits_for(4) + kAddress);
    channel("write -> memory port", kAddress + 8 * kBurst);
    if (!clear_) return;
    channel("stretch -> ask", ask);
    channel("sample -> stretch", bits_of_token(LevelToken{}, context_));
    int exit = 0;
    wires_of_exit(HitToken{}, context_, [&](const WireName&, int bits, bool, std::int64_t) { exit += bits; });
    channel("stretch -> crossing", exit, c_.rays);
    channel("stretch -> walk", bits_of_token(OnwardToken{}, context_), c_.rays);
    channel("passed -> press", bits_of_token(PassedToken{}, context_));
  }

  // A tag holds the part of a line's number that its set does not tell, its slot, and its place in the order
  // of use.
  void cache(const char* stage, const CacheShape& shape, const Layout& layout, int request) {
    if (layout.line_bytes == 0) return;
    const int slot = slot_bits(shape);
    const int tag = std::max(bits_for(lines_of(layout) - 1) - log2_of(shape.sets), 1);
    memory(stage, "lines", slots_of(shape), std::int64_t{8} * layout.line_bytes);
    memory(stage, "tags", shape.lines(), tag + 1 + slot + (shape.ways > 1 ? bits_for(shape.ways - 1) : 0));
    memory(stage, "arrived, free", slots_of(shape), 1 + slot);
    memory(stage, "queue", shape.queue, request + 2 * (layout.apron ? 1 : kCorners) * (slot + 1));
    if (layout.sparse)
      memory(stage, "table of bricks", layout.slots.size(),
             bits_for(*std::max_element(layout.slots.begin(), layout.slots.end())));
  }
  void caches() {
    cache("levels", c_.levels, memory_.levels, bits_of_token(LevelRequest{}, context_));
    cache("matter words", c_.matter, memory_.matter, kSpots);
    cache("light cells", c_.light, memory_.light, kSpots);
    cache("heights", c_.ground, memory_.heights, clamped());
    cache("texels", c_.ground, memory_.texels, kSpots);
  }

  // Counts the memories of rays and surfaces under way.
  void contexts() {
    const int ray = bits_of_token(GroundedRay{}, context_), position = 3 * 32;
    // After the ray come its position, three inverses, k, its end, the slope bound, and what is known of a
    // sample.
    memory("walk", "rays", c_.rays, ray + position + 3 * (12 + 6) + 27 + 27 + 8 + 27 + 16 + (clear_ ? 1 : 0));
    memory("walk", "queues", std::int64_t{4} * c_.rays, context_.rays);
    memory("crossing", "rays", c_.rays, bits_of_token(HitToken{}, context_) + 2 * position + 16 + 15 + 3 + 2);
    memory("crossing", "queues", std::int64_t{2} * c_.rays, context_.rays);
    if (clear_) clear_contexts();
    constexpr int kSearches = PipeOf<NoFaults>::kSearches, kWaiting = PipeOf<NoFaults>::kWaiting;
    if (registers_.ground.any) {
      memory("ground", "rays", kSearches, bits_of_token(RayToken{}, context_) + 3 * 36 + 3 * 18);
      memory("ground", "bounds, 4 x 4 cells", size(registers_.ground.blocks.fine), 3 * 17);
      memory("ground", "bounds, 16 x 16 cells", size(registers_.ground.blocks.coarse), 17);
    }
    const auto waiting = [&](const char* stage, Behind before) {
      memory(stage, "surfaces", kWaiting, surface(before) + 3 * 2);
    };
    waiting("normal", Behind::met);
    waiting("texture", Behind::paint);
    waiting("matter", Behind::texture);
    waiting("light", Behind::matter);
    memory("tiles", "tiles beside", 5, 8 * kTileBytes);
    memory("pixel", "sums of tiles", std::int64_t{c_.tiles} * kTilePixels, 3 * 18 + 6);
    memory("pixel", "bytes of tiles", c_.tiles, 8 * kTileBytes);
  }

  // There is a place for each ray of the walk.
  void clear_contexts() {
    const int ground = bits_of_token(GroundHit{}), position = 3 * 32;
    // After the ray come to_eye, the length of a step, k, its position and level, the level beyond, and if it
    // is the first matter. A stretch has its steps and its way. Then come three events, how many, and what
    // follows.
    const int event = 2 + 1 + position + 18;
    memory("stretch", "rays", c_.rays,
           bits_of_token(RayId{}, context_) + 3 * 20 + ground + 3 * 16 + 15 + 27 + position + 15 + 16 + 1 +
               bits_for(std::int64_t{1} << registers_.camera.spacing) + 18 + 3 * event + 2 * 2 + 2);
    memory("stretch", "queues", std::int64_t{4} * c_.rays, context_.rays);
    // This holds what surfaces and ways have left, what passes, is mirrored and scattered, and if nothing
    // passes.
    memory("passed", "rays", c_.rays, 13 + 27 + 3 * (16 + 31 + 29) + 1);
  }

  // Each table has as many copies as are read in a cycle.
  void tables() {
    const auto size = [](const auto& one) { return static_cast<std::int64_t>(one.size()); };
    memory("walk", "reciprocals", 3 * size(kReciprocals), 12);
    memory("walk", "rises", size(kRises), 20);
    memory("walk", "skip map", size(registers_.skip.words), 9);
    if (clear_) {
      memory("stretch", "inverse root", 2 * size(kInverseRoot), 16);  // two rays may begin
      memory("passed", "passing", 3 * size(kPassing), 16);
    } else {
      memory("met", "inverse root", size(kInverseRoot), 16);
    }
    for (const char* stage : {"normal", "paint", "texture", "mirror"})
      memory(stage, "inverse root", size(kInverseRoot), 16);
    std::int64_t bends = 0;
    for (const auto& bend : registers_.ground.bends) bends += size(bend);
    memory("paint", "bends", bends, 21);
    memory("paint", "bands", size(registers_.ground.bands), 13);
    if (registers_.look.glow) memory("arriving", "glow", 2 * 256, 3 * 13);
    if (registers_.look.tinted) memory("arriving", "solids by tone", 256, 3 * 3 * 13);
    memory("mirror", "highlights", 2 * size(registers_.look.highlight), 13);
    memory("mirror", "surroundings", size(registers_.look.surroundings), 32);
    memory("press", "tone", 3 * size(registers_.look.tone), 13);
    memory("pixel", "bytes", 3 * size(registers_.look.bytes), 8);
  }

  void units() {
    constexpr int kUnit = 7;  // `unit` of arithmetic.h: squares 3, slope of the root 1, components 3
    constexpr int kBlend = 2;
    const auto stage = [&](const char* name, int multipliers = 0, int dividers = 0) {
      cost_.units.push_back({name, multipliers, dividers});
    };
    stage("tiles");
    stage("set-up", 12);
    // The box takes six quotients. A look takes 9 for places of three parts, height 6, leap 2 + 1. Each of
    // eight halvings takes place 3 and height 6. The crossing takes 6.
    stage("ground",
          registers_.ground.any
              ? 9 + 6 + 3 + 8 * (3 + 3 * kBlend) + 6 + 4 * 3 * kBlend + kUnit + 3 * c_.searchers
              : 0,
          registers_.ground.any ? 6 : 0);
    for (const char* gather : {"levels", "matter words", "light cells", "heights", "texels"}) {
      stage((std::string(gather) + " tags").c_str());
      stage((std::string(gather) + " data").c_str());
    }
    stage("ask");
    // A step takes 3 to the box, 3 out of a block, and 3 to the new place. A decision takes rise 1, out of
    // the block 3, place 3.
    stage("walk", 9 * c_.walkers + 7);
    stage("sample", 7 * kBlend);
    stage("crossing", 3, 1);
    if (clear_) {
      // Two rays may begin, each by a direction and a length. A surface is up to two parts of a step, a
      // sample is one.
      stage("stretch", 2 * (kUnit + 3) + 2 + 1);
      // Losses take 3, gleam 3, surfaces' losses 2, frost 1, what passes before and after 6, scattered 3.
      stage("passed", 3 + 3 + 2 + 1 + 6 + 3);
    } else {
      stage("met", kUnit);
    }
    stage("normal", 90 + 6 + kUnit);  // the spline, its squares, the length
    stage("paint", 2 * kBlend + 3);
    stage("texture", 5 * 3 * kBlend + kUnit);
    stage("matter", 3 * 7 * kBlend);
    stage("light", 13 * 7 * kBlend);
    // Mixing takes 20, glow 9, facing 3, lit 1, sides 3 + 3 + 3, light 3 x (ambient 2, lamp 1). A way in
    // matter takes 3 x 3.
    stage("arriving", 20 + (registers_.look.glow ? 9 + 3 : 0) + 3 + 1 + 3 + 3 + 9 + (clear_ ? 9 : 0));
    // Half way takes 7, shine 3, tables 3, three smooth steps 6, peak 2, eye 3, graze 3, gloss 1. Reflected
    // takes 3, free 6 + 6 + 1, lamp and strip 6, around 6. From within, facing takes 3.
    stage("mirror", 56 + (clear_ ? 3 : 0), 3);
    stage("colour", clear_ ? 3 * 5 : 3 * 6 + 1);  // only opaque matter has emission
    stage("press", clear_ ? 3 : 0);
    stage("pixel");
    stage("write");
    stage("memory port");
  }

  const Configuration& c_;
  const Registers& registers_;
  const Memory& memory_;
  bool clear_;
  ContextBits context_;
  PipeCost cost_;
};

}  // namespace

PipeCost cost_of(const Configuration& configuration, const Registers& registers, const Memory& memory) {
  return Costs(configuration, registers, memory).all();
}

std::int64_t PipeCost::channel_bits() const {
  std::int64_t sum = 0;
  for (const ChannelCost& channel : channels) sum += channel.total();
  return sum;
}
std::int64_t PipeCost::memory_bits() const {
  std::int64_t sum = 0;
  for (const MemoryCost& memory : memories) sum += memory.total();
  return sum;
}
UnitCost PipeCost::all_units() const {
  UnitCost sum{"all", 0, 0};
  for (const UnitCost& cost : units) {
    sum.multipliers += cost.multipliers;
    sum.dividers += cost.dividers;
  }
  return sum;
}

}  // namespace voxmelt::hwmodel::raycast
