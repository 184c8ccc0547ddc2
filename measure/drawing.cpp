#include "measure/drawing.h"

#include <fmt/format.h>

#include <atomic>
#include <optional>

#include "measure/clocks.h"
#include "measure/measure.h"
#include "measure/two_states.h"
#include "render/density/density_field.h"
#include "render/density/loops.h"
#include "render/image/png_bytes.h"
#include "render/packet/picture.h"
#include "render/packet/plain_packet.h"

namespace voxmelt::measure {
namespace {

constexpr int kCheckedSide = kPictureSide / 4;

std::atomic<std::int64_t> rays{0};
void draw_and_count(const render::PictureData& data, render::Places places, render::PressedLight to) {
  rays += places.count;
  render::best_packets().draw(data, places, to);
}

struct Variant {
  Drawer drawer;
  int threads;
};

// Keeps the field and the picture of one scene, updated by whichever variant is asked.
class Kept {
 public:
  explicit Kept(const scene::Scene& scene) : scene_(scene) {}

  int update_field(const state::Volume& volume, const Variant& by) {
    return field_.update(volume, scene_.look, scene_.terrain, by.threads, render::loops_of(by.drawer.set));
  }
  void update_picture(const Variant& by) {
    picture_.update(field_, scene_.look, scene_.light, scene_.terrain, fresh_ ? nullptr : &field_.refreshed(),
                    by.threads, by.drawer.set);
    fresh_ = false;
  }
  int update(const state::Volume& volume, const Variant& by) {
    const int bricks = update_field(volume, by);
    update_picture(by);
    return bricks;
  }
  render::Image draw(std::size_t setting, int side, int threads, const render::Packets& packets) const {
    return picture_.draw(square_camera(scene_.camera, side), kSettings[setting], threads, packets);
  }
  render::Image draw(std::size_t setting, int side, const Variant& by) const {
    return draw(setting, side, by.threads, *by.drawer.packets);
  }
  bool same_field(const Kept& other) const {
    const render::DensityField &a = field_, &b = other.field_;
    return a.intensity() == b.intensity() && a.solid() == b.solid() && a.liquid() == b.liquid() &&
           a.heat() == b.heat() && a.obstacle() == b.obstacle();
  }

 private:
  const scene::Scene& scene_;
  render::DensityField field_;
  render::Picture picture_;
  bool fresh_ = true;
};

using Pictures = std::array<render::Image, kSettings.size()>;

// Holds the pictures of the second state that every variant must draw.
struct Expected {
  Expected(const state::Volume& after, const scene::Scene& scene, int threads) : fresh(scene) {
    fresh.update(after, {drawer_of(cpu::kInstructionSets.front().set), 1});
    for (std::size_t i = 0; i < kSettings.size(); ++i)
      plain[i] = fresh.draw(i, kCheckedSide, threads, render::plain_packets());
  }
  Kept fresh;
  Pictures plain;
};

void check(const Kept& kept, const Expected& expected, std::optional<Pictures>& large, const Variant& by,
           const std::string& workload) {
  const auto fail = [&](const std::string& what) {
    throw Mismatch(
        fmt::format("{} on {}, {} threads: {}", cpu::name_of(by.drawer.set), workload, by.threads, what));
  };
  if (!kept.same_field(expected.fresh)) fail("the updated field is not that of a fresh one");
  Pictures drawn;
  for (std::size_t i = 0; i < kSettings.size(); ++i) {
    if (!(kept.draw(i, kCheckedSide, by) == expected.plain[i]))
      fail(fmt::format("setting {}: not the picture of the plain painter", kSettingNames[i]));
    drawn[i] = kept.draw(i, kPictureSide, by);
    if (large && !(drawn[i] == (*large)[i]))
      fail(fmt::format("setting {}: not the picture of the first instruction set", kSettingNames[i]));
  }
  if (!large) large = drawn;
}

struct LeastTimes {
  Least field, light, unchanged;
  std::array<Least, kSettings.size()> draw;
};

void time_once(TwoStates& states, Kept& kept, const Variant& by, LeastTimes& least) {
  const Clock clock = clock_of(by.threads);
  kept.update(states.before(), by);
  const state::Volume& after = states.after();
  least.field.add(seconds_for(clock, [&] { kept.update_field(after, by); }));
  least.light.add(seconds_for(clock, [&] { kept.update_picture(by); }));
  least.unchanged.add(seconds_for(clock, [&] { kept.update(after, by); }));
  for (std::size_t i = 0; i < kSettings.size(); ++i)
    least.draw[i].add(seconds_for(clock, [&] { kept.draw(i, kPictureSide, by); }));
}

}  // namespace

Drawer drawer_of(cpu::InstructionSet set) { return {set, &render::packets_of(set)}; }

scene::Camera square_camera(scene::Camera camera, int side) {
  camera.width = camera.height = side;
  return camera;
}

Drawing measure_drawing(const Workload& workload, const scene::Scene& scene,
                        const std::vector<Drawer>& drawers, const std::vector<int>& threads,
                        const Rounds& rounds) {
  Drawing result;
  result.workload = workload.name;
  result.grid = workload.start.grid;
  std::vector<Variant> variants;
  for (const Drawer& drawer : drawers)
    for (const int n : threads) variants.push_back({drawer, n});

  TwoStates states(workload, kPictureSteps);
  const Expected expected(states.after(), scene, threads.back());
  Kept kept(scene);
  std::optional<Pictures> large;
  for (const Variant& by : variants) {
    kept.update(states.before(), by);
    result.bricks = kept.update(states.after(), by);
    check(kept, expected, large, by, workload.name);
  }
  for (std::size_t i = 0; i < kSettings.size(); ++i) {
    rays = 0;
    kept.draw(i, kPictureSide, 1, {&draw_and_count, nullptr, render::best_packets().lanes});
    result.rays[i] = rays;
  }

  const render::Image& picture = (*large)[1];
  result.png_bytes = render::png_bytes(picture).size();
  std::vector<LeastTimes> least(variants.size());
  Least encode;
  const RoundClock clock(rounds);
  for (; clock.more(result.rounds); ++result.rounds) {
    for (std::size_t i = 0; i < variants.size(); ++i) time_once(states, kept, variants[i], least[i]);
    encode.add(seconds_for(Clock::thread, [&] { render::png_bytes(picture); }));
  }
  result.encode = encode.value();
  for (std::size_t i = 0; i < variants.size(); ++i) {
    DrawingTiming& timing = result.timings.emplace_back();
    timing.set = variants[i].drawer.set;
    timing.threads = variants[i].threads;
    timing.field = least[i].field.value();
    timing.light = least[i].light.value();
    timing.unchanged = least[i].unchanged.value();
    for (std::size_t s = 0; s < kSettings.size(); ++s) timing.draw[s] = least[i].draw[s].value();
  }
  return result;
}

}  // namespace voxmelt::measure
