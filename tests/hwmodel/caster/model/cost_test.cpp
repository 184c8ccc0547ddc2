// Every number that runs over the ray caster's channels in hostile pictures fits its wire. Every channel and
// stage of a pipe has its row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "hwmodel/caster/host/uploader.h"
#include "hwmodel/caster/model/channel_wires.h"
#include "hwmodel/caster/model/cost.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "hwmodel/caster/model/token_wires.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Checks that every number that enters a channel fits its wire.
template <class Token>
class Fits : public FifoWatcher<Token> {
 public:
  explicit Fits(ContextBits bits) : bits_(bits) {}
  void left(int, std::int64_t, const Token*) override {}
  void entered(int channel, std::int64_t, const Token* token) override {
    const auto check = [&](const WireName& name, int bits, bool has_sign, std::int64_t value) {
      const std::int64_t low = has_sign ? -(std::int64_t{1} << (bits - 1)) : 0;
      const std::int64_t high = (std::int64_t{1} << (has_sign ? bits - 1 : bits)) - 1;
      if (value < low || value > high)
        wrong.insert("channel " + std::to_string(channel % 100) + ", " + name.text() + ": " +
                     std::to_string(value) + " in " + std::to_string(bits) + " bits");
      ++checked;
    };
    wires_in(static_cast<Channel>(channel % 100), *token, bits_, check);
  }
  std::set<std::string> wrong;
  std::int64_t checked = 0;

 private:
  ContextBits bits_;
};

struct AllFit {
  AllFit(const Configuration& c, bool clear)
      : bits{bits_for(c.rays - 1), bits_for(c.tiles - 1), clear},
        tiles(bits),
        set_up(bits),
        ground(bits),
        asks(bits),
        levels(bits),
        samples(bits),
        hits(bits),
        met(bits),
        surfaces(bits),
        pressed(bits),
        pixels(bits),
        passed(bits),
        onward(bits) {}
  Watchers watchers() {
    Watchers w;
    w.tiles = &tiles;
    w.set_up = &set_up;
    w.ground = &ground;
    w.asks = &asks;
    w.levels = &levels;
    w.samples = &samples;
    w.hits = &hits;
    w.met = &met;
    w.surfaces = &surfaces;
    w.pressed = &pressed;
    w.pixels = &pixels;
    w.passed = &passed;
    w.onward = &onward;
    return w;
  }
  template <class Visit>
  void for_each(Visit&& visit) {
    visit(tiles);
    visit(set_up);
    visit(ground);
    visit(asks);
    visit(levels);
    visit(samples);
    visit(hits);
    visit(met);
    visit(surfaces);
    visit(pressed);
    visit(pixels);
    if (bits.clear) {
      visit(passed);
      visit(onward);
    }
  }
  ContextBits bits;
  Fits<TileOrder> tiles;
  Fits<RayToken> set_up;
  Fits<GroundedRay> ground;
  Fits<LevelRequest> asks;
  Fits<Levels> levels;
  Fits<LevelToken> samples;
  Fits<HitToken> hits;
  Fits<MetToken> met;
  Fits<Surface> surfaces;
  Fits<PressedToken> pressed;
  Fits<PixelToken> pixels;
  Fits<PassedToken> passed;
  Fits<OnwardToken> onward;
};

// Holds the data from which a hostile picture is drawn.
struct Drawn {
  Drawn(const test::HostilePicture& picture, const Configuration& c) : uploader(c) {
    field.update(picture.volume, picture.look, picture.terrain, 1);
    software.update(field, picture.look, picture.light, picture.terrain, nullptr, 1);
    uploader.update(software.data(render::camera_in_integers(picture.camera), render::Setting::fast),
                    nullptr);
  }
  render::DensityField field;
  render::Picture software;
  Uploader uploader;
};

test::HostilePicture picture_of(std::uint64_t seed, bool clear) {
  if (clear) return test::hostile_clear_picture(seed, 3000);
  test::HostilePicture picture = test::hostile_picture(seed, 3000);
  picture.look.clear = {};
  return picture;
}

// The parameter chooses clear matter (true) or opaque matter.
class CostOf : public testing::TestWithParam<bool> {};

