#include "render/device/picture_numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "render/packet/tables.h"
#include "render/rule/clear.h"
#include "render/rule/light_grid.h"
#include "render/rule/normal.h"

namespace voxmelt::render {
namespace {

using picture::Vector;

// Where tables begin: the same numbers stand in program/vectors.cl.
constexpr std::size_t kInverseRoots = 64, kHighlights = 512, kDullHighlights = 1600, kSurroundings = 2688,
                      kGlowLights = 4800, kGlowCrusts = 5568, kTints = 6336, kTones = 8960, kBytes = 21312,
                      kPassing = 25472, kPaintNumbers = 27584;

std::int64_t along(Vector v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

void put(ViewNumbers& numbers, std::size_t at, Vector v) {
  numbers[at] = v.x;
  numbers[at + 1] = v.y;
  numbers[at + 2] = v.z;
}

class Numbers {
 public:
  explicit Numbers(std::size_t count) : all_(count) {}
  void to(std::size_t place) { place_ = place; }
  void put(std::int32_t number) { all_[place_++] = number; }
  void put(Vector v) {
    for (const std::int64_t number : {v.x, v.y, v.z}) put(static_cast<std::int32_t>(number));
  }
  void put(const picture::Color& color) {
    for (const std::int32_t number : color) put(number);
  }
  void put(const picture::Material& material) {
    put(material.diffuse);
    put(material.mirror);
    put(material.highlight);
    put(material.gloss);
  }
  template <class Table>
  void put_at(std::size_t place, const Table& table) {
    to(place);
    for (const auto& entry : table)
      if constexpr (requires { put(entry); })
        put(entry);
      else
        put(static_cast<std::int32_t>(entry));
  }
  std::vector<std::int32_t> take() { return std::move(all_); }

 private:
  std::vector<std::int32_t> all_;
  std::size_t place_ = 0;
};

}  // namespace

LampSweep lamp_sweep(Vector to_light, Vector light_cells) {
  LampSweep lamp;
  for (const int other : {0, 2})
    if (picture::magnitude(along(to_light, other)) > picture::magnitude(along(to_light, lamp.axis)))
      lamp.axis = other;
  lamp.from_high = along(to_light, lamp.axis) > 0;
  lamp.slices = along(light_cells, lamp.axis);
  const int u = lamp.axis == 0 ? 1 : 0, v = lamp.axis == 2 ? 1 : 2;
  const auto slope = [&](int axis) {
    return static_cast<std::int32_t>(picture::floor_divided(along(to_light, axis) * picture::kLength,
                                                            picture::magnitude(along(to_light, lamp.axis))));
  };
  lamp.slope_u = slope(u);
  lamp.slope_v = slope(v);
  const auto set = [&](std::int32_t by, int axis, std::int64_t& low, std::int64_t& rays) {
    const std::int64_t cells = picture::shift_at(lamp.slices, by).cells;
    low = std::min<std::int64_t>(cells, 0) - 1;
    rays = along(light_cells, axis) + picture::magnitude(cells) + 4;
  };
  set(lamp.slope_u, u, lamp.low_u, lamp.rays_u);
  set(lamp.slope_v, v, lamp.low_v, lamp.rays_v);
  return lamp;
}

void put_view(ViewNumbers& numbers, const picture::View& view, const picture::Camera& camera, int spacing) {
  put(numbers, 0, view.eye);
  put(numbers, 3, view.forward);
  put(numbers, 6, view.wide);
  put(numbers, 9, view.high);
  numbers[12] = view.near;
  put(numbers, 13, view.near_wide);
  put(numbers, 16, view.near_high);
  const std::array<std::int64_t, 6> rest{view.half_width, view.half_height, view.halvings,
                                         spacing,         camera.width,     camera.height};
  std::copy(rest.begin(), rest.end(), numbers.begin() + 19);
}

void put_ground(ViewNumbers& numbers, const GroundMap& ground) {
  numbers[25] = std::max(ground.highest(), 0);
  numbers[26] = ground.slopes().x;
  numbers[27] = ground.slopes().z;
  put(numbers, 28, ground.color());
  numbers[31] = ground.texels().empty() ? 0 : 1;
  numbers[32] = ground.fineness();
  numbers[33] = static_cast<std::int64_t>(ground.bands().size());
}

void put_light(ViewNumbers& numbers, const LampSweep& lamp, Vector light_cells, int light_shift) {
  put(numbers, 34, light_cells);
  const std::array<std::int64_t, 9> rest{light_shift,  lamp.axis,    lamp.from_high ? 1 : 0,
                                         lamp.slope_u, lamp.slope_v, lamp.low_u,
                                         lamp.low_v,   lamp.rays_u,  lamp.rays_v};
  std::copy(rest.begin(), rest.end(), numbers.begin() + 37);
}

std::vector<std::int32_t> paint_numbers(const picture::Look& look, const picture::Paint& paint,
                                        int light_shift) {
  Numbers numbers(kPaintNumbers);
  numbers.put(paint.to_light);
  numbers.put(paint.to_strip);
  for (const picture::Color& color : {paint.lamp, paint.from_below, paint.from_above}) numbers.put(color);
  for (const picture::Material* material : {&paint.solid, &paint.liquid, &paint.obstacle})
    numbers.put(*material);
  for (const std::int32_t number :
       {paint.glow ? 1 : 0, paint.tinted ? 1 : 0, paint.lamp_low, paint.lamp_high, paint.strip_low})
    numbers.put(number);
  numbers.put(look.background);
  numbers.put(look.glow_cold);
  numbers.put(look.glow_hot);
  numbers.put(paint.clear ? 1 : 0);
  numbers.put(paint.losses);
  numbers.put(paint.frost);
  numbers.put(paint.clear ? picture::density_share(paint.passing, paint.losses, light_shift) : 256);
  numbers.put_at(kInverseRoots, picture::kInverseRoot);
  numbers.put_at(kHighlights, paint.highlight);
  numbers.put_at(kDullHighlights, paint.dull_highlight);
  numbers.put_at(kSurroundings, paint.surroundings);
  numbers.put_at(kGlowLights, paint.glow_colors.light);
  numbers.put_at(kGlowCrusts, paint.glow_colors.crust);
  numbers.put_at(kTints, paint.tints);
  numbers.put_at(kTones, tone_table());
  numbers.put_at(kBytes, byte_table());
  numbers.put_at(kPassing, paint.passing);
  return numbers.take();
}

std::vector<std::int32_t> ground_numbers(const GroundMap& ground) {
  std::vector<std::int32_t> all = ground.drawn();
  const auto add = [&](const auto& numbers) { all.insert(all.end(), numbers.begin(), numbers.end()); };
  add(ground.bare());
  for (const std::vector<std::int32_t>& bends : ground.bends()) add(bends);
  add(ground.bands());
  return all;
}

std::vector<std::uint16_t> texel_numbers(const GroundMap& ground) {
  std::vector<std::uint16_t> all(4);
  if (!ground.texels().empty()) all.clear();
  for (const picture::Texel& texel : ground.texels()) {
    const auto low = static_cast<std::uint8_t>(texel.bump_x), high = static_cast<std::uint8_t>(texel.bump_z);
    all.insert(all.end(), {texel.red, texel.green, texel.blue, static_cast<std::uint16_t>(low | high << 8)});
  }
  return all;
}

}  // namespace voxmelt::render
