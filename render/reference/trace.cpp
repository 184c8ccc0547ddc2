#include "render/reference/trace.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "render/packet/field_bricks.h"
#include "render/reference/reference_pixels.h"

namespace voxmelt::render {
namespace {

using picture::Stage;
using picture::Vector;

constexpr std::array<std::string_view, 19> kStages{
    "picture", "pixel",   "ray",    "brick", "sample",   "crossing", "ground", "met",    "unit", "normal",
    "paint",   "texture", "matter", "light", "arriving", "material", "mirror", "colour", "clear"};
static_assert(kStages.size() == static_cast<std::size_t>(Stage::clear) + 1);

// Holds the numbers of a value, one after the other.
struct Numbers {
  std::array<std::int64_t, 16> values{};
  std::size_t count = 0;

  template <class Value>
  void add(const Value& value) {
    if constexpr (std::is_integral_v<Value>)
      values[count++] = value;
    else if constexpr (std::is_same_v<Value, Vector>) {
      add(value.x);
      add(value.y);
      add(value.z);
    } else if constexpr (std::is_same_v<Value, picture::Matter>) {
      add(value.liquid);
      add(value.heat);
      add(value.obstacle);
    } else if constexpr (std::is_same_v<Value, picture::Light>) {
      add(value.lamp);
      add(value.open);
      add(value.glow);
    } else if constexpr (std::is_same_v<Value, picture::Texel>) {
      add(value.red);
      add(value.green);
      add(value.blue);
      add(int{value.bump_x});
      add(int{value.bump_z});
    } else
      for (const auto& one : value) add(one);
  }
  template <class Value>
  void add(const picture::Fetched<Value>& fetched) {
    add(fetched.cell);
    add(fetched.value);
  }
};

// Hands on what the rule tells, and says which brick a ray reads.
struct Telling {
  Listener& listener;
  std::optional<Vector> brick;

  template <class Value>
  void tell(Stage stage, const char* name, const Value& value) {
    Numbers numbers;
    numbers.add(value);
    listener.told(stage, name, {numbers.values.data(), numbers.count});
  }
  // Tells the brick that serves a sample at a position (docs/picture/definition.md, section 12).
  void read_at(Vector position) {
    const auto along = [](std::int64_t p) {
      return (picture::place_of(p).cell + kLatticeBorder) / kBrickSide;
    };
    const Vector now{along(position.x), along(position.y), along(position.z)};
    if (brick == now) return;
    brick = now;
    tell(Stage::brick, "brick", now);
  }
};

struct Teller {
  Telling* telling = nullptr;

  template <class Value>
  void operator()(Stage stage, const char* name, const Value& value) const {
    if (stage == Stage::ray) telling->brick.reset();
    if constexpr (std::is_same_v<Value, Vector>)
      if ((stage == Stage::sample || stage == Stage::normal || stage == Stage::matter) &&
          std::string_view(name) == "position")
        telling->read_at(value);
    telling->tell(stage, name, value);
  }
};

void tell_material(const Teller& teller, const std::array<const char*, 4>& names,
                   const picture::Material& material) {
  teller(Stage::picture, names[0], material.diffuse);
  teller(Stage::picture, names[1], material.mirror);
  teller(Stage::picture, names[2], material.highlight);
  teller(Stage::picture, names[3], material.gloss);
}

// Tells the numbers that all rays share, except the tables.
void tell_picture(const Teller& teller, const PictureScene& scene, const picture::View& view) {
  const auto tell = [&](const char* name, const auto& value) { teller(Stage::picture, name, value); };
  tell("eye", view.eye);
  tell("forward", view.forward);
  tell("right", view.right);
  tell("up", view.up);
  tell("wide", view.wide);
  tell("high", view.high);
  tell("near", view.near);
  tell("near_wide", view.near_wide);
  tell("near_high", view.near_high);
  tell("e", view.halvings);
  const picture::Paint& paint = scene.paint;
  tell("to_light", paint.to_light);
  tell("to_strip", paint.to_strip);
  tell("lamp", paint.lamp);
  tell("from_below", paint.from_below);
  tell("from_above", paint.from_above);
  tell_material(teller, {"solid diffuse", "solid mirror", "solid highlight", "solid gloss"}, paint.solid);
  tell_material(teller, {"liquid diffuse", "liquid mirror", "liquid highlight", "liquid gloss"},
                paint.liquid);
  tell_material(teller, {"obstacle diffuse", "obstacle mirror", "obstacle highlight", "obstacle gloss"},
                paint.obstacle);
  tell("lamp low", paint.lamp_low);
  tell("lamp high", paint.lamp_high);
  tell("strip low", paint.strip_low);
  tell("cells of light", scene.light.count());
  tell("s", scene.light.shift());
}

}  // namespace

std::string_view name_of(Stage stage) { return kStages[static_cast<std::size_t>(stage)]; }

Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting,
                        Listener& listener) {
  Telling telling{listener, {}};
  const ReferencePixels pixels(scene, camera, setting, Teller{&telling});
  tell_picture({&telling}, scene, pixels.view());
  return picture_of(pixels, camera);
}

Rgb reference_pixel(const PictureScene& scene, const picture::Camera& camera, Setting setting, std::int64_t x,
                    std::int64_t y, Listener& listener) {
  Telling telling{listener, {}};
  const ReferencePixels traced(scene, camera, setting, Teller{&telling});
  const ReferencePixels<> silent(scene, camera, setting);
  tell_picture({&telling}, scene, traced.view());
  const Rgb one = traced.with_one_sample(x, y);
  const auto at = [&](std::int64_t nx, std::int64_t ny) { return silent.with_one_sample(nx, ny); };
  return silent.needs_more_samples(at, x, y) ? traced.with_more_samples(x, y) : one;
}

void TraceText::told(Stage stage, std::string_view name, std::span<const std::int64_t> numbers) {
  const auto known = [&] {
    return std::find_if(lines_.begin(), lines_.end(), [&](const Line& line) { return line.name == name; });
  };
  const bool row = name == "fetched" || name == "along x" || name == "along y";
  if (stage != stage_ || (!row && known() != lines_.end())) flush();
  stage_ = stage;
  auto line = known();
  if (line == lines_.end()) line = lines_.insert(line, {std::string(name), {}});
  for (const std::int64_t number : numbers.subspan(name == "fetched" ? 3 : 0))
    line->numbers += ' ' + std::to_string(number);
}

void TraceText::flush() {
  for (const Line& line : lines_) {
    const std::string stage(name_of(stage_));
    out_ << stage << std::string(10 - stage.size(), ' ') << line.name
         << std::string(20 - std::min<std::size_t>(line.name.size(), 20), ' ') << line.numbers << '\n';
  }
  lines_.clear();
}

}  // namespace voxmelt::render