TEST_P(CostOf, EveryNumberFitsItsWire) {
  const bool clear = GetParam();
  std::int64_t fewest = INT64_MAX;
  Configuration c;
  c.rays = 17;
  c.tiles = 3;
  std::map<int, std::int64_t> checked;
  for (std::uint64_t seed = 0; seed < (clear ? 60 : 120); ++seed) {
    const test::HostilePicture picture = picture_of(seed, clear);
    if (picture.camera.width * picture.camera.height > (clear ? 800 : 4000)) continue;
    Drawn drawn(picture, c);
    ASSERT_EQ(drawn.uploader.registers().look.clear, clear);
    RayCaster caster(drawn.uploader.registers(), drawn.uploader.memory(), c);
    AllFit all(c, clear);
    caster.watch(all.watchers());
    ASSERT_TRUE(caster.draw_first().complete);
    ASSERT_TRUE(caster.draw_again(8, 16).complete);
    int i = 0;
    all.for_each([&](auto& fits) {
      ASSERT_TRUE(fits.wrong.empty()) << "seed " << seed << ": " << *fits.wrong.begin();
      checked[i++] += fits.checked;
    });
  }
  for (const auto& [which, count] : checked) fewest = std::min(fewest, count);
  EXPECT_EQ(checked.size(), clear ? 13U : 11U);
  EXPECT_GT(fewest, 1000) << "a kind of token was hardly seen";
}

TEST_P(CostOf, EveryChannelAndStageHasItsRow) {
  const test::HostilePicture picture = picture_of(3, GetParam());
  Configuration c;
  c.fifo_depth = 3;
  Drawn drawn(picture, c);
  const RayCaster caster(drawn.uploader.registers(), drawn.uploader.memory(), c);
  const PipeCost cost = cost_of(c, drawn.uploader.registers(), drawn.uploader.memory());
  std::vector<std::string> channels, rows, stages, units;
  for (const Pipe::ChannelState& one : caster.pipe(0).channels())
    channels.push_back(one.name + " " + std::to_string(one.depth));
  for (const ChannelCost& one : cost.channels) rows.push_back(one.name + " " + std::to_string(one.depth));
  EXPECT_EQ(rows, channels);
  for (const Stage* stage : caster.pipe(0).stages()) stages.push_back(stage->name());
  for (const UnitCost& one : cost.units) units.push_back(one.stage);
  std::sort(stages.begin(), stages.end());
  std::sort(units.begin(), units.end());
  EXPECT_EQ(units, stages);
  for (const MemoryCost& one : cost.memories) {
    const bool of_cache = std::count(stages.begin(), stages.end(), one.stage + " tags") == 1;
    EXPECT_TRUE(of_cache || std::count(stages.begin(), stages.end(), one.stage) == 1) << one.stage;
    EXPECT_GT(one.bits, 0) << one.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Matter, CostOf, testing::Bool(),
                         [](const auto& chosen) { return std::string(chosen.param ? "Clear" : "Opaque"); });

// By hand, the cache has two sets of two lines and eight to spare, so 12 slots of four bits.
TEST(Cost, ACacheIsItsLinesTagsAndQueue) {
  const test::HostilePicture picture = test::hostile_picture(3, 3000);
  Configuration c;
  c.light = {2, 2, 8, 5};
  Drawn drawn(picture, c);
  const Memory& memory = drawn.uploader.memory();
  const PipeCost cost = cost_of(c, drawn.uploader.registers(), memory);
  std::map<std::string, MemoryCost> light;
  for (const MemoryCost& one : cost.memories)
    if (one.stage == "light cells") light[one.name] = one;
  EXPECT_EQ(light["lines"].words, 12);
  EXPECT_EQ(light["lines"].bits, 128 * 8);
  const std::int64_t lines =
      std::int64_t{memory.light.count[0]} * memory.light.count[1] * memory.light.count[2];
  int line_bits = 0;
  while ((std::int64_t{1} << line_bits) < lines) ++line_bits;
  EXPECT_EQ(light["tags"].words, 4);
  EXPECT_EQ(light["tags"].bits, std::max(line_bits - 1, 1) + 1 + 4 + 1);
  EXPECT_EQ(light["queue"].words, 5);
  EXPECT_EQ(light["queue"].bits, 60 + 16 * 5);
  EXPECT_EQ(light["arrived, free"].total(), 12 * 5);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
